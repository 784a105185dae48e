#include "middleware/solid/certifier.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "articulated/try.h"
#include "lss/index.h"
#include "lss/separation.h"
#include "middleware/near/near_places.h"
#include "middleware/pair/link_query.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/work_meter.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

/// How near a link or a pair may come, as a share of the gap with which it begins, if that is less
/// than the tolerance. So whatever is apart gets a true answer.
constexpr double kStartShare = 0.5;
/// Where a cut leaves the pair that was met: this share of the skin apart, or of the gap that it
/// began with if that is less.
constexpr double kCutSkin = 0.5, kCutGap = 0.95;
constexpr int kMostSections = 40;
constexpr double kCutResolution = 1e-13;
/// One less the cosine within which the closest points face each other along a triangle's normal.
constexpr double kFacing = 1e-9;
/// Without a hit to look at: this share of what is proven free.
constexpr double kFreeShare = 0.9;

Hull axisOf(const Lss& lss, const LinkState& state) {
  return Hull::segment(state.pointAt(lss.a), state.pointAt(lss.b));
}

}  // namespace

double ownRadii(const QueryPlan& plan, LinkId link, std::int32_t lss, LinkId other,
                std::int32_t otherLss) {
  const std::int32_t i = plan.table.first(link) + lss, j = plan.table.first(other) + otherLss;
  return plan.self.radiusShare(std::min(i, j), std::max(i, j)) *
         (plan.table[i].radius + plan.table[j].radius);
}

double gapOf(const QueryPlan& plan, const SolidHit& pair, const LinkState& atLink,
             const LinkState& atOther) {
  const Lss& lss = plan.avatar.lss(pair.link)[slotOf(pair.lss)];
  const Hull axis = axisOf(lss, atLink);
  if (pair.other == kNoParent) {
    const Hull triangle = Hull::of(plan.scene.triangle(pair.triangle));
    return separation(axis, triangle).lower() - lss.radius;
  }
  const Lss& other = plan.avatar.lss(pair.other)[slotOf(pair.otherLss)];
  return separation(axis, axisOf(other, atOther)).lower() -
         ownRadii(plan, pair.link, pair.lss, pair.other, pair.otherLss);
}

Result<Certifier> Certifier::build(const Avatar& avatar, const Scene& scene,
                                   const SolidOptions& options) {
  QueryOptions asked;
  asked.tolerance = options.tolerance;
  asked.ignored = options.ignored;
  asked.self = options.self;
  asked.scope = options.self ? Scope::EveryLink : Scope::FirstOfAvatar;
  FORETOUCH_TRY(auto plan, QueryPlan::make(avatar, scene, asked, kStartShare));
  return Certifier(std::make_shared<QueryPlan>(std::move(plan)), options.skin);
}

Certifier::Certifier(std::shared_ptr<QueryPlan> plan, double skin)
    : plan_(std::move(plan)), query_(plan_), skin_(skin) {}

void Certifier::beginTick(std::uint64_t work) {
  workLeft_ = work;
  workDone_ = 0;
  queries_ = 0;
}

void Certifier::spend(std::uint64_t work) {
  workDone_ += work;
  workLeft_ -= std::min(work, workLeft_);
}

Certified Certifier::certify(const Pose& from, const Pose& to, Pose& reached) {
  Certified answer = ask(from, to);
  if (answer.isClear) {
    reached = to;
    return answer;
  }
  if (!(answer.share > 0.0)) {
    reached = from;
    return answer;
  }
  motion_.poseAt(answer.share, reached);
  // The way to that pose is the proven one but for rounding, which the proof's margin covers where
  // it is not absurdly small beside the coordinates.
  if (roundingOfMotion() > 0.25 * answer.clearance) {
    const Certified again = ask(from, reached);
    if (!again.isClear) {
      answer.share = 0.0;
      answer.clearance = 0.0;
      reached = from;
    }
  }
  return answer;
}

bool Certifier::isClear(const Pose& from, const Pose& to) {
  return ask(from, to).isClear;
}

double Certifier::clearanceAt(const Pose& place) {
  const Certified answer = ask(place, place);
  return answer.isClear ? answer.clearance : 0.0;
}

OwnTouch Certifier::ownTouchAt(const Pose& place) {
  OwnTouch answer;
  if (workLeft_ == 0) return answer;
  run(place, place);
  answer.isAnswered = step_.arePairsAnswered;
  for (const PairContact& contact : step_.pairs) {
    if (contact.verdict == Verdict::Clear) continue;
    if (contact.verdict == Verdict::Undecided) answer.isAnswered = false;
    answer.touches = true;
    answer.link = contact.link;
    answer.other = contact.other;
    break;
  }
  return answer;
}

/// Fills step_.
void Certifier::run(const Pose& from, const Pose& to) {
  const PhaseScope scope(phases_, SolidPhase::Prove);
  plan_->options.workBudget = workLeft_;
  motion_.assign(plan_->avatar.skeleton(), from, to);
  query_.answer(motion_, scratch_, step_);
  ++queries_;
  spend(WorkMeter::workOf(step_.counters));
}

