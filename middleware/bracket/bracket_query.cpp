#include "middleware/bracket/bracket_query.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/bracket/bracket_run.h"
#include "middleware/pair/query_plan.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::BracketMemory;
using internal::BracketPlan;
using internal::Growth;
using internal::ModelPiece;
using internal::ModelPieces;
using internal::StepGrowth;

Result<Done> checkedBounds(const Avatar& avatar, const std::vector<LinkBound>& bounds) {
  if (bounds.size() != countOf(avatar.numLinks())) {
    return Error::in("bounds", ErrorCode::Mismatch,
                     "expected one per link: " + std::to_string(avatar.numLinks()));
  }
  LinkId link = 0;
  for (const LinkBound& bound : bounds) {
    for (const double value :
         {bound.error, bound.acceleration, bound.followFloor, bound.followShare, bound.speed,
          bound.aheadSpeed, bound.aheadAcceleration}) {
      if (!(value >= 0.0)) {
        return Error{ErrorCode::OutOfRange, "bounds", -1, link, "expected numbers, at least 0"};
      }
    }
    ++link;
  }
  return Done{};
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
  PoseBends(const PosedStep& step, const Skeleton& skeleton, BracketMemory& memory)
      : step_(step), memory_(memory) {
    place(step.before, skeleton, memory.before);
    place(step.from, skeleton, memory.from);
    place(step.to, skeleton, memory.to);
    place(step.after, skeleton, memory.after);
  }
  [[nodiscard]] double of(const Avatar& avatar, LinkId link) const {
    double most = 0.0;
    for (const Lss& lss : avatar.lss(link)) {
      for (const Vector3d& end : {lss.a, lss.b}) most = std::max(most, ofPoint(link, end));
    }
    return most;
  }

 private:
  void place(const Pose* pose, const Skeleton& skeleton, std::vector<LinkState>& states) {
    if (pose == nullptr) return;
    memory_.standing.assign(skeleton, *pose, *pose);
    memory_.standing.statesAt(0.0, states);
  }
  [[nodiscard]] double ofPoint(LinkId link, const Vector3d& p_L) const {
    const auto placed = [&](const std::vector<LinkState>& states) {
      return states[slotOf(link)].pointAt(p_L);
    };
    const Vector3d from = placed(memory_.from), to = placed(memory_.to);
    const Vector3d rate = (to - from) / step_.seconds;
    double sum = 0.0;
    int count = 0;
    const auto add = [&](const Vector3d& change, double seconds) {
      sum += 2.0 * (rate - change / seconds).norm() / (step_.seconds + seconds);
      ++count;
    };
    if (step_.before != nullptr) add(from - placed(memory_.before), step_.secondsBefore);
    if (step_.after != nullptr) add(placed(memory_.after) - to, step_.secondsAfter);
    if (count == 0) return LinkBound::kNone;
    return sum / count * step_.seconds * step_.seconds;
  }

  const PosedStep& step_;
  BracketMemory& memory_;
};

void beginAnswer(const Avatar& avatar, BracketMemory& memory, StepBrackets& brackets) {
  const auto numLinks = countOf(avatar.numLinks());
  brackets.links.assign(numLinks, LinkBracket{});
  for (LinkId link = 0; link < avatar.numLinks(); ++link) brackets.links[slotOf(link)].link = link;
  brackets.pairs.clear();
  brackets.pieces = 0;
  brackets.looks = memory.sides.looks = 0;
  memory.growths.assign(numLinks, std::nullopt);
  memory.most.assign(numLinks, 0.0);
  memory.isCut = {};
  memory.base = 0;
}

/// Of a step between two poses.
class GrowthsOfStep final : public internal::PieceGrowths {
 public:
  GrowthsOfStep(const BracketPlan& plan, const BracketMemory& memory)
      : plan_(plan), memory_(memory) {}
  [[nodiscard]] Growth of(const ModelPiece& piece, LinkId link) const override {
    const auto i = slotOf(link);
    const double stray = piece.strays[i].at(plan_.rho[i]) * internal::kInflation;
    return memory_.growths[i]->in(piece.begin, piece.end, stray);
  }

