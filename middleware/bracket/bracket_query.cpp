#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/bracket/bracket.h"
#include "middleware/bracket/bracket_run.h"
#include "middleware/pair/query_plan.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::BodyBrackets;
using internal::BodyPlan;
using internal::BracketMemory;
using internal::BracketPlan;
using internal::Growth;
using internal::ModelPiece;
using internal::ModelPieces;
using internal::StepGrowth;

Result<Done> checkedBounds(const Avatar& avatar, const std::vector<LinkBound>& bounds,
                           const char* name = "bounds") {
  if (bounds.size() != countOf(avatar.numLinks())) {
    return Error::in(name, ErrorCode::Mismatch,
                     "expected one per link: " + std::to_string(avatar.numLinks()));
  }
  LinkId link = 0;
  for (const LinkBound& bound : bounds) {
    for (const double value :
         {bound.error, bound.acceleration, bound.followFloor, bound.followShare, bound.speed,
          bound.aheadSpeed, bound.aheadAcceleration}) {
      if (!(value >= 0.0)) {
        return Error{ErrorCode::OutOfRange, name, -1, link, "expected numbers, at least 0"};
      }
    }
    ++link;
  }
  return Done{};
}

Result<Done> checkedResolution(double resolution) {
  if (resolution >= 1e-9 && resolution <= 1.0) return Done{};
  return Error::in("resolution", ErrorCode::OutOfRange, "expected 1e-9 to 1 metres");
}

Result<Done> checkedSurface(const Avatar& avatar, const std::optional<AvatarSurface>& surface,
                            const char* name) {
  if (!surface || surface->numLinks() == avatar.numLinks()) return Done{};
  return Error::in(name, ErrorCode::Mismatch, "expected the surface of this avatar");
}

}  // namespace

const char* toString(BracketVerdict verdict) {
  switch (verdict) {
    case BracketVerdict::Unclaimed: return "unclaimed";
    case BracketVerdict::Excluded: return "excluded";
    case BracketVerdict::Possible: return "possible";
    case BracketVerdict::Certain: return "certain";
  }
  return "unclaimed";
}

namespace {

/// How much the poses around the step bend (m): the mean of what is known at its two ends, of the
/// ends of a link's axes; infinite if nothing is known (bracket.md 4).
class PoseBends {
 public:
  PoseBends(const PosedStep& step, const Avatar& avatar, internal::KnownPlaces& known)
      : step_(step),
        before_(placed(step.before, avatar, known)),
        from_(placed(step.from, avatar, known)),
        to_(placed(step.to, avatar, known)),
        after_(placed(step.after, avatar, known)) {}
  [[nodiscard]] double of(const Avatar& avatar, LinkId link) const {
    double most = 0.0;
    for (const Lss& lss : avatar.lss(link)) {
      for (const Vector3d& end : {lss.a, lss.b}) most = std::max(most, ofPoint(link, end));
    }
    return most;
  }

 private:
  using Places = std::vector<LinkState>;
  static_assert(internal::KnownPlaces::kKept > 4, "of four poses at once");
  static const Places* placed(const Pose* pose, const Avatar& avatar,
                              internal::KnownPlaces& known) {
    return pose != nullptr ? &known.at(avatar, *pose) : nullptr;
  }
  [[nodiscard]] double ofPoint(LinkId link, const Vector3d& p_L) const {
    const auto pointIn = [&](const Places* places) { return (*places)[slotOf(link)].pointAt(p_L); };
    const Vector3d from = pointIn(from_), to = pointIn(to_);
    const Vector3d rate = (to - from) / step_.seconds;
    double sum = 0.0;
    int count = 0;
    const auto add = [&](const Vector3d& change, double seconds) {
      sum += 2.0 * (rate - change / seconds).norm() / (step_.seconds + seconds);
      ++count;
    };
    if (before_ != nullptr) add(from - pointIn(before_), step_.secondsBefore);
    if (after_ != nullptr) add(pointIn(after_) - to, step_.secondsAfter);
    if (count == 0) return LinkBound::kNone;
    return sum / count * step_.seconds * step_.seconds;
  }

  const PosedStep& step_;
  const Places *before_, *from_, *to_, *after_;
};

void beginBodies(const BracketPlan& plan, BracketMemory& memory) {
  for (std::size_t body = 0; body < plan.bodies.size(); ++body) {
    memory.bodies[body].begin(countOf(plan.bodies[body].avatar.numLinks()));
  }
  memory.base = 0;
}

void beginAnswer(const BracketPlan& plan, BracketMemory& memory, StepBrackets& brackets) {
  brackets.links.clear();
  if (plan.scene) brackets.links.resize(countOf(plan.bodies[0].avatar.numLinks()));
  for (std::size_t i = 0; i < brackets.links.size(); ++i) {
    brackets.links[i].link = static_cast<LinkId>(i);
  }
  brackets.pairs.clear();
  brackets.pieces = 0;
  memory.sides.looks = memory.sides.work = 0;
  memory.sides.mostWork = plan.workBudget;
  beginBodies(plan, memory);
}

/// The growths of a step between two poses.
class GrowthsOfStep final : public internal::PieceGrowths {
 public:
  GrowthsOfStep(const BracketPlan& plan, const BracketMemory& memory)
      : plan_(plan), memory_(memory) {}
  [[nodiscard]] Growth of(const ModelPiece& piece, std::size_t body, LinkId link) const override {
    const auto i = slotOf(link);
    const double stray = piece.strays[i].at(plan_.bodies[body].rho[i]) * internal::kInflation;
    return memory_.bodies[body].growths[i]->in(piece.stepBegin, piece.stepEnd, stray);
  }