Certified Certifier::ask(const Pose& from, const Pose& to) {
  Certified answer;
  if (workLeft_ == 0) {
    answer.isOverBudget = true;
    return answer;
  }
  run(from, to);
  double free = 1.0;
  const auto look = [&](const LinkContact& contact, LinkId other, std::int32_t otherLss) {
    if (contact.verdict == Verdict::Clear) return;
    if (contact.reason == UndecidedReason::WorkBudget) answer.isOverBudget = true;
    if (contact.verdict == Verdict::StartsInContact) answer.isInside = true;
    const bool isTouch = contact.verdict != Verdict::Undecided;
    if (contact.freeUntil > free || (contact.freeUntil == free && (!isTouch || answer.hasHit))) {
      return;
    }
    free = contact.freeUntil;
    answer.hasHit = isTouch;
    if (isTouch) answer.hit = {contact.link, contact.lss, contact.triangle, other, otherLss};
  };
  bool areAllClear = true;
  for (const LinkContact& contact : step_.links) {
    areAllClear = areAllClear && contact.verdict == Verdict::Clear;
    look(contact, kNoParent, -1);
  }
  for (const PairContact& contact : step_.pairs) {
    areAllClear = areAllClear && contact.verdict == Verdict::Clear;
    look(contact, contact.other, contact.otherLss);
  }
  if (plan_->self.isAsked() && !step_.arePairsAnswered) {
    areAllClear = false;
    free = 0.0;
  }
  answer.clearance = step_.provenClearance;
  answer.isClear = areAllClear;
  answer.share = areAllClear ? 1.0 : 0.0;
  if (!areAllClear && free > 0.0) cut(answer, free);
  return answer;
}

/// Goes back from the first contact until the pair that meets there is well apart.
void Certifier::cut(Certified& answer, double toi) {
  const PhaseScope scope(phases_, SolidPhase::Prove);
  if (!answer.hasHit) {
    answer.share = kFreeShare * toi;
    return;
  }
  evaluator_.reset(motion_);
  findSheet(answer.hit, toi);
  double atStart = gapAt(answer.hit, 0.0);
  if (sheet_.isMet && !(atStart > 0.0)) {
    sheet_.isMet = false;
    atStart = gapAt(answer.hit, 0.0);
  }
  const double wanted = std::min(kCutSkin * skin_, kCutGap * atStart);
  // False position, which keeps its bracket ([Dowell71], REFERENCES.md): to the last bits, so that
  // the place of the cut depends on the pair alone, not on how the query's floats round.
  double apart = 0.0, near = toi;
  double overApart = atStart - wanted, overNear = gapAt(answer.hit, toi) - wanted;
  if (overNear >= 0.0) apart = toi;
  int side = 0;
  for (int i = 0; i < kMostSections && near - apart > kCutResolution * toi; ++i) {
    const double between = overApart > overNear ? overApart / (overApart - overNear) : 0.5;
    const double t = apart + std::clamp(between, 0.0, 1.0) * (near - apart);
    const double middle = t > apart && t < near ? t : 0.5 * (apart + near);
    const double over = gapAt(answer.hit, middle) - wanted;
    if (over >= 0.0) {
      apart = middle;
      overApart = over;
      if (side > 0) overNear *= 0.5;  // kept twice
      side = 1;
    } else {
      near = middle;
      overNear = over;
      if (side < 0) overApart *= 0.5;
      side = -1;
    }
  }
  answer.share = apart;
}

/// What an LSS meets of a flat surface is its plane, whichever of its triangles is named: so the
/// place of the cut does not depend on how the surface is cut into triangles.
void Certifier::findSheet(const SolidHit& hit, double toi) {
  sheet_.isMet = false;
  if (hit.other != kNoParent) return;
  const Lss& lss = plan_->avatar.lss(hit.link)[slotOf(hit.lss)];
  const LinkState state = evaluator_.stateAt(hit.link, toi);
  const StandingLss standing{
      hit.link, hit.lss, state.pointAt(lss.a), state.pointAt(lss.b), lss.radius, 0.0, 0.0};
  const Triangle& triangle = plan_->scene.triangle(hit.triangle);
  const auto& v = triangle.vertices;
  const Eigen::Vector3d normal = (v[1] - v[0]).cross(v[2] - v[0]);
  const double length = normal.norm();
  const NearPlace place =
      closestPlace(standing, triangle, hit.triangle, plan_->scene.parts().flatEdges());
  const double along = place.feature.nhat_SL_W.dot(normal);
  const bool isFacing = std::abs(along) >= (1.0 - kFacing) * length;
  if (!(length > 0.0) || !(isFacing || !place.stands)) return;
  sheet_ = {true, v[0], (along < 0.0 ? -1.0 : 1.0) / length * normal};
}

/// The gap at `t` of the motion; that of the sheet, where one is met.
double Certifier::gapAt(const SolidHit& hit, double t) {
  const LinkState atLink = evaluator_.stateAt(hit.link, t);
  if (sheet_.isMet) {
    const Lss& lss = plan_->avatar.lss(hit.link)[slotOf(hit.lss)];
    const double a = sheet_.n.dot(atLink.pointAt(lss.a) - sheet_.p),
                 b = sheet_.n.dot(atLink.pointAt(lss.b) - sheet_.p);
    return std::min(a, b) - lss.radius;
  }
  return gapOf(*plan_, hit, atLink,
               hit.other == kNoParent ? atLink : evaluator_.stateAt(hit.other, t));
}

/// The rounding of any point of the avatar, wherever the motion places it.
double Certifier::roundingOfMotion() const {
  double most = 0.0;
  for (std::int32_t i = 0; i < plan_->table.size(); ++i) {
    const auto& entry = plan_->table[i];
    const double rho = std::max(entry.rhoA, entry.rhoB);
    most = std::max(most, motion_.bounds(entry.link).positionRoundingAt(rho));
  }
  return 4.0 * most;
}

}  // namespace foretouch::internal
