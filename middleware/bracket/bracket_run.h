// middleware/bracket/bracket_run.h: the answer to a question about brackets, once it is known how
// the growths of pieces follow. Not installed.
#pragma once

#include "middleware/bracket/bracket_plan.h"

namespace foretouch::internal {

/// Brackets every link, and every asked pair of own links or of two bodies, of which growths are
/// known.
void bracketLinks(const BracketPlan& plan, const BracketAsk& ask, BracketMemory& memory,
                  StepBrackets& brackets);

}  // namespace foretouch::internal
