// tests/middleware/solid_world/together_runner.h: solid avatars in a world, and the judge's own
// record of what they are told and what they show; the judge looks at every tick.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "middleware/solid_world/solid_world.h"
#include "tests/middleware/solid_world/together_judge.h"

namespace foretouch::test {

struct TogetherTally {
  std::uint64_t ticks = 0;  ///< Of solid avatars: frames.
  std::uint64_t moved = 0, crushed = 0, placing = 0, equal = 0, pushed = 0;
  std::uint64_t instants = 0;       ///< At which the whole world was looked at.
  std::uint64_t inside = 0;         ///< Findings, at instants that were not announced.
  std::uint64_t broken = 0;         ///< Ways that do not begin where the last one ended.
  std::uint64_t overclaimed = 0;    ///< Clearances above the least separation.
  std::uint64_t uncertified = 0;    ///< Ticks without proof that say nothing of a crush.
  std::uint64_t betweenSolids = 0;  ///< Crushes of one by another.
  std::uint64_t digest = 14695981039346656037u;  ///< Of all poses that were shown.
  double least = 1e9;
  std::vector<std::string> findings;
  [[nodiscard]] std::uint64_t violations() const {
    return inside + broken + overclaimed + uncertified + betweenSolids;
  }
  void add(const TogetherTally& other);
};

class TogetherRunner {
 public:
  explicit TogetherRunner(const RawScene& still, int instants = 50);

  BodyId addSolid(const Avatar& avatar, const SolidOptions& options = {});
  BodyId addMover(const Avatar& avatar);
  BodyId addMover(const Scene& mesh);
  /// Where a mover is at the end of the next tick; at its begin, if it is the first.
  void moveTo(BodyId body, const Pose& pose);
  void moveTo(BodyId body, const RigidPose& pose);
  /// Of a mover: where it is on the way there, so long after the next tick's begin.
  void goVia(BodyId body, std::int64_t afterUs, const Pose& pose);
  void follow(BodyId body, const Pose& target, const std::vector<std::uint8_t>& isTracked = {});
  /// From now on, a solid avatar's hand holds a mover, or lets go of it where it is.
  void take(BodyId tool, BodyId holder, LinkId hand, const RigidPose& inHand);
  void letGo(BodyId tool);
  /// All of them to the next instant; movers that were not moved stay.
  void tick(std::int64_t durationUs = 11'111);

  [[nodiscard]] const SolidBodyTick& of(BodyId body) const;
  [[nodiscard]] std::int64_t atUs() const { return world.utimeUs(); }
  /// Findings are printed.
  [[nodiscard]] std::uint64_t violations() const;

  SolidWorld world;
  std::vector<SolidBodyTick> ticks;
  TogetherTally tally;
  std::function<void(std::vector<SolidBodyTick>&)> tamper;  ///< Before they are judged.

 private:
  struct Mover {
    bool isSolid = false, isNew = true, isHeld = false;
    Pose at, next;
    std::vector<std::pair<std::int64_t, Pose>> via;
    BodyId holder = 0;
    LinkId hand = 0;
  };
  void add(const Avatar& avatar, bool isSolid);
  void judgeTick(std::int64_t fromUs, std::int64_t toUs);
  void find(const std::string& what);

  int instants_;
  TogetherJudge judge_;
  std::vector<Avatar> avatars_;  // per body; of a mesh, one of a joint
  std::vector<Mover> movers_;    // per body
  struct Target {
    Pose pose;
    std::vector<std::uint8_t> isTracked;
  };
  std::map<BodyId, Target> targets_;
  std::map<BodyId, Pose> shown_;
};

}  // namespace foretouch::test
