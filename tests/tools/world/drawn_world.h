// tests/tools/world/drawn_world.h: random worlds as texts of world files, in which who carries whom
// changes for many at one instant; and where their bodies are, composed here.
#pragma once

#include <array>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace foretouch::test {

/// Six balls, one of them perhaps a trigger, in four segments of half a second each.
class DrawnWorld {
 public:
  static constexpr int kBodies = 6, kSegments = 4;

  /// `areRolesKept`: nobody ever carries who carries him at another time.
  DrawnWorld(unsigned seed, bool areRolesKept, bool hasTrigger);

  [[nodiscard]] static std::string nameOf(int body) { return std::string(1, "feacdb"[body]); }

  /// The tables of the bodies in this order.
  [[nodiscard]] std::string text(const std::vector<int>& order) const;

  /// In W, at so many quarters of a second: after the changes of that instant.
  [[nodiscard]] Eigen::Isometry3d frameAt(int body, int quarter) const;

  /// Of how many changes the carrier changes at that instant as well.
  [[nodiscard]] int sameInstantChains() const;

 private:
  /// A place as a file says it.
  struct Place {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double yawDeg = 0.0;
    [[nodiscard]] Eigen::Isometry3d frame() const;
    [[nodiscard]] std::string keys() const;
  };
  /// How a segment begins: as the one before ends; as the change of carrier says; by a pose of that
  /// very instant; where the body was.
  enum class Begin { GoesOn, Said, Posed, Stays };
  struct Segment {
    int carrier = -1;  // nobody
    bool moves = false;
    Begin begin = Begin::GoesOn;
    Place first, middle, last;  // in the carrier's frame, where they are told
  };
  struct Actor {
    bool stands = false, isTrigger = false;
    Place place;  // of who stands
    std::array<Segment, kSegments> segments;
    [[nodiscard]] bool isHeld(int segment) const {
      const Segment& now = segments[static_cast<std::size_t>(segment)];
      return now.carrier >= 0 && !now.moves;
    }
  };

  [[nodiscard]] bool chance(double p);
  [[nodiscard]] Place somewhere();
  void drawSegment(int i, const std::vector<int>& rank);
  void drawBegin(const Actor& actor, int i, Segment& now);
  [[nodiscard]] std::string tableOf(int body) const;
  [[nodiscard]] const Segment& at(int body, int segment) const {
    return actors_[static_cast<std::size_t>(body)].segments[static_cast<std::size_t>(segment)];
  }
  /// `part`: 0, 1 or 2: where the segment begins, in its middle, where it ends.
  [[nodiscard]] Eigen::Isometry3d ownFrame(int body, int i, int part) const;
  [[nodiscard]] Eigen::Isometry3d worldFrame(int body, int i, int part) const;

  std::mt19937 random_;
  std::array<Actor, kBodies> actors_;
};

}  // namespace foretouch::test
