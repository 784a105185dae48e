// tools/replay/replay.h: a recorded clip, step by step, on several threads, answered in order.
#pragma once

#include <functional>

#include "articulated/result.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/replay/step_solver.h"

namespace foretouch::tools {

struct ReplayOptions {
  int threads = 1;            ///< 1 to kMaxThreads.
  bool compareRigid = false;  ///< Also answers each step with the rigid model.
  bool compareLink = false;   ///< Also answers each step at link fidelity.
  bool rays = false;          ///< Also times one set of rays per step.
};

/// Takes the steps in order, in the thread that called replay(); false ends the replay early.
using StepSink = std::function<bool(const ReplayedStep&)>;

/// Answers every step. A step depends only on its number, so the answers do not depend on the
/// number of threads; answers wait in bounded memory. Errors: that of the earliest step that has
/// one (a pose beyond the legal coordinates), or of threads and memory.
[[nodiscard]] Result<Done> replay(const ReplayInputs& inputs, const ReplayOptions& options,
                                  const StepSink& sink);

}  // namespace foretouch::tools
