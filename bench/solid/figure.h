// bench/solid/figure.h: a figure of thirteen links, a hand alone, and scenes of sheets: what the
// trials of solid avatars, and their tests, are made of. Metres.
#pragma once

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "lss/lss.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// Ticks per second of all trials that name no rate.
inline constexpr double kTrialRateHz = 90.0;

/// Stands at the origin on y = 0 and stretches its arms along x.
[[nodiscard]] Avatar figure();

/// The LSS of a hand, along x about its own origin.
[[nodiscard]] Lss handLss();
/// One link, "Hand", of handLss().
[[nodiscard]] Avatar handAlone();

/// A parallelogram in 2 n^2 triangles.
void addSheet(RawScene& raw, const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
              const Eigen::Vector3d& v, int n = 1);
/// A box of six sheets.
void addBox(RawScene& raw, const Eigen::Vector3d& low, const Eigen::Vector3d& high);
/// A wall across z = `z`, in front of the figure.
[[nodiscard]] RawScene wallAt(double z, int n = 1);

}  // namespace foretouch::tools
