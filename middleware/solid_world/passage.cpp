#include "middleware/solid_world/passage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/solid/tree_pose.h"

namespace foretouch::internal {
namespace {

/// A cut motion keeps this share of what is proven free: the rest is room for the next one.
constexpr double kCutShare = 0.9;

std::int64_t instantAt(const TimedMotion& motion, double share) {
  const double length = static_cast<double>(motion.endUs - motion.beginUs);
  return motion.beginUs + static_cast<std::int64_t>(std::floor(share * length));
}

}  // namespace

bool Surroundings::isPassed(BodyId body) const {
  return std::find(passed.begin(), passed.end(), body) != passed.end();
}

Result<PassageProver> PassageProver::build(const Avatar& avatar, const Scene& scene,
                                           const SolidOptions& options) {
  FORETOUCH_TRY(auto certifier, Certifier::build(avatar, scene, options));
  return PassageProver(avatar, std::move(certifier), options);
}

PassageProver::PassageProver(const Avatar& avatar, Certifier certifier, const SolidOptions& options)
    : avatar_(avatar),
      certifier_(std::make_unique<Certifier>(std::move(certifier))),
      tolerance_(options.tolerance) {
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    volumes_.push_back(avatar.lss(link));
    for (const Lss& lss : avatar.lss(link)) {
      rho_ = std::max(rho_, std::max(lss.a.norm(), lss.b.norm()) + lss.radius);
    }
  }
  rho_ *= kInflation;
}

void PassageProver::beginTick(std::uint64_t work) {
  certifier_->beginTick(work);
  questions_ = 0;
}

Result<const AroundPlan*> PassageProver::planOf(const AroundKind& kind) {
  const auto i = slotOf(kind.number);
  if (plans_.size() <= i) plans_.resize(i + 1);
  if (!plans_[i]) {
    FORETOUCH_TRY(auto plan, AroundPlan::make(avatar_, kind, tolerance_));
    plans_[i] = std::make_unique<AroundPlan>(std::move(plan));
  }
  return plans_[i].get();
}

const AroundPlan& PassageProver::known(const AroundKind& kind) const {
  return *plans_[slotOf(kind.number)];
}

void PassageProver::forget(std::int32_t kindNumber) {
  if (plans_.size() > slotOf(kindNumber)) plans_[slotOf(kindNumber)].reset();
}

Result<Done> PassageProver::prepare(const Surroundings& around) {
  for (const AroundBody* const body : around.bodies) {
    for (std::size_t i = 0; i < body->numLegs(); ++i) {
      FORETOUCH_CHECK(planOf(*body->leg(i).kind));
    }
  }
  return Done{};
}

Passage PassageProver::ask(const TimedMotion& motion, const Surroundings& around) {
  Passage passage;
  passage.isClear = true;
  passage.freeUntilUs = motion.endUs;
  // An avatar that stays touches nothing that stays.
  if (!isSamePose(motion.from, motion.to)) askScene(motion, passage);
  askBodies(motion, around, passage);
  if (passage.isClear && motion.endUs < around.endUs) askToStay(motion, around, passage);
  return passage;
}

Passage PassageProver::askPart(const TimedMotion& motion, const Surroundings& around) {
  Passage passage;
  passage.isClear = true;
  passage.freeUntilUs = motion.endUs;
  askBodies(motion, around, passage);
  return passage;
}

void PassageProver::askBodies(const TimedMotion& motion, const Surroundings& around,
                              Passage& passage) {
  const bool isRefuge =
      isSamePose(motion.from, motion.to) && isSamePose(motion.from, around.fallback);
  whole_.assign(avatar_.skeleton(), motion.from, motion.to);
  const Eigen::AlignedBox3d swept = sweptBox(volumes_, whole_, states_);
  for (const AroundBody* const body : around.bodies) {
    if (around.isPassed(body->body) || (isRefuge && body->isSolid)) continue;
    const double apart = swept.exteriorDistance(body->box());
    if (apart > 2.0 * tolerance_) {
      passage.clearance = std::min(passage.clearance, tolerance_);
      continue;
    }
    askBody(motion, *body, passage);
  }
}

void PassageProver::askScene(const TimedMotion& motion, Passage& passage) {
  const Certified answer = certifier_->certify(motion.from, motion.to, reachedInScene_);
  passage.clearance = std::min(passage.clearance, answer.clearance);
  passage.isOverBudget = answer.isOverBudget;
  if (answer.isClear) return;
  passage.isClear = false;
  passage.freeUntilUs = instantAt(motion, answer.share);
  if (answer.hasHit) passage.link = answer.hit.link;
}

