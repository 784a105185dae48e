// middleware/bracket/bracket_query.h: what a person surely touched, may have touched and cannot
// have touched between two poses, given how far the person may be from a model of the motion.
// Metres in the world W, seconds; t is 0 at the earlier pose and 1 at the later. The promise:
// docs/person.md; its proof: middleware/bracket/bracket.md.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion_model.h"
#include "articulated/result.h"
#include "middleware/bracket/bracket.h"
#include "middleware/scene/scene.h"
#include "middleware/scratch.h"
#include "middleware/surface/avatar_surface.h"

namespace foretouch {

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

/// The same of two bodies that both move: of every link of one and every link of the other. An
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
  /// "one" or "other"); a part that is none. Allocates nothing once scratch and answer have grown.
  Result<Done> answer(const PersonStep& one, const PersonStep& other, Scratch& scratch,
                      StepBrackets& brackets) const;

 private:
  explicit PairBracketQuery(std::shared_ptr<const internal::BracketPlan> plan)
      : plan_(std::move(plan)) {}

  std::shared_ptr<const internal::BracketPlan> plan_;
};

}  // namespace foretouch
