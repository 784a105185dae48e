#include "middleware/query/query.h"

#include <algorithm>
#include <utility>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/simd.h"
#include "middleware/pair/pair_query.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/query_plan.h"
#include "middleware/query/body.h"
#include "middleware/query/lane_query.h"
#include "middleware/query/scalar_query.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch {

namespace {

void linkQuery(const internal::QueryPlan& plan, const ChainMotion& motion,
               const internal::WorkMeter& meter, internal::QueryMemory& scratch,
               StepContacts& step) {
  if (plan.stepAnswerer != nullptr &&
      plan.stepAnswerer->answers(plan, motion, meter, scratch, step)) {
    return;
  }
  const internal::Body body(plan.avatar.lss(), plan.options.ignored);
  // For a skin, a single lane is slower than doubles.
  const bool isSingleLane = plan.blends && activeSimd() == Simd::Scalar;
  if (plan.inLanes && !isSingleLane) {
    internal::LaneQuery(plan, body, plan.laneTable(), motion, meter, scratch).run(step);
  } else {
    internal::scalarQuery(plan, body, motion, meter, scratch, step);
  }
}

/// Whether every link has an answer.
[[maybe_unused]] bool isAnswered(const StepContacts& step) {
  return std::none_of(step.links.begin(), step.links.end(), internal::isUnanswered);
}

/// Links that touch nothing before the earliest contact of all become AfterFirst, except those
/// without a surface.
void keepFirst(const internal::QueryPlan& plan, StepContacts& step) {
  double first = 1.0;
  bool isTouched = false;
  for (const LinkContact& contact : step.links) {
    if (contact.verdict == Verdict::Clear) continue;
    isTouched = true;
    first = std::min(first, contact.freeUntil);
  }
  if (!isTouched) return;
  for (LinkContact& contact : step.links) {
    if (contact.verdict != Verdict::Clear && contact.freeUntil <= first) continue;
    if (!plan.of(contact.link).hasSurface) continue;
    contact = undecidedContact(contact.link, first, UndecidedReason::AfterFirst);
  }
}

/// The least tolerance of all links, also of those that began nearer than theirs and left.
double leastTolerance(const internal::QueryPlan& plan, const internal::QueryMemory& scratch) {
  double least = plan.tolerances.least;
  if (!plan.inLanes) return least;
  for (const double own : scratch.lanes.tolerances) {
    if (own > 0.0) least = std::min(least, own);
  }
  return least;
}

}  // namespace

Result<Query> Query::build(const Avatar& avatar, const Scene& scene, const QueryOptions& options) {
  FORETOUCH_TRY(auto plan, internal::QueryPlan::make(avatar, scene, options));
  return Query(std::make_shared<const internal::QueryPlan>(std::move(plan)));
}

const Avatar& Query::avatar() const {
  return plan_->avatar;
}

const Scene& Query::scene() const {
  return plan_->scene;
}

const QueryOptions& Query::options() const {
  return plan_->options;
}

void internal::answerStep(const QueryPlan& plan, const ChainMotion& motion, const WorkMeter& meter,
                          QueryMemory& scratch, StepContacts& step) {
  beginAnswer(step);
  leaveUnanswered(plan.avatar.numLinks(), step.links);
  FORETOUCH_ASSERT(motion.numLinks() == plan.avatar.numLinks());
  if (motion.numLinks() != plan.avatar.numLinks()) return;
  scratch.beginStep(motion);
  linkQuery(plan, motion, meter, scratch, step);
  FORETOUCH_ASSERT(isAnswered(step));
  if (plan.options.scope == Scope::FirstOfAvatar) keepFirst(plan, step);
  step.provenClearance = kFloorShare * leastTolerance(plan, scratch);
  if (!plan.self.isAsked()) return;
  const PairPlan own{plan, plan, plan.self, plan.startShare, plan.scene.parts().origin};
  PairQuery(own, {motion, motion}, meter, scratch).run(step);
}

void Query::answer(const ChainMotion& motion, Scratch& scratch, StepContacts& step) const {
  internal::answerStep(*plan_, motion, internal::WorkMeter(plan_->options),
                       scratch.of<internal::QueryMemory>(), step);
}

ContactDetails Query::details(const ChainMotion& motion, const LinkContact& contact,
                              Scratch& scratch) const {
  return internal::detailsOf(*plan_, motion, contact, scratch.of<internal::QueryMemory>().found);
}

ContactDetails Query::details(const ChainMotion& motion, const PairContact& contact,
                              Scratch& /*scratch*/) const {
  return internal::detailsOf(*plan_, motion, contact);
}

StepContacts Query::answer(const ChainMotion& motion, Scratch& scratch) const {
  StepContacts step;
  answer(motion, scratch, step);
  return step;
}

Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                   const Scene& scene, const QueryOptions& options) {
  FORETOUCH_TRY(const auto query, Query::build(avatar, scene, options));
  if (motion.numLinks() != avatar.numLinks()) {
    return Error::in(
        "motion", ErrorCode::Mismatch,
        "expected a motion of this avatar's skeleton, found one with a different number of joints");
  }
  Scratch scratch;
  return query.answer(motion, scratch);
}

}  // namespace foretouch
