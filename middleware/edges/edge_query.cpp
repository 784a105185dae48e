#include "middleware/edges/edge_query.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch {
namespace {

/// Rounded up, so that a grown LSS holds all within `growth` of the true one.
Result<Avatar> grown(const Avatar& avatar, double growth) {
  std::vector<std::vector<Lss>> perLink;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    perLink.push_back(avatar.lss(link));
    for (Lss& lss : perLink.back()) lss.radius = (lss.radius + growth) * internal::kInflation;
  }
  return Avatar::build(avatar.skeleton(), std::move(perLink));
}

/// The same pairs of the grown avatar.
Result<PairRules> grownRules(const Avatar& avatar, const PairRules& rules, double growth) {
  std::vector<PairRadius> radii = rules.radii();
  for (PairRadius& own : radii) own.radius = (own.radius + 2.0 * growth) * internal::kInflation;
  return PairRules::of(avatar, rules.leftOut(), std::move(radii));
}

/// Keeps the earlier one; of equal ones, the first.
void take(const PairContact& contact, EdgeAnswer& answer) {
  if (answer.verdict != Verdict::Clear && answer.contact.freeUntil <= contact.freeUntil) return;
  answer.contact = contact;
  answer.verdict = contact.verdict;
  answer.reason = contact.reason;
}

}  // namespace

Result<EdgeQuery> EdgeQuery::build(const Robot& robot, const Scene& scene,
                                   const EdgeOptions& options) {
  if (!(options.clearance >= 0.0 && options.clearance <= kMaxCoordinate)) {
    return Error::in("clearance", ErrorCode::OutOfRange, "expected metres, at least 0");
  }
  EdgeQuery edges;
  edges.robot_ = std::make_shared<const Robot>(robot);
  QueryOptions asked;
  asked.tolerance = options.tolerance;
  asked.ignored = options.ignored;
  asked.scope = Scope::FirstOfAvatar;
  FORETOUCH_TRY(const auto whole, grown(robot.avatar(), options.clearance + robot.poseRounding()));
  FORETOUCH_TRY(edges.scene_, Query::build(whole, scene, asked));
  if (!options.self) return edges;
  if (options.self->avatarIdentity() != robot.avatar().identity()) {
    return Error::in("self", ErrorCode::Mismatch, "expected the pair rules of the robot's avatar");
  }
  // Each of two links takes half of the clearance. The scene has been asked.
  const double half = 0.5 * options.clearance + robot.poseRounding();
  FORETOUCH_TRY(const auto own, grown(robot.avatar(), half));
  FORETOUCH_TRY(asked.self, grownRules(own, *options.self, half));
  asked.ignored.clear();
  asked.scope = Scope::EveryLink;
  for (LinkId link = 0; link < own.numLinks(); ++link) asked.ignored.push_back({link});
  FORETOUCH_TRY(edges.self_, Query::build(own, scene, asked));
  return edges;
}

Result<EdgeAnswer> EdgeQuery::answer(const std::vector<double>& q0, const std::vector<double>& q1,
                                     EdgeScratch& scratch) const {
  FORETOUCH_CHECK(robot_->checked(q0.data(), q0.size()));
  return answer(q0.data(), q1.data(), q1.size(), scratch);
}

Result<EdgeAnswer> EdgeQuery::answer(const double* q0, const double* q1, std::size_t count,
                                     EdgeScratch& scratch) const {
  FORETOUCH_CHECK(robot_->checked(q0, count));
  FORETOUCH_CHECK(robot_->checked(q1, count));
  EdgeAnswer answer;
  answer.breachAt0 = robot_->breachOf(q0);
  answer.breachAt1 = robot_->breachOf(q1);
  const double turn = robot_->largestTurn(q0, q1);
  int parts = 1;
  while (parts <= kMostParts && turn > Robot::kMostTurn * parts) parts *= 2;
  if (parts > kMostParts) {
    answer.reason = UndecidedReason::Resolution;
    return answer;
  }
  scratch.q.resize(count);
  robot_->poseAt(q0, scratch.to);
  answer.verdict = Verdict::Clear;
  for (int part = 0; part < parts && answer.verdict == Verdict::Clear; ++part) {
    std::swap(scratch.from, scratch.to);
    robot_->between(q0, q1, static_cast<double>(part + 1) / parts, scratch.q.data());
    robot_->poseAt(scratch.q.data(), scratch.to);
    answerPart(scratch, answer, part, parts);
  }
  if (answer.verdict == Verdict::Clear) answer.freeUntil = 1.0;
  return answer;
}

void EdgeQuery::answerPart(EdgeScratch& scratch, EdgeAnswer& answer, int part, int parts) const {
  scratch.motion.assign(robot_->avatar().skeleton(), scratch.from, scratch.to);
  scene_->answer(scratch.motion, scratch.query, scratch.step);
  for (const LinkContact& contact : scratch.step.links) {
    // What is not looked at is so because another link meets something earlier, which is taken.
    if (contact.verdict == Verdict::Clear || contact.reason == UndecidedReason::AfterFirst)
      continue;
    PairContact met;
    static_cast<LinkContact&>(met) = contact;
    take(met, answer);
  }
  if (self_ && !(answer.verdict != Verdict::Clear && answer.contact.freeUntil == 0.0)) {
    self_->answer(scratch.motion, scratch.query, scratch.step);
    for (const PairContact& contact : scratch.step.pairs) take(contact, answer);
    if (!scratch.step.arePairsAnswered) {
      PairContact unknown;
      unknown.freeUntil = unknown.toi = 0.0;
      take(unknown, answer);
    }
  }
  if (answer.verdict == Verdict::Clear) return;
  // Rounded down, but for the edge's own begin: dividing by a power of two is exact.
  const double inParts = part + answer.contact.freeUntil;
  const double t = parts == 1 ? inParts : std::nextafter(inParts, 0.0) / parts;
  answer.freeUntil = answer.contact.freeUntil = answer.contact.toi = std::max(0.0, t);
  // The next part begins where this one has been proven free: it may be in contact there.
  if (answer.verdict == Verdict::StartsInContact && part > 0) answer.verdict = Verdict::Contact;
  answer.contact.verdict = answer.verdict;
}

}  // namespace foretouch
