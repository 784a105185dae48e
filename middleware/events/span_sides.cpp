#include "middleware/events/span_sides.h"

#include <algorithm>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::internal {

SystemQuestion SpanSides::questionOf(const BodyPair& bodies) const {
  if (bodies.b == kStillScene) return SystemQuestion::Still;
  if (bodies.b == bodies.a) return SystemQuestion::Self;
  const bool areAvatars = world_.kindOf(bodies.a).avatar && world_.kindOf(bodies.b).avatar;
  return areAvatars ? SystemQuestion::Pair : SystemQuestion::Mesh;
}

bool isOfObjects(const WorldParts& world, const BodyPair& bodies) {
  return bodies.b == kStillScene || !world.kindOf(bodies.a).avatar ||
         !world.kindOf(bodies.b).avatar;
}

Result<Done> checkedSides(const WorldParts& world) {
  if (world.options.askMeshes) {
    return Error::in(
        "world", ErrorCode::Mismatch,
        "asks whether meshes meet; expected a world that does not, to follow contacts");
  }
  return Done{};
}

bool SpanSides::begin(const BodyPair& bodies, std::int64_t fromUs, std::int64_t toUs) {
  question_ = questionOf(bodies);
  one_ = bodies.a;
  other_ = question_ == SystemQuestion::Self ? kStillScene : bodies.b;
  // A mesh is what the other one is seen from.
  isTurned_ = question_ == SystemQuestion::Mesh && !world_.kindOf(bodies.a).avatar;
  if (isTurned_) std::swap(one_, other_);
  scratch_.spans.begin(world_, one_, other_, fromUs, toUs);
  switch (question_) {
    case SystemQuestion::Still: return world_.isStillAsked(one_);
    case SystemQuestion::Self: return world_.body(one_).ownRules >= 0;
    default: return world_.isAsked(bodies.a, bodies.b);
  }
}

Result<const SystemPlan*> SpanSides::prepare() {
  FORETOUCH_TRY(plan_, query_.prepare(question_, one_, other_));
  if (plan_ == nullptr) return plan_;
  evaluator_.reset(scratch_.motion);
  if (!plan_->isMerged()) ofOther_.reset(scratch_.other);
  if (plan_->seen) {
    const ChainPoses& poses = scratch_.poses.chains[0];
    scratch_.ofSystem.assign(plan_->chains.front(), poses.from, poses.to);
    ofSystem_.reset(scratch_.ofSystem);
  }
  return plan_;
}

MotionEvaluator& SpanSides::inWorld(BodyId body) const {
  if (plan_->seen) return ofSystem_;
  const SystemMember& member = scratch_.spans.members()[slotOf(scratch_.spans.placeOf(body))];
  return plan_->isMerged() || member.chain == 0 ? evaluator_ : ofOther_;
}

/// The link on its chain.
LinkId SpanSides::inSystem(BodyId body, LinkId link) const {
  return plan_->first[slotOf(scratch_.spans.placeOf(body))] + link;
}

LinkShape SpanSides::shapeOf(BodyId body, LinkId link) const {
  const BodyKind& kind = world_.kindOf(body);
  return {kind.volumes[slotOf(link)], surfaceOf(kind, link)};
}

bool SpanSides::set(const LinkPair& links, MovingSides& sides) {
  const LinkId one = isTurned_ ? links.b : links.a, other = isTurned_ ? links.a : links.b;
  if (shapeOf(one_, one).lss.empty()) return false;
  switch (question_) {
    case SystemQuestion::Still:
      frame_ = kNoParent;
      sides.begin(frame_);
      sides.setLink(evaluator_, inSystem(one_, one), shapeOf(one_, one));
      sides.setScene(*world_.still, kNoObject);
      return true;
    case SystemQuestion::Mesh: return setMesh(one, sides);
    default: return setPair(one, other, sides);
  }
}

bool SpanSides::setPair(LinkId one, LinkId other, MovingSides& sides) {
  const BodyId ofOther = other_ == kStillScene ? one_ : other_;
  const LinkId a = inSystem(one_, one), b = inSystem(ofOther, other);
  if (shapeOf(ofOther, other).lss.empty()) return false;
  const PairPlan plan = plan_->pair();
  const PairsAsked& asked = plan.asked;
  const bool isTurned = plan.isOfOwnLinks() ? b < a : query_.isTurned(one_, other_);
  const LinkId first = isTurned ? b : a, second = isTurned ? a : b;
  const std::int32_t i = plan.one.table.first(first), j = plan.other.table.first(second);
  if (!asked.asked().has(i, j)) return false;
  frame_ = asked.frames()[slotOf(asked.frameOf(first, second))];
  sides.begin(frame_);
  sides.setLink(inWorld(one_), a, shapeOf(one_, one));
  sides.setOther(inWorld(ofOther), b, shapeOf(ofOther, other));
  sides.setShares(asked, isTurned ? j : i, isTurned ? i : j);
  return true;
}

bool SpanSides::setMesh(LinkId link, MovingSides& sides) {
  const LinkId seen = plan_->seen->linkOf(inSystem(one_, link));
  // It may carry the mesh, or be carried by it.
  if (plan_->query->avatar().lss(seen).empty()) return false;
  frame_ = kNoParent;
  sides.begin(frame_);
  sides.setLink(evaluator_, seen, shapeOf(one_, link));
  sides.setScene(*world_.kindOf(other_).mesh, kNoObject);
  return true;
}

LinkState SpanSides::frameAt(double t) {
  if (plan_->seen) return stateOf(other_, 0, t);
  if (frame_ == kNoParent) return {};
  return evaluator_.stateAt(frame_, t);
}

LinkState SpanSides::stateOf(BodyId body, LinkId link, double t) {
  return inWorld(body).stateAt(inSystem(body, link), t);
}

MotionBounds SpanSides::boundsOf(BodyId body, LinkId link) const {
  return inWorld(body).motion().bounds(inSystem(body, link));
}

void SpanSides::statesOf(BodyId body, double t, std::vector<LinkState>& states) {
  inWorld(body).statesAt(t, states_);
  const auto first = states_.begin() + inSystem(body, 0);
  states.assign(first, first + world_.kindOf(body).skeleton.numJoints());
}

}  // namespace foretouch::internal
