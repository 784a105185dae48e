#include "middleware/world/world_query.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "articulated/try.h"
#include "middleware/counter_fields.h"
#include "middleware/query/scratch_parts.h"
#include "middleware/query/self_query.h"
#include "middleware/query/work_meter.h"
#include "middleware/world/body_boxes.h"
#include "middleware/world/box_sweep.h"
#include "middleware/world/system_plan.h"
#include "middleware/world/world_parts.h"

namespace foretouch {

namespace internal {

struct WorldScratchParts {
  std::uint64_t world = 0;  // whose this is
  SystemPlans plans;
  PieceMotions motions;
  SweepScratch sweep;
  std::vector<BodySweep> sweeps;  // per body
  std::vector<BodyBox> boxes;     // per body, of the whole window
  BoxSweep broad;
  std::vector<MeetingBodies> meeting;
  // Of the pair or body at hand.
  SystemSpans spans;
  SystemPoses poses;
  Pose relativeFrom, relativeTo;
  ChainMotion motion, ofSystem;
  StepContacts step;
  QueryScratch query;
};

namespace {

bool comesBefore(const WorldContact& x, const WorldContact& y) {
  if (!(x.time == y.time)) return x.time < y.time;
  return std::tie(x.a.body, x.a.link, x.b.body, x.b.link) <
         std::tie(y.a.body, y.a.link, y.b.body, y.b.link);
}

void addCounters(const QueryCounters& more, QueryCounters& sum) {
  for (const auto& field : kCounterFields) sum.*field.second += more.*field.second;
}

/// One window.
class WorldQuery {
 public:
  WorldQuery(const WorldParts& world, std::int64_t fromUs, std::int64_t toUs,
             WorldScratchParts& scratch, WorldContacts& answer)
      : world_(world), fromUs_(fromUs), toUs_(toUs), scratch_(scratch), answer_(answer) {}

  Result<Done> run() {
    answer_.contacts.clear();
    answer_.silent.clear();
    answer_.counters = {};
    if (scratch_.world != world_.identity) {
      scratch_.plans.clear();
      scratch_.motions.ofBody.clear();
      scratch_.world = world_.identity;
    }
    tellSilent();
    FORETOUCH_CHECK(sweepBodies());
    for (BodyId body = 0; body < numBodies(); ++body) FORETOUCH_CHECK(askAlone(body));
    scratch_.broad.collect(scratch_.boxes, scratch_.meeting);
    for (const MeetingBodies& pair : scratch_.meeting) FORETOUCH_CHECK(askPair(pair.a, pair.b));
    std::sort(answer_.contacts.begin(), answer_.contacts.end(), comesBefore);
    return Done{};
  }

 private:
  [[nodiscard]] BodyId numBodies() const { return static_cast<BodyId>(world_.bodies.size()); }

  void tellSilent() {
    for (BodyId id = 0; id < numBodies(); ++id) {
      const WorldBody& body = world_.body(id);
      if (body.episodes.empty() || body.episodes.back().isHeldFast()) continue;
      const std::int64_t last = body.episodes.back().track.knownUntilUs();
      if (last >= toUs_) continue;
      answer_.silent.push_back({id, std::max(last, fromUs_), body.options.whenSilent});
    }
  }

  /// Near the bodies, so that floats resolve them.
  [[nodiscard]] Eigen::Vector3d windowOrigin() const {
    for (const WorldBody& body : world_.bodies) {
      const Episode* const episode = body.episodeAt(fromUs_);
      if (episode == nullptr || episode->carrier) continue;
      return episode->track.pieceAt(fromUs_).from->translations[0];
    }
    return Eigen::Vector3d::Zero();
  }

  Result<Done> sweepBodies() {
    const Eigen::Vector3d origin = windowOrigin();
    scratch_.sweeps.resize(countOf(numBodies()));
    scratch_.boxes.resize(countOf(numBodies()));
    for (BodyId id = 0; id < numBodies(); ++id) {
      BodySweep& sweep = scratch_.sweeps[slotOf(id)];
      FORETOUCH_CHECK(sweepBody(world_, id, fromUs_, toUs_, origin, scratch_.plans,
                                scratch_.motions, scratch_.sweep, sweep));
      scratch_.boxes[slotOf(id)] = sweep.whole;
      answer_.counters.bodies += sweep.whole.isEmpty() ? 0 : 1;
    }
    return Done{};
  }

  /// The static scene, and own links.
  Result<Done> askAlone(BodyId body) {
    const bool isStill = world_.isStillAsked(body);
    if (!isStill && !world_.body(body).options.self) return Done{};
    return askSpans(body, kStillScene, isStill ? SystemQuestion::Still : SystemQuestion::Self);
  }

