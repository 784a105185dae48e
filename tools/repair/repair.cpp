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
constexpr std::int32_t kGiveUpAfter = 9;
/// No joint turns by more in one round (rad): rows are linear.
constexpr double kMostTurnPerRound = 0.35;
/// Seconds over which a change fades, and after which it is over.
constexpr double kReachS = 0.06, kMarginS = 0.6;

LeastChangeOptions optionsOf(const Stage& stage) {
  LeastChangeOptions options;
  options.reach = std::max(1.0, kReachS / stage.feet().stepS());
  options.margin = static_cast<std::int32_t>(std::ceil(kMarginS / stage.feet().stepS()));
  options.isFreeBefore = !stage.isCutBefore();
  options.isFreeAfter = !stage.isCutAfter();
  return options;
}

/// From one change towards another one, as far as rows are to be trusted.
Changes stepped(const Changes& from, const Changes& to) {
  const double most = (to - from).cwiseAbs().maxCoeff();
  return most <= kMostTurnPerRound ? to : Changes(from + (kMostTurnPerRound / most) * (to - from));
}

/// The rounds, and the best of them.
class Rounds {
 public:
  explicit Rounds(Stage& stage) : stage_(stage), demands_(stage), levers_(stage) {}

  Result<Done> run(const std::function<bool(std::int32_t)>& progress, Repair& repair);

 private:
  Result<bool> next(Faults& faults);

  Stage& stage_;
  Demands demands_;
  Levers levers_;
  Rows rows_;
};

/// False: there is no more to do.
Result<bool> Rounds::next(Faults& faults) {
  const Changes changes = stage_.changes();
  levers_.setChanges(changes);
  Rows rows = rowsOf(stage_, levers_, demands_, faults, changes);
  if (rows.rows.empty()) return false;
  const LeastChange least =
      leastChange(stage_.knobs(), stage_.numPoses(), rows.rows, optionsOf(stage_));
  if (!least.isSolved) return false;
  rows_ = std::move(rows);
  FORETOUCH_CHECK(stage_.change(stepped(changes, least.changes)));
  FORETOUCH_TRY(faults, faultsOf(stage_));
  return true;
}

Result<Done> Rounds::run(const std::function<bool(std::int32_t)>& progress, Repair& repair) {
  Faults faults = repair.before;
  Changes best = stage_.changes();
  std::int64_t fewest = faults.faulty;
  Rows pushing;
  for (std::int32_t round = 0; round < kMostRounds && faults.faulty > 0; ++round) {
    if (!progress(round)) return Done{};
    demands_.take(faults);
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
  repair.unmended = unmendedOf(stage_, repair.after, demands_, pushing.rows.empty() ? rows_ : pushing);
  return Done{};
}

}  // namespace

Result<Repair> repaired(Stage& stage, const std::function<bool(std::int32_t)>& progress) {
  Repair repair;
  FORETOUCH_TRY(repair.before, faultsOf(stage));
  const std::vector<Pose> before = stage.poses();
  FORETOUCH_CHECK(Rounds(stage).run(progress, repair));
  repair.measures = measuresOf(stage, before);
  for (const FootStance& stance : repair.before.feet.stances) {
    const bool isHand = stage.feet().body.parts[stance.part].isHand();
    const bool isFar = stance.slide >= kSlides && stance.moved > stage.request().mostSlide;
    if (isFar && !isHand) repair.meant.push_back(stance);
  }
  return repair;
}

}  // namespace foretouch::tools
