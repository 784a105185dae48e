#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "articulated/raw_skeleton.h"
#include "articulated/try.h"
#include "network/stream/solid_answer.h"
#include "network/stream/stream_solver.h"

namespace foretouch {
namespace {

using SolidClock = std::chrono::steady_clock;

constexpr double kSolidUsPerS = 1e6;

std::int64_t lengthOf(const StreamStep& step) {
  if (step.kind == StepKind::First) return kFirstSolidStepUs;
  return std::clamp<std::int64_t>(step.utimeToUs - step.utimeFromUs, 1, kMostSolidStepUs);
}

}  // namespace

SolidStream::SolidStream(std::int32_t id, SolidAvatar solid)
    : id_(id),
      solid_(std::move(solid)),
      avatarHash_(skeletonHash(rawSkeleton(solid_.avatar().skeleton()))) {}

Result<SolidStream> SolidStream::make(std::int32_t id, const Avatar& avatar, const Scene& scene,
                                      const SolidOptions& options) {
  FORETOUCH_CHECK(internal::checkedJoints(avatar));
  FORETOUCH_TRY(auto solid, SolidAvatar::build(avatar, scene, options));
  return SolidStream(id, std::move(solid));
}

void SolidStream::follow(const StreamStep& step, SolidMessage& answer) {
  const SolidClock::time_point start = SolidClock::now();
  std::swap(before_, shown_);
  const bool isFirst = before_.rotations.empty();
  const bool areRoots =
      internal::findTracked(solid_.avatar().skeleton(), *step.unknownJoints, isTracked_);
  hasRoots_ = areRoots || hasRoots_;
  fillHead(step, answer);
  hasRoots_ ? tick(step, answer) : internal::fillSolidWait(*step.to, isTracked_, answer);
  shown_ = answer.shown();
  if (isFirst) before_ = shown_;
  answer.solidUs = std::chrono::duration<double, std::micro>(SolidClock::now() - start).count();
}

void SolidStream::tick(const StreamStep& step, SolidMessage& answer) {
  const double dtS = static_cast<double>(answer.stepUs) / kSolidUsPerS;
  const auto done = solid_.follow({*step.to, dtS, &isTracked_}, tick_);
  // The stream has checked the pose already. If the solver refuses it all the same, what was shown
  // stays; if there is nothing yet, nothing is claimed.
  if (!done.ok() && tick_.joints.empty()) {
    return internal::fillSolidWait(*step.to, isTracked_, answer);
  }
  if (!done.ok()) {
    tick_.numWay = 0;
    tick_.hasAppeared = false;
    tick_.state = tick_.isCertified ? SolidState::Held : tick_.state;
    tick_.contacts.clear();
    tick_.counters = {};
  }
  internal::fillSolidTick(tick_, solid_.avatar().skeleton(), solid_.scene(), answer);
}

void SolidStream::fillHead(const StreamStep& step, SolidMessage& answer) const {
  internal::fillSolidHead(id_, avatarHash_, options(), answer);
  answer.session = step.session;
  answer.sequence = step.sequenceTo;
  answer.utimeUs = step.utimeToUs;
  answer.kind = step.kind;
  answer.lost = step.lost;
  answer.stepUs = lengthOf(step);
}

}  // namespace foretouch
