// network/world_stream/solid_bodies.h: the solid bodies of a live world: what their streams say are
// targets, and from tick to tick each goes there as far as everything lets it
// (middleware/solid_world/solid_world.h). Not installed.
//
// One advance of the watermark is cut into ticks where a solid body has a pose, so that one which
// is free shows its tracked poses bit for bit; at other bodies' instants its target is on the
// motion between its own two. Where ticks or work run out, the last tick goes to the end.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "articulated/motion.h"
#include "articulated/result.h"
#include "middleware/solid_world/solid_world.h"
#include "network/world_stream/live_body.h"
#include "network/world_stream/shown_body.h"
#include "network/world_stream/world_setup.h"

namespace foretouch::internal {

/// Whether a world can have its solid bodies. Errors: as WorldSolver::make() says.
[[nodiscard]] Result<Done> checkedSolids(const WorldSetup& setup);

/// One thread.
class SolidBodies {
 public:
  /// No body is there yet. Errors: those of SolidWorld::build() and WorldSetup::ask.
  static Result<std::unique_ptr<SolidBodies>> make(const WorldSetup& setup, std::int64_t fromUs);

  [[nodiscard]] World& world() { return world_.world(); }
  /// What no body of the world meets; it is the first one, and known until the last tick's end, so
  /// that the world can be asked until there, whichever bodies are there.
  [[nodiscard]] BodyId clock() const { return clock_; }
  /// Errors: as SolidWorld::add(); more joints than a message holds.
  Result<BodyId> add(BodyNumber number, const WorldShape& shape, const SolidOptions& options,
                     const BodyOptions& body);
  /// The next pose of a body that was added. Precondition: later than its last one.
  void follow(BodyId body, const LiveKnot& knot);
  /// No pose says where it is then: it is taken to be where it was.
  void hold(BodyId body, std::int64_t utimeUs);

  /// The body whose place in the world that is; nothing if it is no body's any more.
  using NumberOf = std::function<std::optional<BodyNumber>(BodyId, std::int64_t utimeUs)>;
  /// From the last tick's end until then. `timeline`: for messages. Fills `shown`: for each tick
  /// those that have begun, by body. Errors: a time of more ticks than one advance has; as
  /// SolidWorld::tick().
  Result<Done> tick(std::int64_t untilUs, std::int64_t timeline, const NumberOf& numberOf,
                    std::vector<ShownBody>& shown);
  /// The work of the last tick(), as SolidOptions::workBudget.
  [[nodiscard]] std::uint64_t work() const { return work_; }

 private:
  struct Solid {
    BodyNumber number = 0;
    BodyId body = 0;
    Skeleton skeleton;
    SolidOptions options;
    std::int64_t avatarHash = 0;
    std::deque<LiveKnot> knots;  // from the last one that is not later than the last tick's end
    bool hasRoots = false;       // have been known at once
    bool hasShown = false;
    std::vector<std::uint8_t> isTracked;
    Pose target;
    // Of the tick at hand.
    bool isThere = false, isGap = false;
    std::int64_t lost = 0;
  };
  SolidBodies(const Scene& still, SolidWorld world, BodyId clock)
      : still_(still), world_(std::move(world)), clock_(clock) {}
  void findInstants(std::int64_t untilUs);
  [[nodiscard]] Solid& solidOf(BodyId body);
  [[nodiscard]] Result<Done> tickTo(std::int64_t utimeUs);
  void aim(Solid& solid, std::int64_t utimeUs);
  void fill(Solid& solid, std::int64_t fromUs, std::int64_t timeline, const NumberOf& numberOf,
            ShownBody& shown) const;
  [[nodiscard]] const SolidBodyTick* tickOf(BodyId body) const;

  Scene still_;
  SolidWorld world_;
  BodyId clock_;
  std::vector<Solid> solids_;  // by body
  std::uint64_t work_ = 0;
  // Memory.
  std::vector<std::int64_t> instants_;
  std::vector<SolidBodyTarget> targets_;
  std::vector<SolidBodyTick> ticks_;
  ChainMotion motion_;
  Pose partFrom_;
};

}  // namespace foretouch::internal
