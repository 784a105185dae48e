#include "tools/replay/step_solver.h"

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "lss/index.h"
#include "tools/console.h"

namespace foretouch::tools {
namespace {

using Clock = std::chrono::steady_clock;

double microsecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

}  // namespace

Result<ReplayedStep> StepSolver::solve(std::int64_t step) {
  FORETOUCH_TRY(const auto from, poseAt(inputs_.steps.frameOf(step)));
  FORETOUCH_TRY(const auto to, poseAt(inputs_.steps.frameOf(step + 1)));

  const Clock::time_point start = Clock::now();
  const ChainMotion motion(inputs_.avatar.skeleton(), from, to);
  const StepContacts contacts = query_.answer(motion, scratch_);
  const double latencyUs = microsecondsSince(start);

  ReplayedStep replayed;
  replayed.answer = recorded(step, contacts, latencyUs);
  replayed.answer.missedByPoses = missedByPoses(motion, replayed.answer.contacts);
  findGround(motion, replayed.answer);
  findDepths(motion, replayed.answer);
  replayed.line = format_.line(replayed.answer);
  return replayed;
}

/// Keeps the last pose: the later pose of one step is the earlier one of the next.
Result<Pose> StepSolver::poseAt(std::int64_t frame) {
  if (frame != frame_) {
    FORETOUCH_TRY(pose_, poseAtFrame(inputs_, frame));
    frame_ = frame;
  }
  return pose_;
}

StepAnswer StepSolver::recorded(std::int64_t step, const StepContacts& contacts,
                                double latencyUs) const {
  StepAnswer answer;
  answer.step = step;
  answer.t0S = inputs_.timeOfStep(step);
  answer.t1S = inputs_.timeOfStep(step + 1);
  if (inputs_.clip.framesPerRow > 1) answer.row = inputs_.rowOfStep(step);
  for (const LinkId link : reported(contacts)) {
    answer.contacts.push_back(contacts.links[slotOf(link)]);
  }
  answer.objects = contacts.perObject;
  answer.pairs = contacts.pairs;
  answer.counters = contacts.counters;
  answer.latencyUs = std::round(10.0 * latencyUs) / 10.0;
  return answer;
}

std::vector<LinkId> StepSolver::missedByPoses(const ChainMotion& motion,
                                              const std::vector<LinkContact>& contacts) {
  const auto touches = [&](LinkId link, double t) {
    return query_.touchesAt(motion, link, t, scratch_);
  };
  std::vector<LinkId> missed;
  for (const LinkContact& contact : contacts) {
    if (contact.verdict == Verdict::Contact && !touches(contact.link, 0.0) &&
        !touches(contact.link, 1.0)) {
      missed.push_back(contact.link);
    }
  }
  return missed;
}

/// Finds the depths of own links that begin in each other by their triangles: the query does not.
void StepSolver::findDepths(const ChainMotion& motion, StepAnswer& answer) const {
  if (depths_ == nullptr) return;
  for (PairContact& pair : answer.pairs) {
    if (pair.verdict != Verdict::StartsInContact || pair.penetration > 0.0) continue;
    const LinkDepth depth = depths_->at(motion, 0.0, pair.link, pair.other, &pair.p_WScene);
    pair.penetration = depth.lower;
    pair.penetrationAtMost = depth.upper;
  }
}

void StepSolver::findGround(const ChainMotion& motion, StepAnswer& answer) {
  const bool isByObject = inputs_.query.scope == Scope::EveryObject;
  ground_.beginStep(motion);
  for (const LinkContact& contact : isByObject ? answer.objects : answer.contacts) {
    answer.onGround.push_back(ground_.isGround(contact));
  }
}

}  // namespace foretouch::tools
