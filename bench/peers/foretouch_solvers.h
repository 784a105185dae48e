// bench/peers/foretouch_solvers.h: Foretouch on rigid sweeps, only through its public query.
#pragma once

#include "articulated/result.h"
#include "bench/peers/sweep_solver.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// The tolerances (m) of Foretouch's solvers.
inline constexpr double kForetouchTolerances[] = {1e-3, 1e-4, 1e-6};

/// One solver per tolerance. A sweep is a step of a skeleton of one joint at the pivot; it rebuilds
/// its ChainMotion for every query, as on a live stream. An undecided verdict counts as contact at
/// its freeUntil.
[[nodiscard]] Result<SweepSolvers> foretouchSolvers(const Scene& scene, const Lss& lss_L);

}  // namespace foretouch::tools
