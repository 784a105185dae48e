// middleware/solid/way_around.h: a proven way around what sliding cannot pass: two trees of
// certified motions, one from the shown pose and one from the target, grown towards each other and
// towards random poses ([Kuffner00], REFERENCES.md). Before that, back along the way that the
// avatar came, to where nothing is between it and the target: so fingers come out of where they
// hooked in. The random numbers are the same in every run. Not installed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "middleware/solid/certifier.h"
#include "middleware/solid/pose_list.h"
#include "middleware/solid/visual_body.h"

namespace foretouch::internal {

/// What a search may spend in a tick, in evaluations in lanes: it is spread over ticks.
inline constexpr std::uint64_t kSearchWork = 12'000;

/// For one thread; keeps its memory.
class WayAround {
 public:
  WayAround(const Avatar& avatar, const SolidOptions& options);

  /// Forgets the search and the way.
  void reset();
  /// To be called after a tick in which it was as tracked, and touched nothing.
  void rememberFree(const VisualBody& body, const Pose& shown, double dtS);
  /// Remembers where a tick begins that something holds; `isFree`: as tracked.
  void rememberBegin(const VisualBody& body, const Pose& shown, bool isFree);
  /// Remembers a place on its way in this tick.
  void remember(const VisualBody& body, const Pose& shown);
  /// Drops what the last tick remembered after its begin: it was not shown.
  void takeBack() { trail_.shorten(std::min(trail_.size(), atTick_)); }
  void forgetTrail();
  /// A way is found, and not yet walked to its end.
  [[nodiscard]] bool hasWay() const { return next_ < way_.size(); }
  /// A search is under way.
  [[nodiscard]] bool isSearching() const { return isBegun_ && !hasFailed_ && way_.empty(); }
  /// The search for this target has spent all it may.
  [[nodiscard]] bool hasFailed() const { return hasFailed_; }
  /// Whether a search, or a way, is no longer about where the body's points are shown and wanted.
  [[nodiscard]] bool isStale(const std::vector<Eigen::Vector3d>& places,
                             const std::vector<Eigen::Vector3d>& wanted) const;

  /// Goes on looking for a way, by at most aroundPerTick queries. `farthest`: the link that is
  /// farthest from its place. `goesOn`: the search, and the way, are good for a target that does
  /// not stay, and from a place nearby. Preconditions: `target` touches nothing.
  void search(const VisualBody& body, const Pose& shown, const Pose& target,
              const std::vector<Eigen::Vector3d>& wanted, LinkId farthest, bool goesOn,
              Certifier& certifier);
  /// Makes what is left of the way shorter, from `shown` on, by a few queries, and lets it go on to
  /// where the target is now. Precondition: hasWay().
  void tighten(const VisualBody& body, const Pose& shown, const Pose& target,
               const std::vector<Eigen::Vector3d>& wanted, Certifier& certifier);
  /// The next pose of the way. Precondition: hasWay().
  [[nodiscard]] const Pose& next() const { return way_[next_]; }
  /// `shown` is where the way to next() led to.
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
  [[nodiscard]] double distanceOf(const Node& node) const;
  [[nodiscard]] std::size_t nearest(const Tree& tree) const;
  std::size_t add(const VisualBody& body, Tree& tree, std::int32_t parent, const Pose& pose);
  [[nodiscard]] const Pose& trailAt(std::size_t i) const;
  [[nodiscard]] bool goBack(const VisualBody& body, Certifier& certifier);
  [[nodiscard]] bool grow(const VisualBody& body, Certifier& certifier);
  void finish(std::size_t here, std::size_t there, Certifier& certifier);
  void skipPoses(Certifier& certifier);
  void shorten(const VisualBody& body, int tries, Certifier& certifier);
  [[nodiscard]] double length(const VisualBody& body, const Pose& from, const Pose& to);

  Skeleton skeleton_;
  std::uint32_t perTick_, most_;       // motions in a tick, and for one target
  std::vector<std::uint8_t> isMoved_;  // per joint: of the limb that looks for a way
  Tree trees_[2];                      // from the shown pose; from the target
  std::size_t turn_ = 0;
  Pose sampled_, reached_;
  std::vector<Eigen::Vector3d> sampledPlaces_;
  std::vector<LinkState> states_, statesThere_;
  ChainMotion part_;
  PoseList way_, short_;
  Pose cornerIn_, cornerOut_;
  std::size_t next_ = 0;
  // At the search's begin: where the target has the points, and how far that is.
  std::vector<Eigen::Vector3d> wanted_;
  double far_ = 0.0;
  /// Where the avatar has been: as tracked, and since then, `spacing_` apart (m).
  PoseList free_, trail_;
  double sinceFreeS_ = 0.0, spacing_ = 0.0;
  std::size_t atTick_ = 0;  // the trail's size when the tick began
  // Poses of it that are not asked yet; the last one's node; how many to go back at once.
  std::size_t trailLeft_ = 0, tip_ = 0, stride_ = 1;
  std::uint32_t spent_ = 0;
  std::uint64_t random_ = 0;
  bool isBegun_ = false, hasFailed_ = false, goesOn_ = false;
};

}  // namespace foretouch::internal
