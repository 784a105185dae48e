// bench/peers/foretouch_solvers.h: Foretouch on rigid sweeps, through its public query alone.
#pragma once

#include "articulated/result.h"
#include "bench/peers/sweep_solver.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// The tolerances (m) at which Foretouch is asked.
inline constexpr double kForetouchTolerances[] = {1e-3, 1e-4, 1e-6};

/// One solver a tolerance. A sweep is a step of a skeleton of one joint at the pivot; its
/// ChainMotion is built anew for every query, as on a live stream. An undecided verdict counts as
/// contact at the end of what is proven free.
[[nodiscard]] Result<SweepSolvers> foretouchSolvers(const Scene& scene, const Lss& lss_L);

}  // namespace foretouch::tools