 private:
  const BracketPlan& plan_;
  const BracketMemory& memory_;
};

/// Of a gap of `seconds`, each half of which stands still (bracket.md 5).
class GrowthsOfGap final : public internal::PieceGrowths {
 public:
  GrowthsOfGap(const std::vector<LinkBound>& bounds, double seconds)
      : bounds_(bounds), seconds_(seconds) {}
  [[nodiscard]] Growth of(const ModelPiece& piece, LinkId link) const override {
    const LinkBound& bound = bounds_[slotOf(link)];
    const double way = 0.5 * seconds_ * bound.speed * internal::kInflation;
    return piece.begin == 0.0 ? Growth{bound.error, way, 0.0}
                              : Growth{bound.error + way, -way, 0.0};
  }

 private:
  const std::vector<LinkBound>& bounds_;
  double seconds_;
};

/// Of what comes, up to a horizon (s).
class GrowthsAhead final : public internal::PieceGrowths {
 public:
  GrowthsAhead(const std::vector<LinkBound>& bounds, double horizon)
      : bounds_(bounds), horizon_(horizon) {}
  [[nodiscard]] Growth of(const ModelPiece& piece, LinkId link) const override {
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

/// Links may stray from the base level's pieces by what the person may, or by this (m).
constexpr double kBaseStray = 2e-3;

/// How many times farther a link strays than it may; infinite: that cannot be said.
double excessOf(const BracketPlan& plan, const BracketMemory& memory, ModelPieces& pieces) {
  double most = 0.0;
  for (int k = 0; k < pieces.count(); ++k) {
    for (LinkId link = 0; link < plan.avatar.numLinks(); ++link) {
      const auto i = slotOf(link);
      if (!memory.growths[i]) continue;
      const double stray = pieces.piece(k).strays[i].at(plan.rho[i]);
      most = std::max(most, stray / std::max(memory.growths[i]->most, kBaseStray));
    }
  }
  return most;
}

/// The coarsest level of which no link strays too far; false: none says anything.
bool cutBase(const BracketPlan& plan, const PosedStep& step, BracketMemory& memory) {
  for (memory.base = 0; memory.base < BracketMemory::kLevels;) {
    ModelPieces& pieces = memory.levels[slotOf(memory.base)];
    const bool isKnown = pieces.cut(plan.avatar.skeleton(), step, memory.model, 1 << memory.base);
    const double excess = isKnown ? excessOf(plan, memory, pieces) : 4.0;
    const bool isLast = memory.base + 1 == BracketMemory::kLevels;
    if (isKnown && (excess <= 1.0 || isLast)) {
      memory.isCut[slotOf(memory.base)] = 1;
      return true;
    }
    // Halving a piece quarters what it strays.
    const int more = static_cast<int>(std::ceil(0.5 * std::log2(std::max(2.0, excess))));
    memory.base =
        isLast ? BracketMemory::kLevels : std::min(memory.base + more, BracketMemory::kLevels - 1);
  }
  memory.base = 0;
  return false;
}

}  // namespace

Result<BracketQuery> BracketQuery::build(const Avatar& avatar, const Scene& scene,
                                         const BracketOptions& options) {
  if (!(options.resolution >= 1e-9 && options.resolution <= 1.0)) {
    return Error::in("resolution", ErrorCode::OutOfRange, "expected 1e-9 to 1 metres");
  }
  FORETOUCH_CHECK(internal::checkedIgnored(avatar, scene, options.ignored));
  if (options.surface && options.surface->numLinks() != avatar.numLinks()) {
    return Error::in("surface", ErrorCode::Mismatch, "expected the surface of this avatar");
  }
  if (options.self && options.self->avatarIdentity() != avatar.identity()) {
    return Error::in("self", ErrorCode::Mismatch, "expected the pair rules of this avatar");
  }
  BracketPlan plan{avatar, scene, options, LssTable(avatar), {}, {}, {}};
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    double rho = 0.0;
    for (const Lss& lss : avatar.lss(link)) {
      rho = std::max(rho,
                     std::max(lss.a.norm(), lss.b.norm()) + (options.surface ? lss.radius : 0.0));
    }
    plan.rho.push_back(rho * internal::kInflation);
  }
  if (options.self) {
    plan.asked = internal::PairsAsked(avatar, plan.table, *options.self);
    plan.pairs = internal::askedLinks(avatar, *options.self);
  }
  return BracketQuery(std::make_shared<const BracketPlan>(std::move(plan)));
}

