#include "tools/repair/repair.h"

#include <algorithm>
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
/// Seconds over which a change fades, and after which it is over.
constexpr double kReachS = 0.06, kMarginS = 0.6;

LeastChangeOptions optionsOf(const RepairStage& stage) {
  LeastChangeOptions options;
  options.reach = std::max(1.0, kReachS / stage.feet().stepS());
  options.margin = static_cast<std::int32_t>(std::ceil(kMarginS / stage.feet().stepS()));
  options.isFreeBefore = !stage.isCutBefore();
  options.isFreeAfter = !stage.isCutAfter();
  return options;
}

/// From one change towards another one, as far as rows are to be trusted: less about poses that
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

/// The rounds, and the best of them.
class Rounds {
 public:
  explicit Rounds(RepairStage& stage) : stage_(stage), demands_(stage), levers_(stage) {}

  Result<Done> run(const std::function<bool(std::int32_t)>& progress, Repair& repair);

 private:
  Result<bool> next(Faults& faults);

  RepairStage& stage_;
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
  const LeastChange least = leastChange(metric_, stage_.numPoses(), rows.rows, optionsOf(stage_));
  if (!least.isSolved) return false;
  rows_ = std::move(rows);
  const auto reach = static_cast<std::int32_t>(std::ceil(optionsOf(stage_).reach));
  FORETOUCH_CHECK(stage_.change(stepped(changes, least.changes, reach)));
  FORETOUCH_TRY(faults, faultsOf(stage_));
  return true;
}

Result<Done> Rounds::run(const std::function<bool(std::int32_t)>& progress, Repair& repair) {
  Faults faults = repair.before;
  Changes best = stage_.changes();
  std::int64_t fewest = faults.faulty;
  Rows pushing;
  for (std::int32_t round = 0; round < kMostRounds; ++round) {
    if (!progress(round)) return Done{};
    const bool asksMore = demands_.take(faults);
    if (faults.faulty == 0 && (round == 0 || !asksMore)) break;
    if (round == kGiveUpAfter) {
      pushing = rows_;
      demands_.giveUp(faults);
    }
    FORETOUCH_TRY(const bool goesOn, next(faults));
    if (!goesOn) break;
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
  return Done{};
}

}  // namespace

Result<Repair> repaired(RepairStage& stage, const std::function<bool(std::int32_t)>& progress) {
  Repair repair;
  FORETOUCH_TRY(repair.before, faultsOf(stage));
  const std::vector<Pose> before = stage.poses();
  FORETOUCH_CHECK(Rounds(stage).run(progress, repair));
  repair.measures = measuresOf(stage, before);
  for (const BearingStance& stance : repair.before.bearing) {
    if (stance.isMeant(stage.request().mostSlide)) repair.meant.push_back(stance);
  }
  return repair;
}

}  // namespace foretouch::tools