 private:
  const BracketPlan& plan_;
  const BracketMemory& memory_;
};

/// The growths of a gap of `seconds`, each half of which stands still (bracket.md 5).
class GrowthsOfGap final : public internal::PieceGrowths {
 public:
  GrowthsOfGap(const std::vector<LinkBound>& bounds, double seconds)
      : bounds_(bounds), seconds_(seconds) {}
  [[nodiscard]] Growth of(const ModelPiece& piece, std::size_t, LinkId link) const override {
    const LinkBound& bound = bounds_[slotOf(link)];
    const double way = 0.5 * seconds_ * bound.speed * internal::kInflation;
    return piece.begin == 0.0 ? Growth{bound.error, way, 0.0}
                              : Growth{bound.error + way, -way, 0.0};
  }

 private:
  const std::vector<LinkBound>& bounds_;
  double seconds_;
};

/// The growths of what comes, up to a horizon (s).
class GrowthsAhead final : public internal::PieceGrowths {
 public:
  GrowthsAhead(const std::vector<LinkBound>& bounds, double horizon)
      : bounds_(bounds), horizon_(horizon) {}
  [[nodiscard]] Growth of(const ModelPiece& piece, std::size_t, LinkId link) const override {
    const LinkBound& bound = bounds_[slotOf(link)];
    const double begin = horizon_ * piece.begin, span = horizon_ * (piece.end - piece.begin);
    const double half = 0.5 * bound.aheadAcceleration * internal::kInflation;
    const double speed = bound.aheadSpeed * internal::kInflation + 2.0 * half * begin;
    return {bound.error + begin * (bound.aheadSpeed * internal::kInflation + half * begin),
            speed * span, half * span * span};
  }

 private:
  const std::vector<LinkBound>& bounds_;
  double horizon_;
};

/// Readies the model and what follows from the bounds.
void prepare(const BodyPlan& plan, const PersonStep& person, BodyBrackets& memory) {
  memory.part = {person.step, person.begin, person.end};
  const std::vector<LinkBound>& bounds = *person.bounds;
  memory.model.assign(plan.avatar.skeleton(), person.step, person.model);
  std::optional<PoseBends> bends;
  const bool isAnyFollowed = std::any_of(bounds.begin(), bounds.end(), [](const LinkBound& bound) {
    return std::isfinite(bound.followFloor);
  });
  if (isAnyFollowed) bends.emplace(person.step, plan.avatar, memory.places);
  for (LinkId link = 0; link < plan.avatar.numLinks(); ++link) {
    const auto i = slotOf(link);
    const double bend = bends ? bends->of(plan.avatar, link) : LinkBound::kNone;
    memory.growths[i] = StepGrowth::of(bounds[i], person.step.seconds, bend);
    if (memory.growths[i]) memory.most[i] = memory.growths[i]->largest();
  }
}

/// Answers once every body is prepared.
void answerStep(const BracketPlan& plan, BracketMemory& memory, StepBrackets& brackets) {
  const GrowthsOfStep growths(plan, memory);
  bool isRefined = false;
  for (std::size_t body = 0; body < plan.bodies.size(); ++body) {
    isRefined = isRefined || !memory.bodies[body].model.isConstantRate();
  }
  internal::bracketLinks(plan, {growths, false, isRefined, true, false}, memory, brackets);
}

}  // namespace

Result<BracketQuery> BracketQuery::build(const Avatar& avatar, const std::optional<Scene>& scene,
                                         const BracketOptions& options) {
  FORETOUCH_CHECK(checkedResolution(options.resolution));
  if (scene) FORETOUCH_CHECK(internal::checkedIgnored(avatar, *scene, options.ignored));
  FORETOUCH_CHECK(checkedSurface(avatar, options.surface, "surface"));
  if (options.self && options.self->avatarIdentity() != avatar.identity()) {
    return Error::in("self", ErrorCode::Mismatch, "expected the pair rules of this avatar");
  }
  BracketPlan plan{{BodyPlan::of(avatar, options.surface)},
                   scene,
                   options.resolution,
                   options.ignored,
                   {},
                   {},
                   options.workBudget};
  if (options.self) {
    plan.asked = internal::PairsAsked(avatar, plan.bodies[0].table, *options.self);
    plan.pairs = internal::askedLinks(avatar, *options.self);
  }
  return BracketQuery(std::make_shared<const BracketPlan>(std::move(plan)));
}

