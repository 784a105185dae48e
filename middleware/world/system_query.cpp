#include "middleware/world/system_query.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/contact.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/query_plan.h"
#include "middleware/pair/work_meter.h"

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
  scratch_.spans.poses(scratch_.origin, plan->isMerged(), scratch_.motions, poses);
  const ChainPoses &first = poses.chains[0], &second = poses.chains[1];
  if (plan->seen) {
    plan->seen->pose(first.from, scratch_.relativeFrom);
    plan->seen->pose(first.to, scratch_.relativeTo);
    scratch_.motion.assign(plan->seen->skeleton(), scratch_.relativeFrom, scratch_.relativeTo);
    return plan;
  }
  scratch_.motion.assign(plan->chains[0], first.from, first.to);
  if (!plan->isMerged()) scratch_.other.assign(plan->chains[1], second.from, second.to);
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
  const bool isTurned = this->isTurned(a, b);
  scratch_.meeting.clear();
  for (std::size_t k = 0; k < meeting.count; ++k) {
    const LssIndexPair& pair = meeting.pairs[k];
    scratch_.meeting.push_back(isTurned ? LssIndexPair{pair.j, pair.i} : pair);
  }
  scratch_.open.clear();
  for (PlanePair pair : open) {
    if (isTurned) std::swap(pair.i, pair.j);
    scratch_.open.push_back(pair);
  }
  answerAmong(plan);
  return keepAll(plan, a, b, first, found, counters);
}

void SystemQuery::askAgain(const SystemPlan& plan, BodyId a, const std::vector<WorldContact>& met,
                           std::size_t first, std::vector<WorldContact>& found,
                           QueryCounters& counters) {
  nameAll(plan, a, met);
  answerAmong(plan);
  keepAll(plan, a, kStillScene, first, found, counters);
}

bool SystemQuery::askAgainFrom(std::int64_t fromUs, const SystemPlan& plan, BodyId a,
                               const std::vector<WorldContact>& met, std::size_t first,
                               std::vector<WorldContact>& found, QueryCounters& counters) {
  const bool areTriangles = plan.one->options.surface.has_value();
  // Rounded down: not a moment of what is asked is left out.
  const double begin =
      std::nextafter(static_cast<double>(fromUs - scratch_.spans.beginUs()) /
                         static_cast<double>(scratch_.spans.endUs() - scratch_.spans.beginUs()),
                     0.0);
  if (areTriangles || !(begin > 0.0)) return false;
  nameAll(plan, a, met);
  const WorkMeter meter(work_);
  PairQuery query(plan.pair(), beginStep(plan), meter, scratch_.query.of<QueryMemory>());
  if (!query.runAmongFrom(begin, foundPairs(), scratch_.step)) return false;
  const std::size_t count = found.size();
  keepAll(plan, a, kStillScene, first, found, counters);
  for (std::size_t i = count; i < found.size(); ++i) {
    found[i].time = std::max(found[i].time, WorldTime{fromUs, 0.0});
  }
  return true;
}