const Avatar& BracketQuery::avatar() const {
  return plan_->avatar;
}

Result<Done> BracketQuery::answer(const PosedStep& step, MotionModel model,
                                  const std::vector<LinkBound>& bounds, Scratch& scratch,
                                  StepBrackets& brackets) const {
  const BracketPlan& plan = *plan_;
  FORETOUCH_CHECK(checkedBounds(plan.avatar, bounds));
  auto& memory = scratch.of<BracketMemory>();
  beginAnswer(plan.avatar, memory, brackets);
  memory.model.assign(plan.avatar.skeleton(), step, model);
  std::optional<PoseBends> bends;
  const bool isAnyFollowed = std::any_of(bounds.begin(), bounds.end(), [](const LinkBound& bound) {
    return std::isfinite(bound.followFloor);
  });
  if (isAnyFollowed) bends.emplace(step, plan.avatar.skeleton(), memory);
  for (LinkId link = 0; link < plan.avatar.numLinks(); ++link) {
    const auto i = slotOf(link);
    const double bend = bends ? bends->of(plan.avatar, link) : LinkBound::kNone;
    memory.growths[i] = StepGrowth::of(bounds[i], step.seconds, bend);
    if (memory.growths[i]) memory.most[i] = memory.growths[i]->largest();
  }
  if (!cutBase(plan, step, memory)) return Done{};
  const GrowthsOfStep growths(plan, memory);
  const bool isRefined = !memory.model.isConstantRate();
  internal::bracketLinks(plan, {step, growths, isRefined, true, false}, memory, brackets);
  return Done{};
}

Result<Done> BracketQuery::answerGap(const PosedStep& step, const std::vector<LinkBound>& bounds,
                                     Scratch& scratch, StepBrackets& brackets) const {
  FORETOUCH_CHECK(checkedBounds(plan_->avatar, bounds));
  auto& memory = scratch.of<BracketMemory>();
  beginAnswer(plan_->avatar, memory, brackets);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (!std::isfinite(bounds[i].speed + bounds[i].error)) continue;
    memory.growths[i] = StepGrowth{bounds[i].error, 0.0};
    memory.most[i] = bounds[i].error + 0.5 * step.seconds * bounds[i].speed;
  }
  memory.levels[0].stand(plan_->avatar.skeleton(), step);
  const GrowthsOfGap growths(bounds, step.seconds);
  internal::bracketLinks(*plan_, {step, growths, false, false, false}, memory, brackets);
  return Done{};
}

Result<Done> BracketQuery::lookAhead(const PosedStep& step, double horizon,
                                     const std::vector<LinkBound>& bounds, Scratch& scratch,
                                     StepBrackets& brackets) const {
  FORETOUCH_CHECK(checkedBounds(plan_->avatar, bounds));
  if (!(horizon > 0.0 && horizon <= 1e6)) {
    return Error::in("horizon", ErrorCode::OutOfRange, "expected seconds, above 0");
  }
  auto& memory = scratch.of<BracketMemory>();
  beginAnswer(plan_->avatar, memory, brackets);
  if (!memory.levels[0].goOn(plan_->avatar.skeleton(), step, horizon)) return Done{};
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const LinkBound& bound = bounds[i];
    if (!std::isfinite(bound.aheadSpeed + bound.aheadAcceleration + bound.error)) continue;
    memory.growths[i] = StepGrowth{bound.error, 0.0};
    memory.most[i] =
        bound.error + horizon * (bound.aheadSpeed + 0.5 * horizon * bound.aheadAcceleration);
  }
  const GrowthsAhead growths(bounds, horizon);
  internal::bracketLinks(*plan_, {step, growths, false, true, true}, memory, brackets);
  return Done{};
}

}  // namespace foretouch
