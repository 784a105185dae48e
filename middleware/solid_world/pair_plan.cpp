#include "middleware/solid_world/pair_plan.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/rounding.h"
#include "middleware/query/scratch_parts.h"
#include "middleware/query/self_query.h"
#include "middleware/query/work_meter.h"

namespace foretouch::internal {
namespace {

/// As the solid avatar's own questions: whoever is apart by any gap gets a true answer.
constexpr double kStartShare = 0.5;
/// Poses off by more than this share of what is proven prove nothing.
constexpr double kMostOff = 0.25;

using Volumes = std::vector<std::vector<Lss>>;

/// For questions that ask nothing of a scene.
Result<Scene> nowhere() {
  using Eigen::Vector3d;
  RawScene raw;
  raw.objectNames = {"nothing"};
  raw.triangles.push_back({{Vector3d(1, 0, 0), Vector3d(-1, 1, 0), Vector3d(-1, -1, 0)}});
  raw.objectOf = {0};
  return Scene::build(std::move(raw));
}

Result<Skeleton> skeletonOfBoth(const Skeleton& one, const Skeleton& other) {
  RawSkeleton raw;
  for (const Skeleton* const part : {&one, &other}) {
    const auto first = static_cast<JointId>(raw.joints.size());
    for (JointId joint = 0; joint < part->numJoints(); ++joint) {
      const JointId parent = part->parent(joint);
      raw.joints.push_back({std::to_string(raw.joints.size()),
                            parent == kNoParent ? kNoParent : parent + first,
                            part->restOffset(joint), part->restRotation(joint)});
    }
  }
  return Skeleton::build(raw);
}

}  // namespace

PairPlan::PairPlan(const Avatar& avatar, const AroundKind& kind)
    : numOwn_(avatar.numLinks()), frame_(avatar.numLinks() + kind.first) {}

Result<PairPlan> PairPlan::make(const Avatar& avatar, const AroundKind& kind, double tolerance) {
  PairPlan plan(avatar, kind);
  FORETOUCH_TRY(plan.skeleton_, skeletonOfBoth(avatar.skeleton(), kind.skeleton));
  if (kind.mesh) {
    FORETOUCH_CHECK(plan.makeMesh(avatar, kind, tolerance));
  } else {
    FORETOUCH_CHECK(plan.makeLss(avatar, kind, tolerance));
  }
  return plan;
}

/// As own links of an avatar that is both: only pairs of one and the other are asked.
Result<Done> PairPlan::makeLss(const Avatar& avatar, const AroundKind& kind, double tolerance) {
  Volumes lss;
  for (LinkId link = 0; link < numOwn_; ++link) lss.push_back(avatar.lss(link));
  lss.insert(lss.end(), kind.volumes.begin(), kind.volumes.end());
  FORETOUCH_TRY(const Avatar both, Avatar::build(*skeleton_, lss));
  std::vector<LeftOutPair> leftOut;
  for (LinkId a = 0; a < both.numLinks(); ++a) {
    for (LinkId b = a + 1; b < both.numLinks(); ++b) {
      const bool isAsked = a < numOwn_ && b >= numOwn_;
      if (isAsked || both.lss(a).empty() || both.lss(b).empty()) continue;
      leftOut.push_back({a, b, PairReason::User});
    }
  }
  QueryOptions options;
  options.tolerance = tolerance;
  FORETOUCH_TRY(options.self, PairRules::leavingOut(both, std::move(leftOut)));
  FORETOUCH_TRY(const Scene nothing, nowhere());
  FORETOUCH_TRY(auto plan, QueryPlan::make(both, nothing, options, kStartShare));
  plan_ = std::make_shared<const QueryPlan>(std::move(plan));
  return Done{};
}

/// As the avatar in the scene of the mesh, seen from that.
Result<Done> PairPlan::makeMesh(const Avatar& avatar, const AroundKind& kind, double tolerance) {
  FORETOUCH_TRY(chain_, RelativeChain::build(*skeleton_, frame_));
  Volumes lss(countOf(chain_->skeleton().numJoints()));
  linkOf_.assign(lss.size(), kNoParent);
  for (LinkId link = 0; link < numOwn_; ++link) {
    const auto there = slotOf(chain_->linkOf(link));
    lss[there] = avatar.lss(link);
    linkOf_[there] = link;
  }
  FORETOUCH_TRY(const Avatar seen, Avatar::build(chain_->skeleton(), lss));
  QueryOptions options;
  options.tolerance = tolerance;
  options.scope = Scope::FirstOfAvatar;
  FORETOUCH_TRY(auto plan, QueryPlan::make(seen, *kind.mesh, options, kStartShare));
  plan_ = std::make_shared<const QueryPlan>(std::move(plan));
  FORETOUCH_TRY(near_, NearQuery::build(avatar, *kind.mesh));
  return Done{};
}

void PairPlan::join(const Pose& one, const Pose& other, const Eigen::Vector3d& origin,
                    Pose& both) const {
  both.rotations = one.rotations;
  both.rotations.insert(both.rotations.end(), other.rotations.begin(), other.rotations.end());
  both.translations = one.translations;
  both.translations.insert(both.translations.end(), other.translations.begin(),
                           other.translations.end());
  for (std::size_t j = 0; j < both.translations.size(); ++j) {
    if (skeleton_->parents()[j] == kNoParent) both.translations[j] -= origin;
  }
}

PairAnswer PairPlan::ask(const Pose& from, const Pose& to, const Pose& otherFrom,
                         const Pose& otherTo, double off, PairScratch& scratch) const {
  StepContacts& step = scratch.step;
  if (chain_) {
    join(from, otherFrom, Eigen::Vector3d::Zero(), scratch.from);
    join(to, otherTo, Eigen::Vector3d::Zero(), scratch.to);
    chain_->pose(scratch.from, scratch.relativeFrom);
    chain_->pose(scratch.to, scratch.relativeTo);
    scratch.motion.assign(chain_->skeleton(), scratch.relativeFrom, scratch.relativeTo);
    Query(plan_).answer(scratch.motion, scratch.query, step);
    return answerOf(step, off, scratch);
  }
  // Near the avatar, so that floats resolve the two. Each coordinate rounds once.
  const Eigen::Vector3d origin = from.translations[0];
  join(from, otherFrom, origin, scratch.from);
  join(to, otherTo, origin, scratch.to);
  double reach = origin.norm();
  for (const Pose* const pose : {&from, &to, &otherFrom, &otherTo}) {
    for (const Eigen::Vector3d& p : pose->translations) reach = std::max(reach, p.norm());
  }
  off += 8.0 * kUnitRoundoff * reach;
  scratch.motion.assign(*skeleton_, scratch.from, scratch.to);
  step.links.clear();
  step.pairs.clear();
  step.counters = {};
  scratch.query.parts().beginStep(scratch.motion);
  const WorkMeter meter(plan_->options);
  SelfQuery(*plan_, scratch.motion, meter, scratch.query.parts()).run(step);
  return answerOf(step, off, scratch);
}

PairAnswer PairPlan::answerOf(const StepContacts& step, double off, PairScratch& scratch) const {
  PairAnswer answer;
  answer.share = 1.0;
  bool isClear = true, isTouch = false;
  const auto look = [&](const LinkContact& contact, LinkId link, JointId other) {
    if (contact.verdict == Verdict::Clear) return;
    isClear = false;
    const bool isInside = contact.verdict == Verdict::StartsInContact;
    // Of those that are first together: one that touches, the deepest.
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
  double used = plan_->tolerances.least;
  if (chain_) {
    for (const LinkContact& contact : step.links) {
      const LinkId link = linkOf_[slotOf(contact.link)];
      if (link != kNoParent) look(contact, link, frame_ - numOwn_);
    }
    for (const double own : scratch.query.parts().lanes.tolerances) {
      if (own > 0.0) used = std::min(used, own);
    }
  } else {
    for (const PairContact& contact : step.pairs) {
      look(contact, contact.link, contact.other - numOwn_);
    }
    for (const LeftPair& pair : scratch.query.parts().self.left) {
      used = std::min(used, pair.tolerance);
    }
    if (!step.arePairsAnswered) {
      isClear = false;
      answer.share = 0.0;
    }
  }
  const double proven = kFloorShare * used;
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
