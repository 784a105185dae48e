#include "tools/repair/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "tools/repair/reasons.h"
#include "tools/repair/rows.h"

namespace foretouch::tools {
namespace {

/// What is still at fault after so many rounds no longer pulls on the rest.
constexpr std::int32_t kGiveUpAfter = 14;
/// No joint turns by more in one round (rad): rows are linear.
constexpr double kMostTurnPerRound = 0.2;
/// Seconds over which a change fades: the shortest that adds no more than kMostJerk, as a longer
/// one moves more.
constexpr std::array<double, kMostTries> kReachesS{0.02, 0.035, 0.06};
/// The jerk that is added at the poses that change, as a share of what was there.
constexpr double kMostJerk = 0.04;
/// Seconds after which a change is over.
constexpr double kMarginS = 0.6;

LeastChangeOptions optionsOf(const RepairStage& stage, double reachS) {
  LeastChangeOptions options;
  options.reach = std::max(1.0, reachS / stage.feet().stepS());
  options.margin = static_cast<std::int32_t>(std::ceil(kMarginS / stage.feet().stepS()));
  options.isFreeBefore = !stage.isCutBefore();
  options.isFreeAfter = !stage.isCutAfter();
  return options;
}

bool isRough(const Measures& measures) {
  return measures.jerkChanged.added() > kMostJerk;
}

/// The changes from one towards another, as far as rows are to be trusted: less about poses that
/// would be turned far.
Changes stepped(const Changes& from, const Changes& to, std::int32_t reach) {
  const Changes way = to - from;
  const Eigen::Index poses = way.cols(), around = 2 * reach;
  Eigen::VectorXd share(poses);
  for (Eigen::Index p = 0; p < poses; ++p) {
    const Eigen::Index first = std::max<Eigen::Index>(0, p - around);
    const Eigen::Index count = std::min(poses, p + around + 1) - first;
    const double most = way.middleCols(first, count).cwiseAbs().maxCoeff();
    share[p] = std::min(1.0, kMostTurnPerRound / std::max(most, kMostTurnPerRound));
  }
  Changes stepped = from;
  for (Eigen::Index p = 0; p < poses; ++p) {
    const Eigen::Index first = std::max<Eigen::Index>(0, p - around);
    const Eigen::Index count = std::min(poses, p + around + 1) - first;
    stepped.col(p) += share.segment(first, count).mean() * way.col(p);
  }
  return stepped;
}

/// The rounds with changes of one reach, and the best of them.
class Rounds {
 public:
  Rounds(RepairStage& stage, double reachS)
      : stage_(stage),
        before_(stage.poses()),
        options_(optionsOf(stage, reachS)),
        demands_(stage),
        levers_(stage) {}

  /// False, and `repair` is of no use: progress() stopped it, or its first round is too rough.
  Result<bool> run(const std::function<bool(std::int32_t)>& progress, bool mayBeRough,
                   Repair& repair);

 private:
  Result<bool> next(Faults& faults);

  RepairStage& stage_;
  const std::vector<Pose> before_;
  LeastChangeOptions options_;
  Demands demands_;
  Levers levers_;
  Rows rows_;
  Eigen::MatrixXd metric_;
};

/// False: there is no more to do.
Result<bool> Rounds::next(Faults& faults) {
  const Changes changes = stage_.changes();
  levers_.setChanges(changes);
  Rows rows = rowsOf(stage_, levers_, demands_, changes);
  if (rows.rows.empty()) return false;
  if (metric_.size() == 0) metric_ = levers_.metric();
  const LeastChange least = leastChange(metric_, stage_.numPoses(), rows.rows, options_);
  if (!least.isSolved) return false;
  rows_ = std::move(rows);
  const auto reach = static_cast<std::int32_t>(std::ceil(options_.reach));
  FORETOUCH_CHECK(stage_.change(stepped(changes, least.changes, reach)));
  FORETOUCH_TRY(faults, faultsOf(stage_));
  return true;
}

Result<bool> Rounds::run(const std::function<bool(std::int32_t)>& progress, bool mayBeRough,
                         Repair& repair) {
  Faults faults = repair.before;
  Changes best = stage_.changes();
  std::int64_t fewest = faults.faulty;
  Rows pushing;
  for (std::int32_t round = 0; round < kMostRounds; ++round) {
    if (!progress(round)) return false;
    const bool asksMore = demands_.take(faults);
    if (faults.faulty == 0 && (round == 0 || !asksMore)) break;
    if (round == kGiveUpAfter) {
      pushing = rows_;
      demands_.giveUp(faults);
    }
    FORETOUCH_TRY(const bool goesOn, next(faults));
    if (!goesOn) break;
    // Later rounds add to the jerk.
    if (round == 0 && !mayBeRough && isRough(measuresOf(stage_, before_))) return false;
    repair.rounds = round + 1;
    if (faults.faulty > fewest) continue;
    fewest = faults.faulty;
    best = stage_.changes();
  }
  FORETOUCH_CHECK(stage_.change(best));
  FORETOUCH_TRY(repair.bytes, stage_.file().with(stage_.ofFile(best)));
  FORETOUCH_TRY(auto clip, stage_.file().reread(repair.bytes));
  FORETOUCH_CHECK(stage_.replaceBy(std::move(clip)));
  FORETOUCH_TRY(repair.after, faultsOf(stage_));
  repair.unmended =
      unmendedOf(stage_, repair.after, demands_, pushing.rows.empty() ? rows_ : pushing);
  repair.measures = measuresOf(stage_, before_);
  return true;
}

/// The less, the better: what stays at fault, then what is rough.
std::pair<std::int64_t, double> worthOf(const Repair& repair) {
  const double added = repair.measures.jerkChanged.added();
  return {repair.after.faulty, isRough(repair.measures) ? added : 0.0};
}

}  // namespace

Result<Repair> repaired(RepairStage& stage, const std::function<bool(std::int32_t)>& progress) {
  Repair best;
  FORETOUCH_TRY(const Faults before, faultsOf(stage));
  const Changes none = stage.changes();
  std::int32_t asked = 0;
  for (std::size_t i = 0; i < kReachesS.size(); ++i) {
    const bool isLast = i + 1 == kReachesS.size();
    // At few poses per second the shorter ones are the same.
    if (!isLast && kReachesS[i + 1] <= stage.feet().stepS()) continue;
    Repair repair;
    repair.before = before;
    bool isStopped = false;
    const auto asks = [&](std::int32_t round) {
      isStopped = !progress(asked + round);
      return !isStopped;
    };
    FORETOUCH_CHECK(stage.change(none));
    FORETOUCH_TRY(const bool isOfUse, Rounds(stage, kReachesS[i]).run(asks, isLast, repair));
    if (isStopped) return repair;
    if (!isOfUse) continue;
    asked += repair.rounds;
    const bool isDone = repair.after.faulty == 0 && !isRough(repair.measures);
    if (best.bytes.empty() || worthOf(repair) < worthOf(best)) best = std::move(repair);
    if (isDone) break;
  }
  FORETOUCH_TRY(auto clip, stage.file().reread(best.bytes));
  FORETOUCH_CHECK(stage.replaceBy(std::move(clip)));
  for (const BearingStance& stance : best.before.bearing) {
    if (stance.isMeant(stage.request().mostSlide)) best.meant.push_back(stance);
  }
  return best;
}

}  // namespace foretouch::tools
