// tools/inputs/clip_cut.h: which frames of a clip are played.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "articulated/clip.h"
#include "articulated/result.h"
#include "tools/settings/clip_settings.h"

namespace foretouch::tools {

/// Frames from `first` to `last`, both of them played.
struct FrameRange {
  std::int64_t first = 0, last = 0;
  std::int64_t tPose = 0;  ///< Frames before `first` that were left out as a T-pose.

  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(last - first + 1); }
};

/// What `request.cut` leaves of the clip; an instant between two frames becomes the nearest one, as
/// clips are recorded at frames. `isUpright`: as Motion::isUpright. Errors name the option: an
/// instant beyond the clip, an end that is not behind the begin, a clip that is nothing but a
/// T-pose.
[[nodiscard]] Result<FrameRange> framesOf(const ClipRequest& request, const Clip& clip,
                                          bool isUpright);

/// What became of the T-pose, if the request asks to leave it out.
[[nodiscard]] std::optional<std::string> remarkOnTPose(const ClipRequest& request,
                                                       const FrameRange& range, const Clip& clip);

}  // namespace foretouch::tools
