#include "tools/replay/step_follower.h"

#include <algorithm>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// World time of a step, whatever it takes on the clip's clock: so that each begins at a whole
/// number of microseconds.
constexpr std::int64_t kStepUs = 100'000;
/// Enough to spread what a call costs.
constexpr std::size_t kStepsPerStretch = 32;
constexpr BodyId kBody = 0;

}  // namespace

bool StepFollower::canFollow(const ReplayInputs& inputs) {
  const QueryOptions& query = inputs.query;
  const bool isOfLinks = query.fidelity == Fidelity::Link || query.fidelity == Fidelity::Exact;
  const bool isUnbounded = query.workBudget == QueryOptions{}.workBudget &&
                           query.deadlineUs == QueryOptions{}.deadlineUs;
  const bool hasPairRadii = query.surface && query.self && !query.self->radii().empty();
  return isOfLinks && isUnbounded && !hasPairRadii && query.linkPolicies.empty() &&
         query.scope != Scope::FirstOfAvatar && !query.passSeparating &&
         query.tolerance >= kMinWorldTolerance;
}

Result<StepFollower> StepFollower::start(const ReplayInputs& inputs) {
  WorldOptions options;
  options.tolerance = inputs.query.tolerance;
  FORETOUCH_TRY(auto world, World::build(inputs.scene, options));
  BodyOptions body;
  body.self = inputs.query.self;
  if (inputs.query.fidelity == Fidelity::Exact) body.surface = inputs.query.surface;
  FORETOUCH_TRY(const BodyId id, world.add(inputs.avatar, body));
  static_cast<void>(id);
  FORETOUCH_TRY(auto follower, WorldFollower::start(0));
  StepFollower steps(inputs, std::move(world), std::move(follower));
  FORETOUCH_CHECK(steps.push(0));
  return steps;
}

StepFollower::StepFollower(const ReplayInputs& inputs, World world, WorldFollower follower)
    : inputs_(inputs), world_(std::move(world)), follower_(std::move(follower)) {}

Result<Done> StepFollower::push(std::int64_t pose) {
  FORETOUCH_TRY(auto read, poseAtFrame(inputs_, inputs_.steps.frameOf(pose)));
  FORETOUCH_CHECK(world_.push(kBody, pose * kStepUs, read));
  poses_.push_back(std::move(read));
  return Done{};
}

Result<bool> StepFollower::add(std::int64_t step) {
  const std::int64_t followed = follower_.followedUntilUs() / kStepUs;
  if (followed > firstPose_) {
    poses_.erase(poses_.begin(), poses_.begin() + (followed - firstPose_));
    firstPose_ = followed;
  }
  FORETOUCH_CHECK(push(step + 1));
  const bool isFull = poses_.size() > kStepsPerStretch;
  if (isFull) FORETOUCH_CHECK(finish());
  return isFull;
}

Result<Done> StepFollower::finish() {
  const std::int64_t untilUs = (lastStep() + 1) * kStepUs;
  FORETOUCH_CHECK(follower_.follow(world_, untilUs, followed_));
  world_.forgetBefore(untilUs);
  events_.clear();
  for (const WorldEvent& event : followed_.events) {
    if (!isIgnored(event)) events_.push_back(event);
  }
  return Done{};
}

bool StepFollower::isIgnored(const WorldEvent& event) const {
  const std::vector<IgnoredPair>& ignored = inputs_.query.ignored;
  return event.b.body == kStillScene &&
         std::any_of(ignored.begin(), ignored.end(), [&](const IgnoredPair& pair) {
           return pair.link == event.a.link &&
                  (pair.object == IgnoredPair::kEveryObject || pair.object == event.object);
         });
}

ChainMotion StepFollower::motionOf(std::int64_t step) const {
  const auto first = slotOf(step - firstPose_);
  return {inputs_.avatar.skeleton(), poses_[first], poses_[first + 1]};
}

StepInstant StepFollower::instantOf(const WorldTime& time) const {
  StepInstant instant;
  instant.step = std::min(time.us / kStepUs, lastStep());
  instant.share = microsecondsAfter(instant.step * kStepUs, time) / static_cast<double>(kStepUs);
  return instant;
}

std::int64_t StepFollower::lastStep() const {
  return firstPose_ + static_cast<std::int64_t>(poses_.size()) - 2;
}

}  // namespace foretouch::tools
