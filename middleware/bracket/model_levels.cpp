#include "middleware/bracket/model_levels.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

constexpr int kLastLevel = BodyBrackets::kLevels - 1;

/// Links may stray from the base level's pieces by what the person may, or by this (m).
constexpr double kBaseStray = 2e-3;

/// Pieces stray from the model by about this share of what the person may, or by so many
/// resolutions: more of them cost more than they bring.
constexpr double kStrayShare = 1.0 / 4.0, kStrayResolutions = 2.0;

/// How many times farther an open link strays than it may; infinite: that cannot be said.
double excessOf(const BodyPlan& plan, const BodyBrackets& memory, ModelPieces& pieces) {
  double most = 0.0;
  for (int k = 0; k < pieces.count(); ++k) {
    for (LinkId link = 0; link < plan.avatar.numLinks(); ++link) {
      const auto i = slotOf(link);
      if (!memory.growths[i] || memory.isOpen[i] == 0) continue;
      const double stray = pieces.piece(k).strays[i].at(plan.rho[i]);
      most = std::max(most, stray / std::max(memory.growths[i]->most, kBaseStray));
    }
  }
  return most;
}

bool cut(const BodyPlan& plan, BodyBrackets& memory, int level) {
  if (memory.cuts[slotOf(level)] == LevelCut::None) {
    const bool isKnown = memory.levels[slotOf(level)].cut(
        plan.avatar, memory.part, memory.model, {1 << level, memory.isMoved, memory.places});
    memory.cuts[slotOf(level)] = isKnown ? LevelCut::Known : LevelCut::Unknown;
  }
  return memory.cuts[slotOf(level)] == LevelCut::Known;
}

/// The coarsest level from `base` on of which no open link strays too far; nothing: none says
/// anything.
std::optional<int> cutBaseOf(const BodyPlan& plan, BodyBrackets& memory, int base) {
  for (;;) {
    const bool isKnown = cut(plan, memory, base);
    const double excess = isKnown ? excessOf(plan, memory, memory.levels[slotOf(base)]) : 4.0;
    if (isKnown && (excess <= 1.0 || base == kLastLevel)) return base;
    if (base == kLastLevel) return std::nullopt;
    // Halving a piece quarters what it strays.
    const int more = static_cast<int>(std::ceil(0.5 * std::log2(std::max(2.0, excess))));
    base = std::min(base + more, kLastLevel);
  }
}

}  // namespace

bool cutWhole(const BracketPlan& plan, BracketMemory& memory) {
  bool isKnown = true;
  for (std::size_t body = 0; body < plan.bodies.size(); ++body) {
    isKnown = cut(plan.bodies[body], memory.bodies[body], 0) && isKnown;
  }
  return isKnown;
}

bool cutBase(const BracketPlan& plan, BracketMemory& memory) {
  for (std::size_t body = 0; body < plan.bodies.size(); ++body) {
    const auto base = cutBaseOf(plan.bodies[body], memory.bodies[body], memory.base);
    if (!base) return false;
    memory.base = *base;
  }
  return cut(plan.bodies[0], memory.bodies[0], memory.base);
}

void cutLevel(const BracketPlan& plan, std::size_t body, int level, BracketMemory& memory) {
  (void)cut(plan.bodies[body], memory.bodies[body], level);
}

int levelFor(const BracketPlan& plan, std::size_t body, LinkId link, BracketMemory& memory) {
  const auto i = slotOf(link);
  BodyBrackets& own = memory.bodies[body];
  ModelPieces& base = own.levels[slotOf(memory.base)];
  double stray = 0.0;
  for (int k = 0; k < base.count(); ++k) {
    stray = std::max(stray, base.piece(k).strays[i].at(plan.bodies[body].rho[i]));
  }
  const double allowed =
      std::max(kStrayShare * own.growths[i]->most, kStrayResolutions * plan.resolution);
  int level = memory.base;
  // Halving a piece quarters what it strays.
  for (; stray > allowed && level < kLastLevel; ++level) stray *= 0.25;
  return level;
}

}  // namespace foretouch::internal