const Avatar& BracketQuery::avatar() const {
  return plan_->bodies[0].avatar;
}

Result<Done> BracketQuery::answer(const PosedStep& step, MotionModel model,
                                  const std::vector<LinkBound>& bounds, Scratch& scratch,
                                  StepBrackets& brackets) const {
  FORETOUCH_CHECK(checkedBounds(avatar(), bounds));
  auto& memory = scratch.of<BracketMemory>();
  beginAnswer(*plan_, memory, brackets);
  prepare(plan_->bodies[0], {step, model, &bounds}, memory.bodies[0]);
  answerStep(*plan_, memory, brackets);
  return Done{};
}

Result<Done> BracketQuery::answerGap(const PosedStep& step, const std::vector<LinkBound>& bounds,
                                     Scratch& scratch, StepBrackets& brackets) const {
  FORETOUCH_CHECK(checkedBounds(avatar(), bounds));
  auto& memory = scratch.of<BracketMemory>();
  beginAnswer(*plan_, memory, brackets);
  BodyBrackets& body = memory.bodies[0];
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const double most = bounds[i].error + 0.5 * step.seconds * bounds[i].speed;
    if (!internal::isSaid(most)) continue;
    body.growths[i] = StepGrowth{bounds[i].error, 0.0};
    body.most[i] = most;
  }
  body.levels[0].stand(avatar().skeleton(), step);
  const GrowthsOfGap growths(bounds, step.seconds);
  internal::bracketLinks(*plan_, {growths, true, false, false, false}, memory, brackets);
  return Done{};
}

Result<Done> BracketQuery::lookAhead(const PosedStep& step, double horizon,
                                     const std::vector<LinkBound>& bounds, Scratch& scratch,
                                     StepBrackets& brackets) const {
  FORETOUCH_CHECK(checkedBounds(avatar(), bounds));
  if (!(horizon > 0.0 && horizon <= 1e6)) {
    return Error::in("horizon", ErrorCode::OutOfRange, "expected seconds, above 0");
  }
  auto& memory = scratch.of<BracketMemory>();
  beginAnswer(*plan_, memory, brackets);
  BodyBrackets& body = memory.bodies[0];
  const bool goesOn = body.levels[0].goOn(avatar().skeleton(), step, horizon);
  for (std::size_t i = 0; goesOn && i < bounds.size(); ++i) {
    const LinkBound& bound = bounds[i];
    if (!std::isfinite(bound.aheadSpeed + bound.aheadAcceleration + bound.error)) continue;
    body.growths[i] = StepGrowth{bound.error, 0.0};
    body.most[i] =
        bound.error + horizon * (bound.aheadSpeed + 0.5 * horizon * bound.aheadAcceleration);
  }
  const GrowthsAhead growths(bounds, horizon);
  internal::bracketLinks(*plan_, {growths, true, false, true, true}, memory, brackets);
  return Done{};
}

Result<PairBracketQuery> PairBracketQuery::build(const Avatar& one, const Avatar& other,
                                                 const Options& options) {
  FORETOUCH_CHECK(checkedResolution(options.resolution));
  FORETOUCH_CHECK(checkedSurface(one, options.surface, "surface"));
  FORETOUCH_CHECK(checkedSurface(other, options.otherSurface, "other surface"));
  return PairBracketQuery(std::make_shared<const BracketPlan>(
      BracketPlan{{BodyPlan::of(one, options.surface), BodyPlan::of(other, options.otherSurface)},
                  std::nullopt,
                  options.resolution,
                  {},
                  {},
                  {},
                  options.workBudget}));
}

Result<Done> PairBracketQuery::answer(const PersonStep& one, const PersonStep& other,
                                      Scratch& scratch, StepBrackets& brackets) const {
  const std::pair<const PersonStep*, const char*> asked[] = {{&one, "one"}, {&other, "other"}};
  for (std::size_t body = 0; body < 2; ++body) {
    const auto& [person, name] = asked[body];
    FORETOUCH_CHECK(checkedBounds(plan_->bodies[body].avatar, *person->bounds, name));
    if (person->begin >= 0.0 && person->begin < person->end && person->end <= 1.0) continue;
    return Error::in(name, ErrorCode::OutOfRange, "expected a part of the step, in [0,1]");
  }
  auto& memory = scratch.of<BracketMemory>();
  beginAnswer(*plan_, memory, brackets);
  for (std::size_t body = 0; body < 2; ++body) {
    prepare(plan_->bodies[body], *asked[body].first, memory.bodies[body]);
  }
  answerStep(*plan_, memory, brackets);
  return Done{};
}

}  // namespace foretouch