  Result<Done> askPair(BodyId a, BodyId b) {
    if (!world_.isAsked(a, b)) return Done{};
    ++answer_.counters.pairs;
    if (!scratch_.sweeps[slotOf(a)].isNear(scratch_.sweeps[slotOf(b)])) return Done{};
    ++answer_.counters.nearPairs;
    // A mesh is what the other one is seen from.
    if (!world_.kindOf(a).avatar) return askSpans(b, a, SystemQuestion::Mesh);
    return askSpans(a, b, world_.kindOf(b).avatar ? SystemQuestion::Pair : SystemQuestion::Mesh);
  }

  /// Span by span, until nothing is known any more.
  Result<Done> askSpans(BodyId a, BodyId b, SystemQuestion question) {
    const std::size_t first = answer_.contacts.size();
    SystemSpans& spans = scratch_.spans;
    spans.begin(world_, a, b, fromUs_, toUs_);
    while (spans.next()) {
      if (b != kStillScene && !isNearInSpan(a, b)) continue;
      FORETOUCH_TRY(const SystemPlan* const plan,
                    scratch_.plans.planOf(world_, spans, question, a, b));
      if (plan->isEmpty) continue;
      ++answer_.counters.spans;
      const Eigen::Vector3d origin = originOf(question);
      spans.poses(origin, scratch_.motions, scratch_.poses);
      if (scratch_.poses.rounding > kPartShare * world_.options.tolerance) {
        giveUp(a, b);
        break;
      }
      ask(*plan);
      keepAnswers(*plan, a, b, origin, first);
    }
    return Done{};
  }

  [[nodiscard]] bool isNearInSpan(BodyId a, BodyId b) const {
    return scratch_.sweeps[slotOf(a)].isNearIn(scratch_.sweeps[slotOf(b)], scratch_.spans.beginUs(),
                                               scratch_.spans.endUs());
  }

  /// Scenes stay where they are, and what is seen from a mesh has no place of its own; two bodies
  /// are looked at near the root of one.
  [[nodiscard]] Eigen::Vector3d originOf(SystemQuestion question) const {
    if (question == SystemQuestion::Still || question == SystemQuestion::Mesh) {
      return Eigen::Vector3d::Zero();
    }
    const std::int64_t beginUs = scratch_.spans.beginUs();
    const WorldBody& root = world_.body(scratch_.spans.members().front().body);
    return root.episodeAt(beginUs)->track.pieceAt(beginUs).from->translations[0];
  }

  /// Fills the step with what the plan's query says of the span.
  void ask(const SystemPlan& plan) {
    StepContacts& step = scratch_.step;
    const SystemPoses& poses = scratch_.poses;
    if (plan.chain) {
      plan.chain->pose(poses.from, scratch_.relativeFrom);
      plan.chain->pose(poses.to, scratch_.relativeTo);
      scratch_.motion.assign(plan.chain->skeleton(), scratch_.relativeFrom, scratch_.relativeTo);
    } else {
      scratch_.motion.assign(plan.skeleton, poses.from, poses.to);
    }
    if (plan.query) {
      plan.query->answer(scratch_.motion, scratch_.query, step);
    } else {
      step.links.clear();
      step.pairs.clear();
      step.counters = {};
      scratch_.query.parts().beginStep(scratch_.motion);
      const WorkMeter meter(plan.plan->options);
      SelfQuery(*plan.plan, scratch_.motion, meter, scratch_.query.parts()).run(step);
    }
    addCounters(step.counters, answer_.counters.queries);
  }

  void keepAnswers(const SystemPlan& plan, BodyId a, BodyId b, const Eigen::Vector3d& origin,
                   std::size_t first) {
    if (plan.chain) {
      keepSeenFromMesh(plan, a, b, first);
    } else if (plan.query) {
      for (const LinkContact& contact : scratch_.step.links) {
        if (contact.verdict != Verdict::Clear) keep(ofScene(plan, a, contact), first);
      }
    }
    for (const PairContact& contact : scratch_.step.pairs) {
      keep(ofPair(plan, contact, origin), first);
    }
  }

  void keepSeenFromMesh(const SystemPlan& plan, BodyId a, BodyId b, std::size_t first) {
    bool hasMotion = false;
    const LinkId mesh = plan.first[slotOf(scratch_.spans.placeOf(b))];
    for (LinkId link = 0; link < plan.skeleton.numJoints(); ++link) {
      LinkContact contact = scratch_.step.links[slotOf(plan.chain->linkOf(link))];
      if (contact.verdict == Verdict::Clear) continue;
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
      WorldContact kept = ofScene(plan, a, contact);
      kept.b.body = b;
      if (b < a) turnAround(kept);
      keep(kept, first);
    }
  }

