#include "middleware/edges/edge_query.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/edges/edge_memory.h"

namespace foretouch {
namespace {

using internal::EdgeMemory;
using internal::kPropRounding;
using internal::seenFrom;

/// The same pairs of the grown avatar.
Result<PairRules> grownRules(const Avatar& avatar, const PairRules& rules, double growth) {
  std::vector<PairRadius> radii = rules.radii();
  for (PairRadius& own : radii) own.radius = (own.radius + 2.0 * growth) * internal::kInflation;
  return PairRules::leavingOut(avatar, rules.leftOut(), std::move(radii));
}

ClearanceOptions clearanceOptions(const Robot& robot, const EdgeOptions& options) {
  return {options.clearanceTolerance, options.clearanceWithin, robot.reach(), options.ignored};
}

/// Keeps the earlier one; of equal ones, the first. False: that is not this one.
bool take(const PairContact& contact, EdgeAnswer& answer) {
  if (answer.verdict != Verdict::Clear && answer.contact.freeUntil <= contact.freeUntil) {
    return false;
  }
  answer.contact = contact;
  answer.verdict = contact.verdict;
  answer.reason = contact.reason;
  return true;
}

/// What is not looked at is so because another link meets something earlier, which is taken.
bool isMet(const LinkContact& contact) {
  return contact.verdict != Verdict::Clear && contact.reason != UndecidedReason::AfterFirst;
}

void moveToWorld(const RigidPose& X_WP, LinkContact& contact) {
  contact.p_WScene = X_WP.rotation * contact.p_WScene + X_WP.translation;
  contact.p_WLink = X_WP.rotation * contact.p_WLink + X_WP.translation;
  contact.nhat_SL_W = X_WP.rotation * contact.nhat_SL_W;
}

}  // namespace

Result<EdgeQuery> EdgeQuery::build(const Robot& robot, const Scene& scene,
                                   const EdgeOptions& options) {
  if (!(options.clearance >= 0.0 && options.clearance <= kMaxCoordinate)) {
    return Error::in("clearance", ErrorCode::OutOfRange, "expected metres, at least 0");
  }
  EdgeQuery edges;
  edges.robot_ = std::make_shared<const Robot>(robot);
  edges.options_ = std::make_shared<const EdgeOptions>(options);
  QueryOptions asked;
  asked.tolerance = options.tolerance;
  asked.ignored = options.ignored;
  asked.scope = Scope::FirstOfAvatar;
  FORETOUCH_TRY(const auto whole, robot.avatar().grownBy(options.clearance + robot.poseRounding()));
  FORETOUCH_TRY(edges.scene_, Query::build(whole, scene, asked));
  FORETOUCH_TRY(edges.clearance_,
                ClearanceQuery::build(robot.avatar(), scene, clearanceOptions(robot, options)));
  FORETOUCH_CHECK(edges.addProps(options));
  if (!options.self) return edges;
  if (options.self->avatarIdentity() != robot.avatar().identity()) {
    return Error::in("self", ErrorCode::Mismatch, "expected the pair rules of the robot's avatar");
  }
  // Each of two links takes half of the clearance. The scene has been asked.
  const double half = 0.5 * options.clearance + robot.poseRounding();
  FORETOUCH_TRY(const auto own, robot.avatar().grownBy(half));
  FORETOUCH_TRY(asked.self, grownRules(own, *options.self, half));
  asked.ignored.clear();
  asked.scope = Scope::EveryLink;
  for (LinkId link = 0; link < own.numLinks(); ++link) asked.ignored.push_back({link});
  FORETOUCH_TRY(edges.self_, Query::build(own, scene, asked));
  return edges;
}

/// A robot that is a little thicker still holds all that its poses, seen from a prop, are off by.
Result<Done> EdgeQuery::addProps(const EdgeOptions& options) {
  if (options.props.empty()) return Done{};
  const double apart = robot_->reach() + 2.0 * kMostPropDistance;  // along all three axes
  const double growth = options.clearance + robot_->poseRounding() + kPropRounding * apart;
  FORETOUCH_TRY(const auto whole, robot_->avatar().grownBy(growth));
  QueryOptions asked;
  asked.tolerance = options.tolerance;
  asked.scope = Scope::FirstOfAvatar;
  for (std::size_t i = 0; i < options.props.size(); ++i) {
    const auto ofProp = [i](Error error) {
      error.index = static_cast<std::int64_t>(i);
      return error;
    };
    const EdgeProp& prop = options.props[i];
    asked.ignored = prop.ignored;
    FORETOUCH_TRY_OR(ofProp, auto query, Query::build(whole, prop.scene, asked));
    ClearanceOptions near = clearanceOptions(*robot_, options);
    near.reach = 0.0;  // it may be anywhere
    near.ignored = prop.ignored;
    FORETOUCH_TRY_OR(ofProp, auto clearance,
                     ClearanceQuery::build(robot_->avatar(), prop.scene, near));
    props_.push_back({std::move(query), std::move(clearance), std::nullopt});
    FORETOUCH_CHECK(place(i, prop.X_WP));
  }
  return Done{};
}

Result<Done> EdgeQuery::place(std::size_t prop, const std::optional<RigidPose>& X_WP) {
  const auto refused = [prop](ErrorCode code, const char* what) {
    Error error = Error::in("prop", code, what);
    error.index = static_cast<std::int64_t>(prop);
    return error;
  };
  if (prop >= props_.size()) return refused(ErrorCode::OutOfRange, "expected a prop of the query");
  if (!X_WP) {
    props_[prop].X_WP.reset();
    return Done{};
  }
  const auto rotation = unitQuaternion(X_WP->rotation);
  if (!rotation) return refused(ErrorCode::OutOfRange, "expected a unit rotation");
  // False for what is not a number.
  if (!(X_WP->translation.array().abs() <= kMostPropDistance).all()) {
    return refused(ErrorCode::OutOfRange, "expected a place within 10 km of the origin");
  }
  props_[prop].X_WP = RigidPose{*rotation, X_WP->translation};
  return Done{};
}

Result<EdgeAnswer> EdgeQuery::answer(const std::vector<double>& q0, const std::vector<double>& q1,
                                     Scratch& scratch) const {
  FORETOUCH_CHECK(robot_->checked(q0.data(), q0.size()));
  return answer(q0.data(), q1.data(), q1.size(), scratch);
}

Result<EdgeAnswer> EdgeQuery::answer(const double* q0, const double* q1, std::size_t count,
                                     Scratch& scratch) const {
  FORETOUCH_CHECK(robot_->checked(q0, count));
  FORETOUCH_CHECK(robot_->checked(q1, count));
  EdgeAnswer answer;
  answer.breachAt0 = robot_->breachOf(q0);
  answer.breachAt1 = robot_->breachOf(q1);
  const int parts = robot_->partsBetween(q0, q1, kMostParts);
  if (parts == 0) {
    answer.reason = UndecidedReason::Resolution;
    return answer;
  }
  auto& memory = scratch.of<EdgeMemory>();
  memory.q.resize(count);
  robot_->poseAt(q0, memory.to);
  answer.verdict = Verdict::Clear;
  for (int part = 0; part < parts && answer.verdict == Verdict::Clear; ++part) {
    std::swap(memory.from, memory.to);
    robot_->between(q0, q1, static_cast<double>(part + 1) / parts, memory.q.data());
    robot_->poseAt(memory.q.data(), memory.to);
    answerPart(scratch, answer, part, parts);
  }
  if (answer.verdict == Verdict::Clear) answer.freeUntil = 1.0;
  return answer;
}

void EdgeQuery::answerPart(Scratch& scratch, EdgeAnswer& answer, int part, int parts) const {
  auto& memory = scratch.of<EdgeMemory>();
  memory.motion.assign(robot_->avatar().skeleton(), memory.from, memory.to);
  scene_->answer(memory.motion, scratch, memory.step);
  for (const LinkContact& contact : memory.step.links) {
    if (!isMet(contact)) continue;
    PairContact met;
    static_cast<LinkContact&>(met) = contact;
    take(met, answer);
  }
  if (self_ && !(answer.verdict != Verdict::Clear && answer.contact.freeUntil == 0.0)) {
    self_->answer(memory.motion, scratch, memory.step);
    for (const PairContact& contact : memory.step.pairs) take(contact, answer);
    if (!memory.step.arePairsAnswered) {
      PairContact unknown;
      unknown.freeUntil = unknown.toi = 0.0;
      take(unknown, answer);
    }
  }
  answerProps(scratch, answer);
  if (answer.verdict == Verdict::Clear) return;
  // Rounded down, but for the edge's own begin: dividing by a power of two is exact.
  const double inParts = part + answer.contact.freeUntil;
  const double t = parts == 1 ? inParts : std::nextafter(inParts, 0.0) / parts;
  answer.freeUntil = answer.contact.freeUntil = answer.contact.toi = std::max(0.0, t);
  // The next part begins where this one has been proven free: it may be in contact there.
  if (answer.verdict == Verdict::StartsInContact && part > 0) answer.verdict = Verdict::Contact;
  answer.contact.verdict = answer.verdict;
}

/// Each prop is asked about the robot's motion as seen from it.
void EdgeQuery::answerProps(Scratch& scratch, EdgeAnswer& answer) const {
  const Skeleton& skeleton = robot_->avatar().skeleton();
  auto& memory = scratch.of<EdgeMemory>();
  for (std::size_t i = 0; i < props_.size(); ++i) {
    const Prop& prop = props_[i];
    if (!prop.X_WP) continue;
    if (answer.verdict != Verdict::Clear && answer.contact.freeUntil == 0.0) return;
    seenFrom(*prop.X_WP, skeleton, memory.from, memory.propFrom);
    seenFrom(*prop.X_WP, skeleton, memory.to, memory.propTo);
    memory.motion.assign(skeleton, memory.propFrom, memory.propTo);
    prop.query.answer(memory.motion, scratch, memory.step);
    for (const LinkContact& contact : memory.step.links) {
      if (!isMet(contact)) continue;
      PairContact met;
      static_cast<LinkContact&>(met) = contact;
      moveToWorld(*prop.X_WP, met);
      if (take(met, answer)) answer.prop = static_cast<std::int32_t>(i);
    }
  }
}

}  // namespace foretouch
