// tools/glb/solid_glb.h: shown poses as one animated GLB: the scene, the shown avatar, the tracked
// one as a ghost, and what holds the one from the other (docs/formats.md, "A replay as GLB").
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "tools/glb/replay_glb.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/solid/shown_track.h"

namespace foretouch::tools {

/// `track`: finished, with at least two ticks; `header`: the first line of its file. Returns what
/// it leaves out, one sentence each. Errors: those of ReplayGlb::write().
[[nodiscard]] Result<std::vector<std::string>> writeSolidGlb(const ReplayInputs& inputs,
                                                             const ShownTrack& track,
                                                             const std::string& header,
                                                             const GlbRequest& request);

}  // namespace foretouch::tools