void PassageProver::askBody(const TimedMotion& motion, const AroundBody& body, Passage& passage) {
  for (std::size_t i = 0; i < body.numLegs(); ++i) {
    const AroundLeg& leg = body.leg(i);
    if (leg.endUs <= motion.beginUs) continue;
    if (leg.beginUs >= passage.freeUntilUs) return;
    askLeg(motion, body, leg, passage);
  }
}

void PassageProver::askLeg(const TimedMotion& motion, const AroundBody& body, const AroundLeg& leg,
                           Passage& passage) {
  const std::int64_t beginUs = std::max(motion.beginUs, leg.beginUs);
  const std::int64_t endUs = std::min(motion.endUs, leg.endUs);
  double off = leg.rounding;
  off += ofOne_.cut(avatar_.skeleton(), motion.from, motion.to, motion.beginUs, motion.endUs,
                    beginUs, endUs, rho_);
  off += ofOther_.cut(leg.kind->skeleton, leg.from, leg.to, leg.beginUs, leg.endUs, beginUs, endUs,
                      leg.kind->rho);
  ++questions_;
  const PairAnswer answer = known(*leg.kind).ask(ofOne_.from(), ofOne_.to(), ofOther_.from(),
                                                 ofOther_.to(), off, scratch_);
  passage.clearance = std::min(passage.clearance, answer.clearance);
  if (answer.isClear) return;
  const std::int64_t untilUs = instantAt({motion.from, motion.to, beginUs, endUs}, answer.share);
  if (!passage.isClear && untilUs >= passage.freeUntilUs) return;
  passage.isClear = false;
  passage.freeUntilUs = untilUs;
  passage.blocker = &body;
  passage.link = answer.link;
  passage.other = std::max(answer.other - leg.kind->first, 0);
  passage.isInside = answer.isInside && beginUs == motion.beginUs;
}

/// Other solid avatars have counted on those that they saw standing to be able to stay.
void PassageProver::askToStay(const TimedMotion& motion, const Surroundings& around,
                              Passage& passage) {
  if (isSamePose(motion.to, around.fallback)) return;
  const TimedMotion stay{motion.to, motion.to, motion.endUs, around.endUs};
  Passage staying;
  staying.isClear = true;
  staying.freeUntilUs = around.endUs;
  whole_.assign(avatar_.skeleton(), stay.from, stay.to);
  const Eigen::AlignedBox3d box = sweptBox(volumes_, whole_, states_);
  for (const AroundBody* const body : around.bodies) {
    if (!body->isSolid) continue;
    if (box.exteriorDistance(body->box()) > 2.0 * tolerance_) {
      staying.clearance = std::min(staying.clearance, tolerance_);
    } else {
      askBody(stay, *body, staying);
    }
  }
  if (staying.isClear) {
    // No one asks again about an avatar that stays there.
    passage.clearance = std::min(passage.clearance, staying.clearance);
    return;
  }
  // Where it stops must be another place.
  staying.freeUntilUs = motion.endUs;
  staying.clearance = std::min(staying.clearance, passage.clearance);
  staying.isInside = false;
  passage = staying;
}

Passage PassageProver::advance(const TimedMotion& motion, const Surroundings& around, Pose& reached,
                               std::int64_t& reachedUs) {
  Passage passage = ask(motion, around);
  reachedUs = motion.endUs;
  if (passage.isClear) {
    reached = motion.to;
    return passage;
  }
  reachedUs = motion.beginUs;
  const double free = static_cast<double>(passage.freeUntilUs - motion.beginUs);
  const auto cutUs = motion.beginUs + static_cast<std::int64_t>(kCutShare * free);
  if (cutUs <= motion.beginUs) return passage;
  whole_.assign(avatar_.skeleton(), motion.from, motion.to);
  whole_.poseAt(shareOf(motion.beginUs, motion.endUs, cutUs), reached);
  // It is another motion by its rounding, and ends elsewhere: it is asked by itself.
  const Passage until = ask({motion.from, reached, motion.beginUs, cutUs}, around);
  if (!until.isClear) return passage;
  reachedUs = cutUs;
  passage.clearance = until.clearance;
  return passage;
}

PairAnswer PassageProver::at(const Pose& place, const AroundBody& body, std::int64_t us) {
  const AroundLeg* const leg = body.legAt(us);
  if (leg == nullptr) {
    PairAnswer away;
    away.isClear = true;
    return away;
  }
  // The first instant of a motion that stays, the last one of what came before.
  whole_.assign(leg->kind->skeleton, leg->from, leg->to);
  whole_.poseAt(shareOf(leg->beginUs, leg->endUs, us), part_);
  ++questions_;
  return known(*leg->kind).ask(place, place, part_, part_, leg->rounding, scratch_);
}

}  // namespace foretouch::internal