void SystemQuery::nameAll(const SystemPlan& plan, BodyId a, const std::vector<WorldContact>& met) {
  const LssTable& table = plan.one->table;
  const LinkId root = plan.first[slotOf(scratch_.spans.placeOf(a))];
  scratch_.meeting.clear();
  scratch_.open.clear();
  for (const WorldContact& contact : met) {
    const LinkId one = root + contact.a.link, other = root + contact.b.link;
    for (std::int32_t i = table.first(one); i < table.first(one + 1); ++i) {
      for (std::int32_t j = table.first(other); j < table.first(other + 1); ++j) {
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
  if (plan.seen) {
    keepSeenFromMesh(plan, a, b, first, found);
  } else if (plan.query) {
    for (const LinkContact& contact : scratch_.step.links) {
      if (contact.verdict != Verdict::Clear) keep(ofScene(plan, a, contact), first, found);
    }
  }
  for (const PairContact& contact : scratch_.step.pairs) {
    if (!isUndone(b, contact)) keep(ofPair(plan, a, b, contact), first, found);
  }
  if (undoneFrom_ == 1.0) return true;
  const WorldTime from = worldTimeAt(scratch_.spans.beginUs(), scratch_.spans.endUs(), undoneFrom_);
  found.push_back(givenUp(a, b, from, UndecidedReason::WorkBudget));
  return false;
}

/// Only of two bodies: thousands of links of a heap are reported as one.
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
    answerStep(plan.query->plan(), scratch_.motion, WorkMeter(work_),
               scratch_.query.of<QueryMemory>(), scratch_.step);
  } else {
    const WorkMeter meter(work_);
    PairQuery(plan.pair(), beginStep(plan), meter, scratch_.query.of<QueryMemory>())
        .run(scratch_.step);
  }
}

void SystemQuery::answerAmong(const SystemPlan& plan) {
  const WorkMeter meter(work_);
  PairQuery(plan.pair(), beginStep(plan), meter, scratch_.query.of<QueryMemory>())
      .runAmong(foundPairs(), scratch_.step);
}

FoundPairs SystemQuery::foundPairs() const {
  return {scratch_.meeting.data(), scratch_.meeting.size(), scratch_.open.data(),
          scratch_.open.size()};
}

PairMotions SystemQuery::beginStep(const SystemPlan& plan) {
  beginAnswer(scratch_.step);
  const ChainMotion& other = plan.isMerged() ? scratch_.motion : scratch_.other;
  scratch_.query.of<QueryMemory>().beginStep(scratch_.motion, other);
  return {scratch_.motion, other};
}

bool SystemQuery::isTurned(BodyId a, BodyId b) const {
  return b != kStillScene && scratch_.spans.placeOf(b) < scratch_.spans.placeOf(a);
}

void SystemQuery::keepSeenFromMesh(const SystemPlan& plan, BodyId a, BodyId b, std::size_t first,
                                   std::vector<WorldContact>& found) {
  bool hasMotion = false;
  const LinkId mesh = plan.first[slotOf(scratch_.spans.placeOf(b))];
  const Skeleton& chain = plan.chains.front();
  for (LinkId link = 0; link < chain.numJoints(); ++link) {
    LinkContact contact = scratch_.step.links[slotOf(plan.seen->linkOf(link))];
    if (contact.verdict == Verdict::Clear || isUndone(b, contact)) continue;
    if (!hasMotion) {
      const ChainPoses& poses = scratch_.poses.chains[0];
      scratch_.ofSystem.assign(chain, poses.from, poses.to);
    }
    hasMotion = true;
    if (contact.verdict != Verdict::Undecided) {
      const LinkState state = scratch_.ofSystem.stateAt(mesh, contact.toi);
      contact.p_WLink = state.pointAt(contact.p_WLink);
      contact.p_WScene = state.pointAt(contact.p_WScene);
      contact.nhat_SL_W = state.R_WL * contact.nhat_SL_W;
    }
    contact.link = link;
    WorldContact kept = ofScene(plan, a, contact);
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

/// `link`: on its chain. The one LSS around a mesh is not reported.
ContactSide SystemQuery::sideOf(const SystemPlan& plan, BodyId body, LinkId link, std::int32_t lss,
                                std::int32_t triangle, const Eigen::Vector3d& p_W) const {
  const LinkId own = link - plan.first[slotOf(scratch_.spans.placeOf(body))];
  const bool isMesh = !world_.kindOf(body).avatar;
  return {body, own, isMesh ? -1 : lss, triangle, p_W};
}

WorldContact SystemQuery::ofScene(const SystemPlan& plan, BodyId a,
                                  const LinkContact& contact) const {
  WorldContact kept = inSpan(contact);
  kept.a = sideOf(plan, a, contact.link, contact.lss, contact.linkTriangle, contact.p_WLink);
  kept.b = {kStillScene, 0, -1, contact.triangle, contact.p_WScene};
  return kept;
}

WorldContact SystemQuery::ofPair(const SystemPlan& plan, BodyId a, BodyId b,
                                 const PairContact& contact) const {
  const BodyId one = isTurned(a, b) ? b : a, other = b == kStillScene || isTurned(a, b) ? a : b;
  WorldContact kept = inSpan(contact);
  kept.a = sideOf(plan, one, contact.link, contact.lss, contact.linkTriangle,
                  contact.p_WLink + scratch_.origin);
  kept.b = sideOf(plan, other, contact.other, contact.otherLss, contact.triangle,
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
