#include "middleware/world/system_query.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/counter_fields.h"
#include "middleware/query/scratch_parts.h"
#include "middleware/query/work_meter.h"

namespace foretouch::internal {
namespace {

void turnAround(WorldContact& contact) {
  std::swap(contact.a, contact.b);
  contact.nhat_BA_W = -contact.nhat_BA_W;
}

}  // namespace

bool areSameLinks(const WorldContact& x, const WorldContact& y) {
  return x.a.body == y.a.body && x.a.link == y.a.link && x.b.body == y.b.body &&
         x.b.link == y.b.link;
}

void keep(const WorldContact& contact, std::size_t first, std::vector<WorldContact>& found) {
  const auto earlier = found.begin() + static_cast<std::ptrdiff_t>(first);
  const bool isKnown = std::any_of(earlier, found.end(), [&](const WorldContact& known) {
    return areSameLinks(known, contact);
  });
  if (!isKnown) found.push_back(contact);
}

void addCounters(const QueryCounters& more, QueryCounters& sum) {
  for (const auto& field : kCounterFields) sum.*field.second += more.*field.second;
}

Result<const SystemPlan*> SystemQuery::prepare(SystemQuestion question, BodyId a, BodyId b) {
  FORETOUCH_TRY(const SystemPlan* const plan, plans_.planOf(world_, scratch_.spans, question, a, b,
                                                            scratch_.key, &scratch_.late));
  if (plan->isEmpty) return static_cast<const SystemPlan*>(nullptr);
  SystemPoses& poses = scratch_.poses;
  scratch_.origin = originOf(question);
  scratch_.spans.poses(scratch_.origin, scratch_.motions, poses);
  if (plan->chain) {
    plan->chain->pose(poses.from, scratch_.relativeFrom);
    plan->chain->pose(poses.to, scratch_.relativeTo);
    scratch_.motion.assign(plan->chain->skeleton(), scratch_.relativeFrom, scratch_.relativeTo);
  } else {
    scratch_.motion.assign(plan->skeleton, poses.from, poses.to);
  }
  return plan;
}

/// Scenes stay where they are, and what is seen from a mesh has no place of its own; all others are
/// looked at near the root of one.
Eigen::Vector3d SystemQuery::originOf(SystemQuestion question) const {
  if (question == SystemQuestion::Still || question == SystemQuestion::Mesh) {
    return Eigen::Vector3d::Zero();
  }
  return scratch_.spans.members().front().piece.from->translations[0];
}

bool SystemQuery::isResolved() const {
  return scratch_.poses.rounding <= kPartShare * world_.options.tolerance;
}

bool SystemQuery::ask(const SystemPlan& plan, BodyId a, BodyId b, std::size_t first,
                      std::vector<WorldContact>& found, QueryCounters& counters) {
  answer(plan);
  return keepAll(plan, a, b, first, found, counters);
}

bool SystemQuery::askAmong(const SystemPlan& plan, BodyId a, BodyId b, const MeetingPairs& meeting,
                           const std::vector<PlanePair>& open, std::size_t first,
                           std::vector<WorldContact>& found, QueryCounters& counters) {
  const LssTable& table = plan.plan->table;
  const auto offsetOf = [&](BodyId body) {
    return table.first(plan.first[slotOf(scratch_.spans.placeOf(body))]);
  };
  const std::int32_t ofA = offsetOf(a), ofB = offsetOf(b);
  const auto numbered = [&](std::int32_t i, std::int32_t j) {
    return LssIndexPair{std::min(ofA + i, ofB + j), std::max(ofA + i, ofB + j)};
  };
  scratch_.meeting.clear();
  for (std::size_t k = 0; k < meeting.count; ++k) {
    scratch_.meeting.push_back(numbered(meeting.pairs[k].i, meeting.pairs[k].j));
  }
  scratch_.open.clear();
  for (PlanePair pair : open) {
    const LssIndexPair both = numbered(pair.i, pair.j);
    pair.i = both.i;
    pair.j = both.j;
    scratch_.open.push_back(pair);
  }
  answerAmong(plan);
  return keepAll(plan, a, b, first, found, counters);
}

void SystemQuery::askAgain(const SystemPlan& plan, BodyId a, const std::vector<WorldContact>& met,
                           std::size_t first, std::vector<WorldContact>& found,
                           QueryCounters& counters) {
  nameAll(plan, met);
  answerAmong(plan);
  keepAll(plan, a, kStillScene, first, found, counters);
}

bool SystemQuery::askAgainFrom(std::int64_t fromUs, const SystemPlan& plan, BodyId a,
                               const std::vector<WorldContact>& met, std::size_t first,
                               std::vector<WorldContact>& found, QueryCounters& counters) {
  const bool areTriangles = plan.plan->options.surface.has_value();
  // Rounded down: not a moment of what is asked is left out.
  const double begin =
      std::nextafter(static_cast<double>(fromUs - scratch_.spans.beginUs()) /
                         static_cast<double>(scratch_.spans.endUs() - scratch_.spans.beginUs()),
                     0.0);
  if (areTriangles || !(begin > 0.0)) return false;
  nameAll(plan, met);
  beginStep();
  const WorkMeter meter(work_);
  SelfQuery query(*plan.plan, scratch_.motion, meter, scratch_.query.parts());
  if (!query.runAmongFrom(begin, foundPairs(), scratch_.step)) return false;
  const std::size_t count = found.size();
  keepAll(plan, a, kStillScene, first, found, counters);
  for (std::size_t i = count; i < found.size(); ++i) {
    found[i].time = std::max(found[i].time, WorldTime{fromUs, 0.0});
  }
  return true;
}

void SystemQuery::nameAll(const SystemPlan& plan, const std::vector<WorldContact>& met) {
  const LssTable& table = plan.plan->table;
  scratch_.meeting.clear();
  scratch_.open.clear();
  for (const WorldContact& contact : met) {
    for (std::int32_t i = table.first(contact.a.link); i < table.first(contact.a.link + 1); ++i) {
      for (std::int32_t j = table.first(contact.b.link); j < table.first(contact.b.link + 1); ++j) {
        scratch_.meeting.push_back({i, j});
        scratch_.open.push_back({i, j, 0, 0.0F, 0.0F, kEveryPiece});
      }
    }
  }
}

bool SystemQuery::keepAll(const SystemPlan& plan, BodyId a, BodyId b, std::size_t first,
                          std::vector<WorldContact>& found, QueryCounters& counters) {
  addCounters(scratch_.step.counters, counters);
  undoneFrom_ = 1.0;
  if (plan.chain) {
    keepSeenFromMesh(plan, a, b, first, found);
  } else if (plan.query) {
    for (const LinkContact& contact : scratch_.step.links) {
      if (contact.verdict != Verdict::Clear) keep(ofScene(plan, contact), first, found);
    }
  }
  for (const PairContact& contact : scratch_.step.pairs) {
    if (!isUndone(b, contact)) keep(ofPair(plan, contact), first, found);
  }
  if (undoneFrom_ == 1.0) return true;
  const WorldTime from = worldTimeAt(scratch_.spans.beginUs(), scratch_.spans.endUs(), undoneFrom_);
  found.push_back(givenUp(a, b, from, UndecidedReason::WorkBudget));
  return false;
}

/// Of two bodies: thousands of links of a heap are told as one.
bool SystemQuery::isUndone(BodyId b, const LinkContact& contact) {
  const bool isSpent =
      contact.verdict == Verdict::Undecided && contact.reason == UndecidedReason::WorkBudget;
  if (b == kStillScene || !isSpent) return false;
  undoneFrom_ = std::min(undoneFrom_, contact.freeUntil);
  return true;
}

/// Fills the step with what the plan's query says of the span.
void SystemQuery::answer(const SystemPlan& plan) {
  if (plan.query) {
    answerStep(plan.query->plan(), scratch_.motion, WorkMeter(work_), scratch_.query.parts(),
               scratch_.step);
  } else {
    beginStep();
    const WorkMeter meter(work_);
    SelfQuery(*plan.plan, scratch_.motion, meter, scratch_.query.parts()).run(scratch_.step);
  }
}

void SystemQuery::answerAmong(const SystemPlan& plan) {
  beginStep();
  const WorkMeter meter(work_);
  SelfQuery(*plan.plan, scratch_.motion, meter, scratch_.query.parts())
      .runAmong(foundPairs(), scratch_.step);
}

FoundPairs SystemQuery::foundPairs() const {
  return {scratch_.meeting.data(), scratch_.meeting.size(), scratch_.open.data(),
          scratch_.open.size()};
}

void SystemQuery::beginStep() {
  StepContacts& step = scratch_.step;
  step.links.clear();
  step.pairs.clear();
  step.counters = {};
  scratch_.query.parts().beginStep(scratch_.motion);
}

void SystemQuery::keepSeenFromMesh(const SystemPlan& plan, BodyId a, BodyId b, std::size_t first,
                                   std::vector<WorldContact>& found) {
  bool hasMotion = false;
  const LinkId mesh = plan.first[slotOf(scratch_.spans.placeOf(b))];
  for (LinkId link = 0; link < plan.skeleton.numJoints(); ++link) {
    LinkContact contact = scratch_.step.links[slotOf(plan.chain->linkOf(link))];
    if (contact.verdict == Verdict::Clear || isUndone(b, contact)) continue;
    if (!hasMotion) {
      scratch_.ofSystem.assign(plan.skeleton, scratch_.poses.from, scratch_.poses.to);
    }
    hasMotion = true;
    if (contact.verdict != Verdict::Undecided) {
      const LinkState state = scratch_.ofSystem.stateAt(mesh, contact.toi);
      contact.p_WLink = state.pointAt(contact.p_WLink);
      contact.p_WScene = state.pointAt(contact.p_WScene);
      contact.nhat_SL_W = state.R_WL * contact.nhat_SL_W;
    }
    contact.link = link;
    WorldContact kept = ofScene(plan, contact);
    kept.b.body = b;
    if (b < a) turnAround(kept);
    keep(kept, first, found);
  }
}

WorldContact SystemQuery::inSpan(const LinkContact& contact) const {
  WorldContact kept;
  kept.verdict = contact.verdict;
  kept.reason = contact.reason;
  kept.time = worldTimeAt(scratch_.spans.beginUs(), scratch_.spans.endUs(), contact.freeUntil);
  kept.separation = contact.separation;
  kept.penetration = contact.penetration;
  kept.nhat_BA_W = contact.nhat_SL_W;
  kept.isAssumed = scratch_.spans.isAssumed();
  return kept;
}

/// Of a link of the system; one LSS around a mesh tells nothing.
ContactSide SystemQuery::sideOf(const SystemPlan& plan, LinkId link, std::int32_t lss,
                                std::int32_t triangle, const Eigen::Vector3d& p_W) const {
  const MemberLink own = plan.memberLink(link);
  const SystemMember& member = scratch_.spans.members()[slotOf(own.member)];
  const bool isMesh = !world_.kinds[slotOf(member.kind)].avatar;
  return {member.body, own.link, isMesh ? -1 : lss, triangle, p_W};
}

WorldContact SystemQuery::ofScene(const SystemPlan& plan, const LinkContact& contact) const {
  WorldContact kept = inSpan(contact);
  kept.a = sideOf(plan, contact.link, contact.lss, contact.linkTriangle, contact.p_WLink);
  kept.b = {kStillScene, 0, -1, contact.triangle, contact.p_WScene};
  return kept;
}

WorldContact SystemQuery::ofPair(const SystemPlan& plan, const PairContact& contact) const {
  WorldContact kept = inSpan(contact);
  kept.a = sideOf(plan, contact.link, contact.lss, contact.linkTriangle,
                  contact.p_WLink + scratch_.origin);
  kept.b = sideOf(plan, contact.other, contact.otherLss, contact.triangle,
                  contact.p_WScene + scratch_.origin);
  if (kept.b.body < kept.a.body) turnAround(kept);
  return kept;
}

WorldContact SystemQuery::givenUp(BodyId a, BodyId b, const WorldTime& from,
                                  UndecidedReason reason) {
  WorldContact open;
  open.a.body = a;
  open.b.body = b;
  open.a.link = open.b.link = kEveryLink;
  open.reason = reason;
  open.time = from;
  if (b != kStillScene && b < a) turnAround(open);
  return open;
}

/// Doubles cannot tell the bodies' places between their knots well enough, or the work is spent.
void SystemQuery::giveUp(BodyId a, BodyId b, std::vector<WorldContact>& found,
                         UndecidedReason reason) const {
  found.push_back(givenUp(a, b, {scratch_.spans.beginUs(), 0.0}, reason));
}

}  // namespace foretouch::internal
