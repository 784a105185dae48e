#include "middleware/solid_world/around_plan.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "articulated/try.h"
#include "lss/rounding.h"
#include "middleware/pair/pair_query.h"
#include "middleware/pair/query_memory.h"
#include "middleware/pair/work_meter.h"

namespace foretouch::internal {
namespace {

/// As the solid avatar's own questions: what is apart by any gap gets a true answer.
constexpr double kStartShare = 0.5;
/// Poses off by more than this share of what is proven prove nothing.
constexpr double kMostOff = 0.25;

/// The roots are relative to `origin` then; each coordinate rounds once.
void moveRoots(const Skeleton& skeleton, const Pose& pose, const Eigen::Vector3d& origin,
               Pose& moved) {
  moved = pose;
  for (std::size_t j = 0; j < moved.translations.size(); ++j) {
    if (skeleton.parents()[j] == kNoParent) moved.translations[j] -= origin;
  }
}

void append(const Pose& more, Pose& pose) {
  pose.rotations.insert(pose.rotations.end(), more.rotations.begin(), more.rotations.end());
  pose.translations.insert(pose.translations.end(), more.translations.begin(),
                           more.translations.end());
}

}  // namespace

AroundPlan::AroundPlan(const Avatar& avatar, const AroundKind& kind)
    : skeleton_(avatar.skeleton()), otherSkeleton_(kind.skeleton), frame_(kind.first) {}

Result<AroundPlan> AroundPlan::make(const Avatar& avatar, const AroundKind& kind,
                                    double tolerance) {
  AroundPlan plan(avatar, kind);
  QueryOptions options;
  options.tolerance = tolerance;
  if (kind.mesh) {
    FORETOUCH_CHECK(plan.makeMesh(avatar, kind, options));
  } else {
    FORETOUCH_CHECK(plan.makeLss(avatar, kind, options));
  }
  return plan;
}

Result<Done> AroundPlan::makeLss(const Avatar& avatar, const AroundKind& kind,
                                 const QueryOptions& options) {
  FORETOUCH_TRY(const Avatar other, Avatar::build(kind.skeleton, kind.volumes));
  FORETOUCH_TRY(auto one, SidePlan::make(avatar, options));
  FORETOUCH_TRY(auto others, SidePlan::make(other, options));
  asked_ = PairsAsked(one.table, others.table);
  one_ = std::make_shared<const SidePlan>(std::move(one));
  other_ = std::make_shared<const SidePlan>(std::move(others));
  return Done{};
}

/// As the avatar in the scene of the mesh, seen from that.
Result<Done> AroundPlan::makeMesh(const Avatar& avatar, const AroundKind& kind,
                                  QueryOptions options) {
  RawSkeleton raw;
  appendChain(skeleton_, kNoParent, raw);
  appendChain(otherSkeleton_, kNoParent, raw);
  FORETOUCH_TRY(const Skeleton both, Skeleton::build(raw));
  FORETOUCH_TRY(seen_, RelativeChain::build(both, avatar.numLinks() + frame_));
  std::vector<std::vector<Lss>> lss(countOf(seen_->skeleton().numJoints()));
  linkOf_.assign(lss.size(), kNoParent);
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const auto there = slotOf(seen_->linkOf(link));
    lss[there] = avatar.lss(link);
    linkOf_[there] = link;
  }
  FORETOUCH_TRY(const Avatar seen, Avatar::build(seen_->skeleton(), lss));
  options.scope = Scope::FirstOfAvatar;
  FORETOUCH_TRY(auto plan, QueryPlan::make(seen, *kind.mesh, options, kStartShare));
  plan_ = std::make_shared<const QueryPlan>(std::move(plan));
  FORETOUCH_TRY(near_, NearQuery::build(avatar, *kind.mesh));
  return Done{};
}

