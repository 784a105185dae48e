// middleware/bracket/model_levels.h: how finely the models of a question are cut: the coarsest
// level that says anything of every link that is asked, and finer ones. Not installed.
#pragma once

#include <cstddef>

#include "middleware/bracket/bracket_plan.h"

namespace foretouch::internal {

/// The whole step as one piece of every body. False: of some link that says nothing.
[[nodiscard]] bool cutWhole(const BracketPlan& plan, BracketMemory& memory);
/// Every body's pieces at the same level, `memory.base`: the coarsest that says something of all
/// links that are open. False: none does.
[[nodiscard]] bool cutBase(const BracketPlan& plan, BracketMemory& memory);
/// Unless it is cut.
void cutLevel(const BracketPlan& plan, std::size_t body, int level, BracketMemory& memory);
/// From the base level on, the one of which the link strays little.
[[nodiscard]] int levelFor(const BracketPlan& plan, std::size_t body, LinkId link,
                           BracketMemory& memory);

}  // namespace foretouch::internal
