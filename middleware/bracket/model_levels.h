// middleware/bracket/model_levels.h: how finely the models of a question are cut: the coarsest
// level that says anything of every link that is asked, and finer ones. Not installed.
#pragma once

#include <cstddef>

#include "middleware/bracket/bracket_plan.h"

namespace foretouch::internal {

/// Cuts the whole step as one piece of every body. False: that says nothing of some link.
[[nodiscard]] bool cutWhole(const BracketPlan& plan, BracketMemory& memory);
/// Cuts every body at the same level, `memory.base`: the coarsest that says something of all
/// links that are open. False: none does.
[[nodiscard]] bool cutBase(const BracketPlan& plan, BracketMemory& memory);
/// Cuts the level, unless it is cut.
void cutLevel(const BracketPlan& plan, std::size_t body, int level, BracketMemory& memory);
/// The first level from the base one on from whose pieces the link strays little.
[[nodiscard]] int levelFor(const BracketPlan& plan, std::size_t body, LinkId link,
                           BracketMemory& memory);

}  // namespace foretouch::internal
