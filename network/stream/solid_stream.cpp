#include "network/stream/solid_stream.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "articulated/raw_skeleton.h"
#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using SolidClock = std::chrono::steady_clock;

constexpr double kSolidUsPerS = 1e6;

std::int64_t lengthOf(const StreamStep& step) {
  if (step.kind == StepKind::First) return kFirstSolidStepUs;
  return std::clamp<std::int64_t>(step.utimeToUs - step.utimeFromUs, 1, kMostSolidStepUs);
}

std::int64_t snapInUs(double seconds) {
  constexpr double kMost = 1e9;  // longer than any notice
  return seconds < 0.0 ? -1 : std::llround(std::min(seconds, kMost) * kSolidUsPerS);
}

}  // namespace

SolidStream::SolidStream(std::int32_t id, SolidAvatar solid)
    : id_(id),
      solid_(std::move(solid)),
      avatarHash_(skeletonHash(rawSkeleton(solid_.avatar().skeleton()))) {}

Result<SolidStream> SolidStream::make(std::int32_t id, const Avatar& avatar, const Scene& scene,
                                      const SolidOptions& options) {
  if (countOf(avatar.numLinks()) > kMaxSolidJoints) {
    return Error::in("solid", ErrorCode::LimitExceeded,
                     "expected an avatar of at most " + std::to_string(kMaxSolidJoints) +
                         " joints, found " + std::to_string(avatar.numLinks()));
  }
  FORETOUCH_TRY(auto solid, SolidAvatar::build(avatar, scene, options));
  return SolidStream(id, std::move(solid));
}

void SolidStream::follow(const StreamStep& step, SolidMessage& answer) {
  const SolidClock::time_point start = SolidClock::now();
  std::swap(before_, shown_);
  const bool isFirst = before_.rotations.empty();
  hasRoots_ = findTracked(step) || hasRoots_;
  fillHead(step, answer);
  hasRoots_ ? tick(step, answer) : wait(step, answer);
  shown_ = answer.shown();
  if (isFirst) before_ = shown_;
  answer.solidUs = std::chrono::duration<double, std::micro>(SolidClock::now() - start).count();
}

/// True if all roots are tracked.
bool SolidStream::findTracked(const StreamStep& step) {
  const std::vector<JointId>& parents = solid_.avatar().skeleton().parents();
  const std::vector<UndecidedReason>& reasons = *step.unknownJoints;
  isTracked_.resize(reasons.size());
  bool areRoots = true;
  for (std::size_t joint = 0; joint < reasons.size(); ++joint) {
    isTracked_[joint] = reasons[joint] == UndecidedReason::None ? 1 : 0;
    areRoots = areRoots && (isTracked_[joint] == 1 || parents[joint] != kNoParent);
  }
  return areRoots;
}

void SolidStream::tick(const StreamStep& step, SolidMessage& answer) {
  const double dtS = static_cast<double>(answer.stepUs) / kSolidUsPerS;
  const auto done = solid_.follow({*step.to, dtS, &isTracked_}, tick_);
  // The stream has checked the pose already. If the solver refuses it all the same, what was shown
  // stays; if there is nothing yet, nothing is claimed.
  if (!done.ok() && tick_.joints.empty()) return wait(step, answer);
  if (!done.ok()) {
    tick_.numWay = 0;
    tick_.hasAppeared = false;
    tick_.state = tick_.isCertified ? SolidState::Held : tick_.state;
    tick_.contacts.clear();
    tick_.counters = {};
  }
  answer.state = tick_.state;
  answer.limit = tick_.limit;
  answer.isCertified = tick_.isCertified;
  answer.hasAppeared = tick_.hasAppeared;
  answer.deviation = tick_.deviation;
  answer.lift = tick_.lift;
  // Infinite where no motion was asked.
  answer.clearance = std::isfinite(tick_.clearance) ? tick_.clearance : 0.0;
  answer.snapInUs = snapInUs(tick_.snapInS);
  answer.joints = tick_.joints;
  answer.linkDeviation = tick_.linkDeviation;
  answer.counters = tick_.counters;
  fillWay(answer);
  fillContacts(answer);
}

void SolidStream::wait(const StreamStep& step, SolidMessage& answer) const {
  answer.state = SolidState::Placing;
  answer.limit = SolidLimit::None;
  answer.isCertified = answer.hasAppeared = false;
  answer.deviation = answer.lift = answer.clearance = 0.0;
  answer.snapInUs = -1;
  answer.linkDeviation.assign(isTracked_.size(), 0.0);
  answer.joints.resize(isTracked_.size());
  for (std::size_t joint = 0; joint < isTracked_.size(); ++joint) {
    answer.joints[joint] = isTracked_[joint] == 1 ? SolidJointState::Free : SolidJointState::Lost;
  }
  answer.way.resize(1);
  answer.way.front() = *step.to;
  answer.times.assign(1, 0.0);
  answer.contacts.clear();
  answer.contactsLeftOut = 0;
  answer.counters = {};
}

void SolidStream::fillHead(const StreamStep& step, SolidMessage& answer) const {
  constexpr std::uint64_t kMostBudget = std::uint64_t{1} << 61;
  answer.avatar = id_;
  answer.session = step.session;
  answer.sequence = step.sequenceTo;
  answer.utimeUs = step.utimeToUs;
  answer.kind = step.kind;
  answer.lost = step.lost;
  answer.stepUs = lengthOf(step);
  answer.avatarHash = avatarHash_;
  answer.skin = options().skin;
  answer.tolerance = options().tolerance;
  answer.catchUp = options().catchUp;
  answer.workBudget = static_cast<std::int64_t>(std::min(options().workBudget, kMostBudget));
}

void SolidStream::fillWay(SolidMessage& answer) const {
  const std::size_t numWay = tick_.numWay;
  if (numWay == 0 || numWay > kMaxSolidPoses) {
    answer.way.resize(1);
    answer.way.front() = tick_.shown;
    answer.times.assign(1, numWay == 0 ? 0.0 : 1.0);
    if (numWay == 0) return;
    answer.isCertified = false;
    answer.clearance = 0.0;
    return;
  }
  answer.way.resize(numWay);
  std::copy_n(tick_.way.begin(), numWay, answer.way.begin());
  answer.times.assign(tick_.times.begin(),
                      tick_.times.begin() + static_cast<std::ptrdiff_t>(numWay));
}

void SolidStream::fillContacts(SolidMessage& answer) const {
  const Skeleton& skeleton = solid_.avatar().skeleton();
  const Scene& scene = solid_.scene();
  const std::size_t listed = std::min(tick_.contacts.size(), kMaxSolidContacts);
  answer.contactsLeftOut = static_cast<std::int32_t>(tick_.contacts.size() - listed);
  answer.contacts.resize(listed);
  for (std::size_t i = 0; i < listed; ++i) {
    const SolidContact& contact = tick_.contacts[i];
    ShownContact& shown = answer.contacts[i];
    shown.contact = contact;
    shown.linkName = skeleton.name(contact.link);
    shown.otherName = contact.triangle >= 0
                          ? scene.objectNames()[slotOf(scene.object(contact.triangle))]
                          : skeleton.name(contact.other);
  }
}

}  // namespace foretouch