  [[nodiscard]] WorldContact inSpan(const LinkContact& contact) const {
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

  [[nodiscard]] WorldContact ofScene(const SystemPlan& plan, BodyId a,
                                     const LinkContact& contact) const {
    WorldContact kept = inSpan(contact);
    kept.a = {a, plan.memberLink(contact.link).link, contact.lss, -1, contact.p_WLink};
    kept.b = {kStillScene, 0, -1, contact.triangle, contact.p_WScene};
    return kept;
  }

  [[nodiscard]] WorldContact ofPair(const SystemPlan& plan, const PairContact& contact,
                                    const Eigen::Vector3d& origin) const {
    const std::vector<SystemMember>& members = scratch_.spans.members();
    const MemberLink one = plan.memberLink(contact.link), other = plan.memberLink(contact.other);
    WorldContact kept = inSpan(contact);
    kept.a = {members[slotOf(one.member)].body, one.link, contact.lss, -1,
              contact.p_WLink + origin};
    kept.b = {members[slotOf(other.member)].body, other.link, contact.otherLss, -1,
              contact.p_WScene + origin};
    if (kept.b.body < kept.a.body) turnAround(kept);
    return kept;
  }

  static void turnAround(WorldContact& contact) {
    std::swap(contact.a, contact.b);
    contact.nhat_BA_W = -contact.nhat_BA_W;
  }

  /// Unless the two had theirs in an earlier span.
  void keep(const WorldContact& contact, std::size_t first) {
    for (std::size_t i = first; i < answer_.contacts.size(); ++i) {
      const WorldContact& earlier = answer_.contacts[i];
      if (earlier.a.body == contact.a.body && earlier.a.link == contact.a.link &&
          earlier.b.body == contact.b.body && earlier.b.link == contact.b.link) {
        return;
      }
    }
    answer_.contacts.push_back(contact);
  }

  /// Doubles cannot tell the bodies' places between their knots well enough.
  void giveUp(BodyId a, BodyId b) {
    WorldContact open;
    open.a.body = a;
    open.b.body = b;
    open.a.link = open.b.link = kEveryLink;
    open.reason = UndecidedReason::Resolution;
    open.time = {scratch_.spans.beginUs(), 0.0};
    if (b != kStillScene && b < a) turnAround(open);
    answer_.contacts.push_back(open);
  }

  const WorldParts& world_;
  std::int64_t fromUs_, toUs_;
  WorldScratchParts& scratch_;
  WorldContacts& answer_;
};

}  // namespace
}  // namespace internal

namespace {

Error windowError(ErrorCode code, std::int64_t fromUs, std::int64_t toUs, const std::string& what) {
  return Error::in(
      "window", code,
      "the window from " + std::to_string(fromUs) + " to " + std::to_string(toUs) + " us " + what);
}

Result<Done> checkedWindow(const World& world, std::int64_t fromUs, std::int64_t toUs) {
  if (fromUs >= toUs || fromUs < -kMostUtimeUs || toUs > kMostUtimeUs) {
    return windowError(ErrorCode::OutOfRange, fromUs, toUs,
                       "has no length, or no legal instants; expected from < to");
  }
  const std::int64_t forgotten = world.parts().forgottenUs;
  if (fromUs < forgotten) {
    return windowError(
        ErrorCode::OutOfRange, fromUs, toUs,
        "begins before " + std::to_string(forgotten) + " us; all before that is forgotten");
  }
  const auto known = world.knownUntilUs();
  if (known && toUs <= *known) return Done{};
  if (!known) {
    return windowError(ErrorCode::Empty, fromUs, toUs, "has no body in it; expected a pose of one");
  }
  const auto slowest = world.waitsFor();
  return windowError(ErrorCode::OutOfRange, fromUs, toUs,
                     "ends after what is known, until " + std::to_string(*known) + " us" +
                         (slowest ? ", of body " + std::to_string(*slowest) : std::string()));
}

}  // namespace

WorldScratch::WorldScratch() : parts_(std::make_unique<internal::WorldScratchParts>()) {}
WorldScratch::~WorldScratch() = default;
WorldScratch::WorldScratch(WorldScratch&&) noexcept = default;
WorldScratch& WorldScratch::operator=(WorldScratch&&) noexcept = default;

Result<Done> worldContacts(const World& world, std::int64_t fromUs, std::int64_t toUs,
                           WorldScratch& scratch, WorldContacts& answer) {
  FORETOUCH_CHECK(checkedWindow(world, fromUs, toUs));
  return internal::WorldQuery(world.parts(), fromUs, toUs, scratch.parts(), answer).run();
}

}  // namespace foretouch
