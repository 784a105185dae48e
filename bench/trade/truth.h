// bench/trade/truth.h: the truth about every link in a step. It comes from the product's plain
// scalar form at a tolerance finer than any measured one, on bodies a little thinner and a little
// thicker, so that verdicts on a strategy err on the safe side; and, for a sample of links, from a
// judge that shares no code with it (judge/hull_oracle.h).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "articulated/result.h"
#include "bench/trade/strategies.h"
#include "bench/workload.h"
#include "middleware/query/query.h"

namespace foretouch::tools {

/// The tolerance of the truth (m). Measured tolerances should not be finer.
inline constexpr double kTruthTolerance = 1e-7;

/// Certain facts about one link in one step.
struct LinkTruth {
  bool starts = false;     ///< In contact at t = 0.
  bool touches = false;    ///< It certainly touches.
  double freeUntil = 1.0;  ///< It does not touch before.
  double touchesBy = 1.0;  ///< If it touches: it has by then.
  bool operator==(const LinkTruth& o) const {
    return starts == o.starts && touches == o.touches && freeUntil == o.freeUntil &&
           touchesBy == o.touchesBy;
  }
};

/// The avatar with its radii changed by `by` (m), none below zero.
[[nodiscard]] Avatar withRadiiChanged(const Avatar& avatar, double by);

/// Computes the truth for an avatar in a scene. For one thread; not timed.
class TruthTeller {
 public:
  /// `surface`: for exact fidelity; none: the links' LSS.
  TruthTeller(const TradeWorld& world, const std::optional<AvatarSurface>& surface);

  /// One per link.
  [[nodiscard]] Result<std::vector<LinkTruth>> truthOf(const StepPoses& step);
  /// Per link: does it come nearer than `distance` (m) at any time? A link nearer by less than
  /// kTruthTolerance may count.
  [[nodiscard]] Result<std::vector<bool>> comesWithin(const StepPoses& step, double distance);
  /// Separation (m) of the link's LSS and the scene at `t`; not more than kFarM. Below zero: how
  /// deep the scene is within a radius.
  [[nodiscard]] double separationAt(const StepPoses& step, LinkId link, double t);

  static constexpr double kFarM = 2.0;

 private:
  [[nodiscard]] Result<StepContacts> ask(const Avatar& avatar, const StepPoses& step);

  const TradeWorld& world_;
  Avatar thinner_;
  double thickerBy_ = 0.0;
  std::optional<Avatar> thicker_;
  QueryOptions options_;
  ReferenceOptions reference_;
};

/// The judge's results for a sample of links.
struct JudgedTruth {
  std::int64_t links = 0;     ///< Examined.
  std::int64_t free = 0;      ///< Proven free for as long as the truth states.
  std::int64_t touching = 0;  ///< Shown to touch by the time that the truth states (of those that
                              ///< do).
  std::int64_t contacts = 0;  ///< Links that touch by the truth.
  std::int64_t open = 0;      ///< Not decided within the judge's budget.
  std::int64_t wrong = 0;     ///< The judge disagrees.
  void add(const JudgedTruth& other);
};

/// Asks the judge about one link: free until truth.freeUntil, touching by truth.touchesBy. Its
/// scene is the triangles that the link can reach.
[[nodiscard]] JudgedTruth judge(const TradeWorld& world, const StepPoses& step, LinkId link,
                                const LinkTruth& truth);

}  // namespace foretouch::tools
