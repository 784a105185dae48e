#include "middleware/query/lane_query.h"

#include <algorithm>

#include "lss/index.h"
#include "middleware/pair/leaving.h"

namespace foretouch::internal {
namespace {

/// If work is limited: the share that goes on the step as if it were not. If that is too little, we
/// halve slabs: the cost of a slab before we do, and how often.
constexpr double kShareOfWhole = 0.875;
constexpr std::uint64_t kSlabWork = 2048;
constexpr int kMostHalvings = 6;

/// Whether the work was spent before the answer.
bool isSpent(const LinkContact& contact) {
  return contact.verdict == Verdict::Undecided && contact.reason == UndecidedReason::WorkBudget;
}

}  // namespace

LaneQuery::LaneQuery(const QueryPlan& plan, const Body& body, const LssTable& table,
                     const ChainMotion& motion, const WorkMeter& meter, QueryMemory& scratch)
    : plan_(plan),
      body_(body),
      table_(table),
      motion_(motion),
      lanes_(scratch.lanes),
      meter_(meter),
      cull_{plan, table, motion, scratch},
      link_(plan, body, table, motion, meter_, scratch) {}

void LaneQuery::run(StepContacts& step) {
  findWhoIsAsked(step);
  lanes_.touched.clear();
  lanes_.tolerances.clear();
  if (plan_.options.passSeparating || plan_.startShare > 0.0) {
    lanes_.tolerances.assign(countOf(body_.numLinks()), 0.0);
  }
  const int slabs =
      slabsOf(plan_.blends ? plan_.blends->carried() : table_, motion_, plan_.tolerances.least);
  if (meter_.isLimited()) {
    lanes_.freeUntil.assign(countOf(body_.numLinks()), 0.0);
    meter_.beginShare(kShareOfWhole, kSlabWork);
  }
  for (int slab = 0; slab < slabs; ++slab) {
    beginSlab(slab, slabs);
    if (!cull_.collect(begin_, end_, areAllAsked_, step.counters)) continue;
    if (!answerSlab(step)) return runInHalves(step, slab, slabs);
    if (plan_.options.scope != Scope::FirstOfAvatar) continue;
    if (const auto first = firstOf(step)) return leaveAfterFirst(*first, step);
  }
  leaveClear(step);
}

void LaneQuery::beginSlab(int slab, int count) {
  begin_ = static_cast<double>(slab) / count;
  end_ = static_cast<double>(slab + 1) / count;
  link_.beginSpan(begin_, end_);
}

/// Answers all links in the current slab; false if the work was spent before the last one.
bool LaneQuery::answerSlab(StepContacts& step) {
  float limit = LaneLink::kEnd;  // nothing later than this matters
  for (LinkId link = 0; link < body_.numLinks(); ++link) {
    if (!isNear(link)) continue;
    if (plan_.options.scope == Scope::EveryObject) {
      answerObjects(link, step);
      continue;
    }
    const auto i = slotOf(link);
    const LinkContact contact = answer(link, limit, step.counters);
    if (contact.verdict == Verdict::Clear) {
      if (meter_.isLimited()) lanes_.freeUntil[i] = link_.timeOf(limit);
      continue;
    }
    if (isSpent(contact)) return keepProven(contact);
    step.links[i] = contact;
    leaveOut(link);
    if (plan_.options.scope == Scope::FirstOfAvatar) {
      limit = std::min(limit, link_.lanesTimeOf(contact.freeUntil));
    }
  }
  return true;
}

/// The link's first contact in the current slab, beyond the one that it begins with and leaves.
LinkContact LaneQuery::answer(LinkId link, float limit, QueryCounters& counters) {
  if (plan_.startShare > 0.0 && begin_ == 0.0 && !(lanes_.tolerances[slotOf(link)] > 0.0)) {
    const LinkContact start = link_.answerAtStart(link, counters);
    if (start.verdict != Verdict::Clear && !mayLeave(start, plan_.startShare)) return start;
  }
  const LinkContact contact = link_.answer(link, limit, counters);
  if (!plan_.options.passSeparating || !recedes(contact)) return contact;
  return mayLeave(contact, kPassShare) ? link_.answer(link, limit, counters) : contact;
}

/// Whether the link begins apart, and goes on with a tolerance of its own.
bool LaneQuery::mayLeave(const LinkContact& contact, double share) {
  if (contact.verdict != Verdict::Contact || contact.toi != 0.0) return false;
  double& own = lanes_.tolerances[slotOf(contact.link)];
  own = leavingTolerance(contact.separation, plan_.of(contact.link).tolerance, share);
  return own > 0.0;
}

/// Whether, at the start, its witness point does not approach the scene's.
bool LaneQuery::recedes(const LinkContact& contact) const {
  if (contact.verdict != Verdict::Contact || contact.toi != 0.0) return false;
  const LinkState state = motion_.stateAt(contact.link, 0.0);
  return state.velocityOf(contact.p_WLink).dot(contact.nhat_SL_W) >= 0.0;
}

/// The link's first contact with each object in the current slab, one after the other: an object
/// that has had its own is left out of the next question.
void LaneQuery::answerObjects(LinkId link, StepContacts& step) {
  LinkContact& earliest = step.links[slotOf(link)];
  for (;;) {
    const LinkContact contact = answer(link, LaneLink::kEnd, step.counters);
    if (contact.verdict == Verdict::Clear) return;
    if (isUnanswered(earliest) || isReportedBefore(contact, earliest)) earliest = contact;
    step.perObject.push_back(contact);
    if (contact.verdict == Verdict::Undecided) return leaveOut(link);
    lanes_.touched.push_back({link, plan_.scene.object(contact.triangle)});
  }
}

/// Spends what is left of the work on the links that are still open in the current slab, the first
/// of `slabs` that was too much. Restarts costly slabs as two halves, so that some of the motion is
/// proven if the whole is too much.
void LaneQuery::runInHalves(StepContacts& step, int slab, int slabs) {
  const int finest = slabs << kMostHalvings;
  leaveFarFree();
  for (double& free : lanes_.freeUntil) free = std::max(free, begin_);
  slab *= 2;
  int count = 2 * slabs;
  while (slab < count) {
    if (meter_.isSpent(step.counters)) return leaveUndone(step);
    beginSlab(slab, count);
    meter_.beginPart(step.counters, count < finest ? kSlabWork : WorkMeter::kUnlimited);
    if (answerOpen(step)) {
      const auto first = firstOf(step);
      if (plan_.options.scope == Scope::FirstOfAvatar && first && *first <= end_) {
        return leaveAfterFirst(*first, step);
      }
      ++slab;
      while (count > slabs && slab % 2 == 0) {
        slab /= 2;
        count /= 2;
      }
    } else {
      slab *= 2;
      count *= 2;
    }
  }
  leaveClear(step);
}

/// Answers the open links in the current slab, each from where it is proven free; false if the
/// slab's work was spent before the last one.
bool LaneQuery::answerOpen(StepContacts& step) {
  if (!cull_.collect(begin_, end_, areAllAsked_, step.counters))
    std::fill(lanes_.first.begin(), lanes_.first.end(), 0U);
  leaveFarFree();
  for (LinkId link = 0; link < body_.numLinks(); ++link) {
    const auto i = slotOf(link);
    if (lanes_.isAsked[i] == 0 || lanes_.freeUntil[i] >= end_) continue;
    const LinkContact contact = answer(link, LaneLink::kEnd, step.counters);
    if (isSpent(contact)) return keepProven(contact);
    lanes_.freeUntil[i] = end_;
    if (contact.verdict == Verdict::Clear) continue;
    step.links[i] = contact;
    leaveOut(link);
  }
  return true;
}

/// Whether the link has hits in the current slab.
bool LaneQuery::isNear(LinkId link) const {
  return lanes_.first[slotOf(table_.first(link))] != lanes_.first[slotOf(table_.first(link + 1))];
}

/// Links without hits are free until the end of the current slab.
void LaneQuery::leaveFarFree() {
  for (LinkId link = 0; link < body_.numLinks(); ++link) {
    double& free = lanes_.freeUntil[slotOf(link)];
    if (!isNear(link)) free = std::max(free, end_);
  }
}

/// Always false: the link has no answer.
bool LaneQuery::keepProven(const LinkContact& undone) {
  double& free = lanes_.freeUntil[slotOf(undone.link)];
  free = std::max(free, undone.freeUntil);
  return false;
}

/// The earliest contact among the answered links; nothing if none touches.
std::optional<double> LaneQuery::firstOf(const StepContacts& step) const {
  std::optional<double> first;
  for (const LinkContact& contact : step.links) {
    if (lanes_.isAsked[slotOf(contact.link)] != 0) continue;
    if (contact.verdict == Verdict::Clear) continue;  // from the start
    first = std::min(first.value_or(contact.freeUntil), contact.freeUntil);
  }
  return first;
}

/// Precondition: all links are known to be free until then at least.
void LaneQuery::leaveAfterFirst(double first, StepContacts& step) const {
  for (LinkId link = 0; link < body_.numLinks(); ++link) {
    const auto i = slotOf(link);
    if (lanes_.isAsked[i] == 0) continue;
    step.links[i] = undecidedContact(link, first, UndecidedReason::AfterFirst);
  }
}

/// The whole step is done: links without an answer touch nothing.
void LaneQuery::leaveClear(StepContacts& step) const {
  for (LinkId link = 0; link < body_.numLinks(); ++link) {
    const auto i = slotOf(link);
    if (lanes_.isAsked[i] != 0 && isUnanswered(step.links[i])) answerClear(step.links[i]);
  }
  std::sort(step.perObject.begin(), step.perObject.end(), isReportedBefore);
}

/// Links without an answer are free as far as proven.
void LaneQuery::leaveUndone(StepContacts& step) const {
  for (LinkId link = 0; link < body_.numLinks(); ++link) {
    const auto i = slotOf(link);
    if (lanes_.isAsked[i] == 0) continue;
    const double free = lanes_.freeUntil[i];
    if (free >= 1.0) {
      answerClear(step.links[i]);
    } else {
      step.links[i] = undecidedContact(link, free, UndecidedReason::WorkBudget);
    }
  }
}

/// Answers links at once that are ignored altogether or have no surface: they have no contacts.
void LaneQuery::findWhoIsAsked(StepContacts& step) {
  lanes_.isAsked.assign(countOf(body_.numLinks()), 1);
  for (const IgnoredPair& pair : body_.ignored()) {
    if (pair.object == IgnoredPair::kEveryObject) {
      leaveOut(pair.link);
      answerClear(step.links[slotOf(pair.link)]);
    }
  }
  for (const LinkId link : table_.bareLinks()) {
    lanes_.isAsked[slotOf(link)] = 0;
    answerClear(step.links[slotOf(link)]);
  }
}

void LaneQuery::leaveOut(LinkId link) {
  lanes_.isAsked[slotOf(link)] = 0;
  areAllAsked_ = false;
}

}  // namespace foretouch::internal
