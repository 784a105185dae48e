#include "tools/repair/reasons.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// Faults of one kind within so many steps are one fault.
constexpr std::int32_t kTogether = 2;
/// Rows that push this much less than the strongest one do not count.
constexpr double kWeak = 0.05;

const Side* sideOf(const Demands& demands, const Unmended& fault) {
  for (const Side& side : demands.sides()) {
    const bool isIts =
        side.link == fault.link && side.other == fault.other && side.object == fault.object;
    if (isIts && side.first <= fault.last && fault.first <= side.last + 1) return &side;
  }
  return nullptr;
}

bool isSame(const RowOwner& owner, const Unmended& fault) {
  if (owner.kind == FaultKind::Slide || owner.kind == FaultKind::Limit)
    return owner.kind == fault.kind;
  return owner.link == fault.link && owner.other == fault.other && owner.object == fault.object;
}

/// The row that pushes hardest against it, at the same poses.
const RowOwner* opponentOf(const Rows& rows, const Unmended& fault) {
  double most = 0.0, own = 0.0;
  const RowOwner* strongest = nullptr;
  for (std::size_t r = 0; r < rows.rows.size(); ++r) {
    const RowOwner& owner = rows.owners[r];
    const double push = std::abs(rows.rows[r].push);
    if (owner.step < fault.first - kTogether || owner.step > fault.last + kTogether) continue;
    if (isSame(owner, fault)) {
      own = std::max(own, push);
    } else if (push > most) {
      most = push;
      strongest = &owner;
    }
  }
  return most > kWeak * own ? strongest : nullptr;
}

std::string reasonOf(const RepairStage& stage, const Unmended& fault, bool isUndecided,
                     const Demands& demands, const Rows& rows) {
  if (isUndecided) return "the kernel could not decide it";
  if (const Side* const side = sideOf(demands, fault)) {
    if (side->isLost) return "it goes through and does not come back, so no side is the free one";
    if (side->normal_W.isZero(0.0)) return "it begins inside, and no way out is known";
  }
  if (const RowOwner* const other = opponentOf(rows, fault)) {
    return "what it asks contradicts: " +
           faultText(stage, other->kind, other->link, other->other, other->object);
  }
  return "no change was found in " + std::to_string(kMostRounds) + " rounds";
}

}  // namespace

std::string faultText(const RepairStage& stage, FaultKind kind, LinkId link, LinkId other,
                      ObjectId object) {
  if (kind == FaultKind::Limit) return stage.knobs()[slotOf(link)].name + " beyond its limits";
  const Skeleton& skeleton = stage.body().skeleton();
  std::string text = skeleton.name(link);
  switch (kind) {
    case FaultKind::Scene:
      text += " touches ";
      text += object < 0 ? "the scene" : stage.feet().level.scene().objectNames()[slotOf(object)];
      break;
    case FaultKind::Own: text += " touches " + skeleton.name(other); break;
    case FaultKind::Under: text += " is under the ground"; break;
    case FaultKind::Slide: text += " slides"; break;
    case FaultKind::Limit: break;
  }
  return text;
}

std::vector<Unmended> unmendedOf(const RepairStage& stage, const Faults& after,
                                 const Demands& demands, const Rows& rows) {
  std::vector<Unmended> all;
  std::vector<std::uint8_t> isUndecided;
  for (const StepFault& fault : after.all) {
    const auto known = std::find_if(all.begin(), all.end(), [&](const Unmended& run) {
      return run.kind == fault.kind && run.link == fault.link && run.other == fault.other &&
             run.object == fault.object && fault.step <= run.last + kTogether;
    });
    if (known == all.end()) {
      all.push_back({fault.kind, fault.link, fault.other, fault.object, fault.step, fault.step + 1,
                     fault.by, ""});
      isUndecided.push_back(fault.isUndecided ? 1 : 0);
      continue;
    }
    known->last = std::max(known->last, fault.step + 1);
    known->by = std::max(known->by, fault.by);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].last = std::min(all[i].last, stage.numPoses() - 1);
    all[i].reason = reasonOf(stage, all[i], isUndecided[i] != 0, demands, rows);
  }
  return all;
}

}  // namespace foretouch::tools
