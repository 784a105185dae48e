// judge/way_judge.h: how near a whole body comes to a scene, and to itself, at many instants of a
// recorded way: motion by the sine weights of slerp, distances by distance.h, candidates by
// scene.h. In double, for millions of ticks; it errs by a few roundings of the coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "judge/capsule_prover.h"
#include "judge/scene.h"
#include "judge/vector.h"

namespace foretouch::oracle {

/// Parent-relative place of every joint. Rotations (w, x, y, z) need not be unit.
struct PlainPose {
  std::vector<std::array<double, 4>> rotations;
  std::vector<Vec3d> translations;
  bool operator==(const PlainPose& o) const {
    return rotations == o.rotations && translations == o.translations;
  }
};

struct WayBody {
  std::vector<int> parents;                    ///< Before their children; -1: the world.
  std::vector<std::vector<Capsule>> capsules;  ///< Per joint, in its frame.
  std::vector<std::array<int, 2>> ownPairs;    ///< Links that must not meet each other.
};

/// How densely a piece of a way is looked at.
struct WayLooks {
  int instants = 50;      ///< At least so many, both ends included.
  double spacing = 5e-3;  ///< And so many that an end of a capsule moves about so far between
                          ///< two (m), by nine first looks; at most kMost.
  static constexpr int kMost = 4000;
};

/// The least separation, and where. Below zero: inside by so much, at most by the radius.
struct WayReading {
  double least = 0.0;  ///< The cutoff if nothing is nearer.
  double t = 0.0;
  int link = -1, triangle = -1;  ///< -1: nothing is nearer than the cutoff.
  int other = -1;                ///< For own pairs, the other link.
  std::uint64_t instants = 0;    ///< Instants at which the whole body was looked at.
};

/// For one thread; keeps its memory. The scene must outlive it.
class WayJudge {
 public:
  WayJudge(const Scene& scene, WayBody body);

  /// Every joint on its shorter arc at constant rate and on its line. Looks no farther than
  /// `cutoff` (m).
  [[nodiscard]] WayReading along(const PlainPose& from, const PlainPose& to, double cutoff,
                                 const WayLooks& looks = {});
  [[nodiscard]] WayReading at(const PlainPose& pose, double cutoff);

  /// Both ends of every capsule in the world, link by link.
  [[nodiscard]] const std::vector<std::array<Vec3d, 2>>& endsAt(const PlainPose& pose);
  /// Per capsule of endsAt(), its link.
  [[nodiscard]] const std::vector<int>& linkOf() const { return linkOf_; }

 private:
  struct Arc {
    std::array<double, 4> from{1, 0, 0, 0}, to{1, 0, 0, 0};
    double angle = 0.0;  ///< Between the two as vectors of four.
    Vec3d translation, drift;
  };
  struct Frame {
    std::array<double, 4> q{1, 0, 0, 0};
    Vec3d p;
  };

  using Axis = std::array<Vec3d, 2>;

  void setOut(const PlainPose& from, const PlainPose& to);
  /// Per joint, the sine weights of its second pose at every step; those of the first mirror them.
  void weigh(int steps);
  void placeAt(int step, int steps, Axis* axes);
  /// All capsules at all instants.
  void place(int instants);
  [[nodiscard]] int instantsFor(const WayLooks& looks);
  void read(int instants, WayReading& reading);
  /// Whether the triangle is nearer than all before.
  bool readTriangle(std::size_t capsule, int id, int instants, WayReading& reading);
  void readScene(std::size_t capsule, int instants, WayReading& reading);
  void readOwn(std::size_t a, std::size_t b, int instants, WayReading& reading);
  template <typename Distance, typename Stray>
  bool walk(int instants, double radius, WayReading& reading, const Distance& distance,
            const Stray& stray);
  [[nodiscard]] const Axis& axis(std::size_t capsule, int instant) const {
    return axes_[static_cast<std::size_t>(instant) * linkOf_.size() + capsule];
  }
  /// How far the capsule's axis has come between two instants, at most.
  [[nodiscard]] double strayed(std::size_t capsule, int from, int to) const {
    return strayed_[static_cast<std::size_t>(to) * linkOf_.size() + capsule] -
           strayed_[static_cast<std::size_t>(from) * linkOf_.size() + capsule];
  }
  void measureStray(int instants);
  void boxAll(int instants);

  struct WayNearest {
    std::size_t capsule = 0;
    int triangle = -1;
  };

  const Scene& scene_;
  WayBody body_;
  std::vector<int> linkOf_;
  std::vector<Capsule> capsules_;
  std::vector<std::array<std::size_t, 2>> ownCapsules_;
  std::vector<Arc> arcs_;
  std::vector<Frame> frames_;
  std::vector<double> weights_;  ///< Joint by joint, step by step.
  std::vector<Box> boxes_;       ///< Around the capsules' axes over all instants.
  WayNearest last_;              ///< The nearest of the reading before: looked at first.
  std::vector<Axis> axes_;       ///< Instant by instant, capsule by capsule.
  std::vector<double> strayed_;  ///< The same: the way of the axis's ends until then, from point to
                                 ///< point, the farther one's.
};

}  // namespace foretouch::oracle
