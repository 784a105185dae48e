#include "network/stream/solid_answer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

std::int64_t snapInUs(double seconds) {
  constexpr double kMost = 1e9;  // longer than any notice
  constexpr double kUsPerS = 1e6;
  return seconds < 0.0 ? -1 : std::llround(std::min(seconds, kMost) * kUsPerS);
}

void fillWay(const SolidTick& tick, SolidMessage& answer) {
  const std::size_t numWay = tick.numWay;
  if (numWay == 0 || numWay > kMaxSolidPoses) {
    answer.way.resize(1);
    answer.way.front() = tick.shown;
    answer.times.assign(1, numWay == 0 ? 0.0 : 1.0);
    if (numWay == 0) return;
    answer.isCertified = false;
    answer.clearance = 0.0;
    return;
  }
  answer.way.resize(numWay);
  std::copy_n(tick.way.begin(), numWay, answer.way.begin());
  answer.times.assign(tick.times.begin(), tick.times.begin() + static_cast<std::ptrdiff_t>(numWay));
}

void fillContacts(const SolidTick& tick, const Skeleton& skeleton, const Scene& scene,
                  SolidMessage& answer) {
  const std::size_t listed = std::min(tick.contacts.size(), kMaxSolidContacts);
  answer.contactsLeftOut = static_cast<std::int32_t>(tick.contacts.size() - listed);
  answer.contacts.resize(listed);
  for (std::size_t i = 0; i < listed; ++i) {
    const SolidContact& contact = tick.contacts[i];
    ShownContact& shown = answer.contacts[i];
    shown.contact = contact;
    shown.linkName = skeleton.name(contact.link);
    shown.otherName = contact.triangle >= 0
                          ? scene.objectNames()[slotOf(scene.object(contact.triangle))]
                          : skeleton.name(contact.other);
  }
}

}  // namespace

Result<Done> checkedJoints(const Avatar& avatar) {
  if (countOf(avatar.numLinks()) <= kMaxSolidJoints) return Done{};
  return Error::in("solid", ErrorCode::LimitExceeded,
                   "expected an avatar of at most " + std::to_string(kMaxSolidJoints) +
                       " joints, found " + std::to_string(avatar.numLinks()));
}

bool findTracked(const Skeleton& skeleton, const std::vector<UndecidedReason>& unknownJoints,
                 std::vector<std::uint8_t>& isTracked) {
  const std::vector<JointId>& parents = skeleton.parents();
  isTracked.resize(unknownJoints.size());
  bool areRoots = true;
  for (std::size_t joint = 0; joint < unknownJoints.size(); ++joint) {
    isTracked[joint] = unknownJoints[joint] == UndecidedReason::None ? 1 : 0;
    areRoots = areRoots && (isTracked[joint] == 1 || parents[joint] != kNoParent);
  }
  return areRoots;
}

void fillSolidHead(std::int32_t id, std::int64_t avatarHash, const SolidOptions& options,
                   SolidMessage& answer) {
  constexpr std::uint64_t kMostBudget = std::uint64_t{1} << 61;
  answer.avatar = id;
  answer.avatarHash = avatarHash;
  answer.skin = options.skin;
  answer.tolerance = options.tolerance;
  answer.catchUp = options.catchUp;
  answer.workBudget = static_cast<std::int64_t>(std::min(options.workBudget, kMostBudget));
}

void fillSolidTick(const SolidTick& tick, const Skeleton& skeleton, const Scene& scene,
                   SolidMessage& answer) {
  answer.state = tick.state;
  answer.limit = tick.limit;
  answer.isCertified = tick.isCertified;
  answer.hasAppeared = tick.hasAppeared;
  answer.deviation = tick.deviation;
  answer.lift = tick.lift;
  // Infinite where no motion was asked.
  answer.clearance = std::isfinite(tick.clearance) ? tick.clearance : 0.0;
  answer.snapInUs = snapInUs(tick.snapInS);
  answer.joints = tick.joints;
  answer.linkDeviation = tick.linkDeviation;
  answer.counters = tick.counters;
  fillWay(tick, answer);
  fillContacts(tick, skeleton, scene, answer);
}

void fillSolidWait(const Pose& tracked, const std::vector<std::uint8_t>& isTracked,
                   SolidMessage& answer) {
  answer.state = SolidState::Placing;
  answer.limit = SolidLimit::None;
  answer.isCertified = answer.hasAppeared = false;
  answer.deviation = answer.lift = answer.clearance = 0.0;
  answer.snapInUs = -1;
  answer.linkDeviation.assign(isTracked.size(), 0.0);
  answer.joints.resize(isTracked.size());
  for (std::size_t joint = 0; joint < isTracked.size(); ++joint) {
    answer.joints[joint] = isTracked[joint] == 1 ? SolidJointState::Free : SolidJointState::Lost;
  }
  answer.way.resize(1);
  answer.way.front() = tracked;
  answer.times.assign(1, 0.0);
  answer.contacts.clear();
  answer.contactsLeftOut = 0;
  answer.counters = {};
}

}  // namespace foretouch::internal
