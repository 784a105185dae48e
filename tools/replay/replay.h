// tools/replay/replay.h: a recorded clip, step by step, on several threads, answered in order.
#pragma once

#include <functional>

#include "articulated/result.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/replay/step_solver.h"

namespace foretouch::tools {

/// Takes the steps in order, in the thread that called replay(); false ends the replay early.
using StepSink = std::function<bool(const ReplayedStep&)>;

/// Answers every step on 1 to kMaxThreads threads. A step depends only on its number, so the
/// answers do not depend on the number of threads; answers wait in bounded memory. Errors: that of
/// the earliest step that has one (a pose beyond the legal coordinates), or of threads and memory.
[[nodiscard]] Result<Done> replay(const ReplayInputs& inputs, int threads, const StepSink& sink);

}  // namespace foretouch::tools
