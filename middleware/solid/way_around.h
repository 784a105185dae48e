// middleware/solid/way_around.h: a proven way around what sliding cannot pass: two trees of
// certified motions, one from the shown pose and one from the target, grown towards each other and
// towards random poses ([Kuffner00], REFERENCES.md). The random numbers are the same in every run.
// Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "middleware/solid/certifier.h"
#include "middleware/solid/visual_body.h"

namespace foretouch::internal {

/// For one thread; keeps its memory.
class WayAround {
 public:
  WayAround(const Avatar& avatar, const SolidOptions& options);

  /// Forgets the search and the way.
  void reset();
  /// A way is found, and not yet walked to its end.
  [[nodiscard]] bool hasWay() const { return next_ < way_.size(); }
  /// Where it leads to.
  [[nodiscard]] const Pose& goal() const { return way_.back(); }
  /// The search for this target has spent all it may.
  [[nodiscard]] bool hasFailed() const { return hasFailed_; }
  /// A search, or a way, towards `target` is no longer about it.
  [[nodiscard]] bool isStale(const Pose& shown, const std::vector<Eigen::Vector3d>& wanted) const;

  /// Goes on looking for a way, by at most `motions` queries. `farthest`: the link that is farthest
  /// from its place. Preconditions: `target` touches nothing.
  void search(const VisualBody& body, const Pose& shown, const Pose& target,
              const std::vector<Eigen::Vector3d>& wanted, LinkId farthest, std::uint32_t motions,
              Certifier& certifier);
  /// The next pose of the way, at most `budget` from `shown` for any point.
  void next(const VisualBody& body, const Pose& shown, double budget, Pose& towards);
  /// `shown` is where next() led to.
  void arrived(const Pose& shown);

 private:
  struct Node {
    Pose pose;
    std::vector<Eigen::Vector3d> places;
    std::int32_t parent;
  };
  struct Tree {
    std::vector<Node> nodes;  // longer than `count`: keeps its memory
    std::size_t count = 0;
  };

  void begin(const VisualBody& body, const Pose& shown, const Pose& target,
             const std::vector<Eigen::Vector3d>& wanted, LinkId farthest);
  void chooseLimb(const VisualBody& body, LinkId farthest);
  void sample(const Pose& shown, const Pose& target);
  [[nodiscard]] double uniform(double low, double high);
  [[nodiscard]] std::size_t nearest(const Tree& tree) const;
  std::size_t add(const VisualBody& body, Tree& tree, std::int32_t parent, const Pose& pose);
  [[nodiscard]] bool grow(const VisualBody& body, Certifier& certifier);
  void finish(std::size_t here, std::size_t there, Certifier& certifier);

  Skeleton skeleton_;
  std::uint32_t most_;                 // motions for one target
  std::vector<std::uint8_t> isMoved_;  // per joint: of the limb that looks for a way
  Tree trees_[2];                      // from the shown pose; from the target
  std::size_t turn_ = 0;
  Pose sampled_, reached_;
  std::vector<Eigen::Vector3d> sampledPlaces_;
  std::vector<LinkState> states_, statesThere_;
  ChainMotion part_;
  std::vector<Pose> way_, short_;
  std::size_t next_ = 0;
  Pose from_;  // the shown pose that the search began at
  std::vector<Eigen::Vector3d> wanted_;
  std::uint32_t spent_ = 0;
  std::uint64_t random_ = 0;
  bool isBegun_ = false, hasFailed_ = false;
};

}  // namespace foretouch::internal