PairAnswer AroundPlan::ask(const Pose& from, const Pose& to, const Pose& otherFrom,
                           const Pose& otherTo, double off, AroundScratch& scratch) const {
  if (seen_) {
    askMesh(from, to, otherFrom, otherTo, scratch);
    return answerOf(scratch.step, off);
  }
  // Near the avatar, so that floats resolve the two.
  const Eigen::Vector3d origin = from.translations[0];
  askLss(from, to, otherFrom, otherTo, origin, scratch);
  double reach = origin.norm();
  for (const Pose* const pose : {&from, &to, &otherFrom, &otherTo}) {
    for (const Eigen::Vector3d& p : pose->translations) reach = std::max(reach, p.norm());
  }
  return answerOf(scratch.step, off + 8.0 * kUnitRoundoff * reach);
}

void AroundPlan::askMesh(const Pose& from, const Pose& to, const Pose& otherFrom,
                         const Pose& otherTo, AroundScratch& scratch) const {
  Pose& both = scratch.from;
  both = from;
  append(otherFrom, both);
  seen_->pose(both, scratch.otherFrom);
  both = to;
  append(otherTo, both);
  seen_->pose(both, scratch.otherTo);
  scratch.motion.assign(seen_->skeleton(), scratch.otherFrom, scratch.otherTo);
  Query(plan_).answer(scratch.motion, scratch.query, scratch.step);
}

void AroundPlan::askLss(const Pose& from, const Pose& to, const Pose& otherFrom,
                        const Pose& otherTo, const Eigen::Vector3d& origin,
                        AroundScratch& scratch) const {
  moveRoots(skeleton_, from, origin, scratch.from);
  moveRoots(skeleton_, to, origin, scratch.to);
  scratch.motion.assign(skeleton_, scratch.from, scratch.to);
  moveRoots(otherSkeleton_, otherFrom, origin, scratch.otherFrom);
  moveRoots(otherSkeleton_, otherTo, origin, scratch.otherTo);
  scratch.other.assign(otherSkeleton_, scratch.otherFrom, scratch.otherTo);
  QueryMemory& parts = scratch.query.of<QueryMemory>();
  beginAnswer(scratch.step);
  parts.beginStep(scratch.motion, scratch.other);
  const WorkMeter meter(one_->options);
  PairQuery({*one_, *other_, asked_, kStartShare}, {scratch.motion, scratch.other}, meter, parts)
      .run(scratch.step);
}

PairAnswer AroundPlan::answerOf(const StepContacts& step, double off) const {
  PairAnswer answer;
  answer.share = 1.0;
  bool isClear = true, isTouch = false;
  const auto look = [&](const LinkContact& contact, LinkId link, JointId other) {
    if (contact.verdict == Verdict::Clear) return;
    isClear = false;
    const bool isInside = contact.verdict == Verdict::StartsInContact;
    // Among those that are first together: one that touches, the deepest.
    const bool isBetter = contact.verdict != Verdict::Undecided &&
                          (!isTouch || (isInside && contact.penetration > answer.penetration));
    if (contact.freeUntil > answer.share || (contact.freeUntil == answer.share && !isBetter)) {
      return;
    }
    isTouch = contact.verdict != Verdict::Undecided;
    answer.share = contact.freeUntil;
    answer.isInside = answer.isInside || isInside;
    answer.link = link;
    answer.other = other;
    if (isInside) answer.penetration = std::max(answer.penetration, contact.penetration);
  };
  for (const LinkContact& contact : step.links) {
    const LinkId link = linkOf_[slotOf(contact.link)];
    if (link != kNoParent) look(contact, link, frame_);
  }
  for (const PairContact& contact : step.pairs) look(contact, contact.link, contact.other);
  if (!seen_ && !step.arePairsAnswered) {
    isClear = false;
    answer.share = 0.0;
  }
  const double proven = step.provenClearance;
  if (off > kMostOff * proven) {
    isClear = false;
    answer.share = 0.0;
  }
  answer.isClear = isClear;
  answer.clearance = proven - off;
  if (isClear) answer.share = 1.0;
  return answer;
}

}  // namespace foretouch::internal
