// middleware/bracket/bracket.h: what is claimed of how far a person may be from a model of the
// motion, and what follows from it for a step: what each link surely touched, may have touched, or
// cannot have touched. Metres in the world W, seconds; t is 0 at the earlier pose and 1 at the
// later. The promise: docs/person.md; its proof: middleware/bracket/bracket.md.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion_model.h"
#include "articulated/pair_rules.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"
#include "middleware/scratch.h"
#include "middleware/surface/avatar_surface.h"

namespace foretouch {

/// How far every point of a link's axes may be from where the model has it. A claim of the caller:
/// the answers rest on it. What is infinite is not claimed.
struct LinkBound {
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  double error = 0.0;           ///< In a pose (m): the tracker's own.
  double acceleration = kNone;  ///< That of person minus model, in a step (m/s^2).
  /// Instead, if less: a length (m) and a share of how much the poses around the step bend there.
  double followFloor = kNone, followShare = 0.0;
  double speed = kNone;  ///< The person's, where poses were lost (m/s).
  /// After the last pose, for person minus model: the speed there (m/s) and the acceleration
  /// (m/s^2).
  double aheadSpeed = 0.0, aheadAcceleration = kNone;
};

enum class BracketVerdict : std::uint8_t {
  Unclaimed,  ///< No bound holds for the link in this step: nothing is claimed.
  Excluded,   ///< Proven: whatever the person did within the bounds, the link touched nothing.
  Possible,   ///< It may have touched something.
  Certain,    ///< Proven: whatever the person did within the bounds, the link touched something.
};
/// "unclaimed", "excluded", "possible", "certain".
[[nodiscard]] const char* toString(BracketVerdict verdict);

/// One body in a step: what stands for it, what is claimed of each of its links, and which part of
/// the step is asked.
struct PersonStep {
  PosedStep step;
  MotionModel model = MotionModel::ConstantRate;
  const std::vector<LinkBound>* bounds = nullptr;  ///< One per link.
  double begin = 0.0, end = 1.0;                   ///< t of the step; begin < end.
};

/// A link in a step. It touched nothing on [0, possibleFrom) and (possibleUntil, 1]; a Certain one
/// touched something at certainFrom and at certainUntil, or passed it in between.
struct LinkBracket {
  LinkId link = 0;
  /// An own link above `link`, or a link of the other body; kNoParent: the scene.
  LinkId other = kNoParent;
  BracketVerdict verdict = BracketVerdict::Unclaimed;
  double possibleFrom = 0.0, possibleUntil = 1.0;
  double certainFrom = 1.0, certainUntil = 0.0;  ///< In between, where certainUntil comes first.
  TriangleId triangle = -1;  ///< What of the scene is, or may be, touched first; else -1.
  double growth = 0.0;       ///< The largest distance between person and model, of both sides (m).
};

struct StepBrackets {
  std::vector<LinkBracket> links;  ///< One per link, in order; none without a scene.
  /// For own links, or for two bodies: every asked pair that is not excluded.
  std::vector<LinkBracket> pairs;
  std::int32_t pieces = 0;  ///< Pieces of constant rate that stand for the model.
  std::uint64_t looks = 0;  ///< Distances of two parts.
  std::uint64_t work = 0;   ///< As BracketOptions::workBudget counts it.
  bool isSpent = false;  ///< The budget was: what is possible might have been excluded, or certain.
};

struct BracketOptions {
  /// Exact fidelity: the links' triangles in place of the LSS that hold them. Those have no inside,
  /// so touches are never certain.
  std::optional<AvatarSurface> surface;
  std::optional<PairRules> self;  ///< Own links; nothing: not asked.
  std::vector<IgnoredPair> ignored;
  /// Instants are as near to the true ones as this distance (m), 1e-9 to 1.
  double resolution = 1e-5;
  /// For one answer, counted as QueryOptions::workBudget is: the same on every machine. Once it is
  /// spent, what is still open is possible; finding what is open is not counted.
  std::uint64_t workBudget = std::numeric_limits<std::uint64_t>::max();
};

namespace internal {
struct BracketPlan;
}

/// Checked and resolved once. Copies are cheap; any number of threads may ask one, each with a
/// scratch of its own.
class BracketQuery {
 public:
  /// Without a scene own links alone are asked. Errors: a surface, rules or ignored pairs of
  /// another avatar or scene; a resolution out of range.
  static Result<BracketQuery> build(const Avatar& avatar, const std::optional<Scene>& scene,
                                    const BracketOptions& options = {});

  /// `bounds`: one per link. Errors: another number of bounds; one that is negative or not a number
  /// (Error::index is the link). Allocates nothing once scratch and answer have grown.
  Result<Done> answer(const PosedStep& step, MotionModel model,
                      const std::vector<LinkBound>& bounds, Scratch& scratch,
                      StepBrackets& brackets) const;
  /// Poses were lost between the two: only LinkBound::speed and error count.
  Result<Done> answerGap(const PosedStep& step, const std::vector<LinkBound>& bounds,
                         Scratch& scratch, StepBrackets& brackets) const;
  /// What comes: t is 0 at the step's `to` and 1 after `horizon` seconds. The model goes on as it
  /// went in the step. Links are Excluded or Possible, from possibleFrom on.
  Result<Done> lookAhead(const PosedStep& step, double horizon,
                         const std::vector<LinkBound>& bounds, Scratch& scratch,
                         StepBrackets& brackets) const;

  [[nodiscard]] const Avatar& avatar() const;

 private:
  explicit BracketQuery(std::shared_ptr<const internal::BracketPlan> plan)
      : plan_(std::move(plan)) {}

  std::shared_ptr<const internal::BracketPlan> plan_;
};

/// The same for two bodies that both move: for every link of one and every link of the other. An
/// object that moves is a body of one link; where its motion is known, its bound is 0.
class PairBracketQuery {
 public:
  struct Options {
    std::optional<AvatarSurface> surface, otherSurface;  ///< Exact fidelity.
    double resolution = 1e-5;                            ///< As BracketOptions has it, and
    std::uint64_t workBudget = std::numeric_limits<std::uint64_t>::max();  ///< this, too.
  };
  /// Errors: a surface of another avatar; a resolution out of range.
  static Result<PairBracketQuery> build(const Avatar& one, const Avatar& other,
                                        const Options& options);

  /// The asked parts of both steps begin and end at the same instants: t is 0 at their begin and 1
  /// at their end. Fills `brackets.pairs`. Errors: those of BracketQuery::answer() (the file is
  /// "one" or "other"); a part out of range. Allocates nothing once scratch and answer have grown.
  Result<Done> answer(const PersonStep& one, const PersonStep& other, Scratch& scratch,
                      StepBrackets& brackets) const;

 private:
  explicit PairBracketQuery(std::shared_ptr<const internal::BracketPlan> plan)
      : plan_(std::move(plan)) {}

  std::shared_ptr<const internal::BracketPlan> plan_;
};

}  // namespace foretouch
