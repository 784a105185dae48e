// tools/sweep/sweep.h: the swept volume of an avatar's links over part of a clip, as surfaces.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/avatar/joint_match.h"
#include "assets/import/scene_import.h"
#include "tessellation/swept_surface.h"
#include "tools/inputs/step_selection.h"
#include "tools/settings/clip_settings.h"

namespace foretouch::tools {

/// The options of a sweep, each legal by itself.
struct SweepRequest : ClipRequest {
  std::vector<std::string> links;    ///< Names, or "all".
  std::optional<double> fromS, toS;  ///< Seconds in the clip; empty: its begin and end.
  SweptSurfaceOptions surface;       ///< maxTriangles: for all links together.
};

struct SweepInputs {
  SweepRequest request;
  Avatar avatar;
  Clip clip;
  JointMatch match;
  StepSelection steps;
  bool isUpright = false;
  std::vector<LinkId> links;  ///< In the avatar's order; each has an LSS.
  double fromS = 0.0, toS = 0.0;
};

/// Reads, checks and matches the inputs. Errors name the file or option.
[[nodiscard]] Result<SweepInputs> loadSweepInputs(const SweepRequest& request);

struct LinkSurface {
  LinkId link = 0;
  std::string name;
  std::vector<SweptSurface> parts;  ///< One per LSS, without those that vanish.
};

struct Sweep {
  std::vector<LinkSurface> links;
  double certifiedError = 0.0;
  /// Outer side: the largest distance from the true sweep of vertices and of points on triangles,
  /// spread over the surface. Not a bound, but for comparison with the bound.
  double sampledError = 0.0;
  std::size_t samples = 0;
  std::size_t pieces = 0, vertices = 0, triangles = 0;
  std::size_t vanished = 0;  ///< LSS too thin for an inner surface.
};

/// Calls `progress(done, total)` after each step; false stops, and the sweep is then unusable.
/// Time: O(pieces); one thread.
[[nodiscard]] Result<Sweep> sweepOf(
    const SweepInputs& inputs, const std::function<bool(std::int64_t, std::int64_t)>& progress);

}  // namespace foretouch::tools
