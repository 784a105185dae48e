// tools/inputs/smpl_motion.h: motions of SMPL and its kin, as AMASS has them, with the user's own
// body model, from which only what places the joints is read.
#pragma once

#include <optional>
#include <string>

#include "articulated/clip.h"
#include "articulated/result.h"

namespace foretouch::tools {

/// `motion`: 'poses' (frames, 3 times joints) as turns about axes, 'trans' (frames, 3), 'betas',
/// and 'mocap_framerate' or 'mocap_frame_rate' unless `rateHz` says it. `body`: 'J_regressor',
/// 'v_template', 'kintree_table', and 'shapedirs' where betas are not zero. Joints have SMPL's
/// names ("left_shoulder"), rest in its T-pose, in its own axes; the world is the motion's, which
/// for AMASS has z up. Errors name the file and the array.
[[nodiscard]] Result<Clip> clipFromSmpl(const std::string& motion, const std::string& body,
                                        std::optional<double> rateHz);

}  // namespace foretouch::tools
