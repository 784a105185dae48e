// middleware/solid_world/solid_body.h: one solid avatar of a SolidWorld: with the tools in its
// hands, its way of the tick at hand, and what crushes it. Metres in W, world time in microseconds.
// Not installed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "middleware/solid/placing.h"
#include "middleware/solid/solid_avatar.h"
#include "middleware/solid_world/held_tools.h"
#include "middleware/solid_world/moving_controller.h"
#include "middleware/solid_world/passage.h"
#include "middleware/solid_world/solid_body_tick.h"
#include "middleware/solid_world/world_movers.h"

namespace foretouch::internal {

class SolidBody {
 public:
  /// Errors: as SolidAvatar::build().
  static Result<SolidBody> build(BodyId id, const Avatar& avatar, const Scene& still,
                                 const SolidOptions& options, KindNumbers& numbers);

  [[nodiscard]] BodyId id() const { return id_; }
  [[nodiscard]] bool hasTarget() const { return hasTarget_; }
  [[nodiscard]] bool isPlaced() const { return isPlaced_; }
  /// Keeps a validated copy; else as SolidAvatar::follow() refuses it, and nothing has changed.
  Result<Done> checkTarget(const SolidBodyTarget& target);
  /// The target that was checked last is that of the next ticks.
  void takeTarget();

  /// What its hands hold from now on. What they let go of is not asked as long as it touches.
  /// `isNew`: what was held in the last tick is not what is held now; else `held` is not looked at.
  /// Errors: more LSS than a link may have, chains that are too deep.
  Result<Done> hold(bool isNew, const std::vector<HeldTool>& held, const Surroundings& around,
                    std::int64_t us, KindNumbers& numbers);
  /// Bodies that it has let go of and still touches.
  [[nodiscard]] const std::vector<BodyId>& letGo() const { return letGo_; }

  /// Makes all that is asked about these bodies known. Errors: chains that are too deep.
  Result<Done> prepare(const Surroundings& around) { return outfit_->prover.prepare(around); }
  /// The same for another solid avatar, which may yet appear.
  Result<Done> prepare(const SolidBody& other) {
    const auto plan = outfit_->prover.planOf(other.outfit_->kind);
    if (!plan.ok()) return plan.error();
    return Done{};
  }
  /// The number of what others see of it: another one where it has other tools.
  [[nodiscard]] std::int32_t kindNumber() const { return outfit_->kind.number; }
  /// Forgets a kind that no body is of any more.
  void forget(std::int32_t kindNumber) { outfit_->prover.forget(kindNumber); }
  /// Stands where it is shown, for all of the tick.
  void stand(std::int64_t fromUs, std::int64_t toUs);
  /// One tick: `tick` gets what it shows. Precondition: prepare(around), hasTarget().
  void move(std::int64_t fromUs, std::int64_t toUs, Surroundings& around, SolidBodyTick& tick);
  /// As others see it: standing, or since move() its way.
  [[nodiscard]] const AroundBody& trace() const { return trace_; }
  /// The last move()'s clearance from everything that was asked and does not crush it.
  [[nodiscard]] double proven() const { return proven_; }
  /// Where its way's pieces end.
  [[nodiscard]] const std::vector<std::int64_t>& endsUs() const { return endsUs_; }

 private:
  /// The avatar with its tools.
  struct Outfit {
    AroundKind kind;
    SolidAvatar solid;
    PassageProver prover;
    MovingController controller;
  };
  static Result<std::unique_ptr<Outfit>> dress(const Avatar& avatar, const Scene& still,
                                               const SolidOptions& options,
                                               const std::vector<HeldTool>& tools,
                                               KindNumbers& numbers);
  SolidBody(BodyId id, const Avatar& avatar, const Scene& still, const SolidOptions& options)
      : id_(id), avatar_(avatar), still_(still), options_(options) {}
  Result<Done> wear(std::vector<HeldTool> tools, KindNumbers& numbers);
  void putOn(std::unique_ptr<Outfit> outfit);
  [[nodiscard]] Result<bool> mayWear(const HeldTool& tool, const Surroundings& around,
                                     std::int64_t us, KindNumbers& numbers);
  void partFromLetGo(Surroundings& around, std::int64_t us);
  void endCrushes(const Surroundings& around, std::int64_t us, SolidBodyTick& tick);
  [[nodiscard]] bool takeWay(std::int64_t fromUs, std::int64_t toUs, const Surroundings& around,
                             SolidTick& tick);
  void yield(std::int64_t fromUs, std::int64_t toUs, Surroundings& around, SolidBodyTick& tick);
  void finishYield(std::int64_t fromUs, std::int64_t toUs, SolidBodyTick& tick);
  void report(double lengthS, SolidBodyTick& tick);
  void reportCrushes(const Surroundings& around, std::int64_t us, SolidBodyTick& tick);
  [[nodiscard]] bool appear(std::int64_t fromUs, std::int64_t toUs, const Surroundings& around,
                            SolidTick& tick);
  void stayUnplaced(SolidTick& tick);
  void leaveTrace(std::int64_t fromUs, std::int64_t toUs, const SolidTick& tick);
  void addTrace(const Pose& from, const Pose& to, std::int64_t fromUs, std::int64_t toUs);

  BodyId id_;
  Avatar avatar_;
  Scene still_;
  SolidOptions options_;
  std::unique_ptr<Outfit> outfit_;
  std::unique_ptr<Placing> placing_;
  double proven_ = 0.0;
  std::unique_ptr<Outfit> next_;       // what it tries to wear
  std::vector<HeldTool> held_, worn_;  // in its hands; part of it
  std::size_t tries_ = 0;              // which of the others is tried
  HeldTool tried_;
  std::vector<BodyId> letGo_;
  std::vector<Crusher> crushers_;

  Pose proposed_, target_;
  std::vector<std::uint8_t> proposedFlags_, flags_;
  bool hasTarget_ = false, isPlaced_ = false;
  std::vector<LinkState> targetStates_;  // where the target has the links
  Pose shown_, before_;
  AroundBody trace_;
  std::vector<std::int64_t> endsUs_;
  std::vector<LinkState> states_, statesBefore_;
  std::vector<Eigen::Vector3d> places_, wanted_, lastWanted_;
};

}  // namespace foretouch::internal
