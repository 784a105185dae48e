#include "tools/inputs/clip_cut.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "articulated/try.h"
#include "tools/inputs/t_pose.h"

namespace foretouch::tools {
namespace {

/// "3.2 s (frame 96)": where the clip ends.
std::string endOf(const Clip& clip) {
  const auto frames = static_cast<std::int64_t>(clip.frames.size()) - 1;
  return fmt::format("{:.6g} s (frame {})", clip.durationS(), frames / clip.framesPerRow);
}

Result<std::int64_t> frameAt(const char* option, const ClipInstant& instant, const Clip& clip) {
  const double frame = instant.isFrame ? instant.number * static_cast<double>(clip.framesPerRow)
                                       : std::round(instant.number / clip.frameTimeS);
  if (frame < static_cast<double>(clip.frames.size())) return static_cast<std::int64_t>(frame);
  return Error::in(option, ErrorCode::OutOfRange,
                   fmt::format("expected an instant of the clip, which ends at {}, found {:.6g}{}",
                               endOf(clip), instant.number, instant.isFrame ? "f" : " s"));
}

Result<Done> skipTPose(const Clip& clip, bool isZUp, FrameRange& range) {
  range.tPose = tPoseFramesOf(clip, isZUp);
  if (range.tPose >= static_cast<std::int64_t>(clip.frames.size())) {
    return Error::in("--skip-t-pose", ErrorCode::Empty,
                     fmt::format("all {} frames of the clip are a T-pose", clip.frames.size()));
  }
  range.first = std::max(range.first, range.tPose);
  return Done{};
}

}  // namespace

Result<FrameRange> framesOf(const ClipRequest& request, const Clip& clip, bool isUpright) {
  const ClipCut& cut = request.cut;
  FrameRange range{0, static_cast<std::int64_t>(clip.frames.size()) - 1, 0};
  if (cut.from) {
    FORETOUCH_TRY(range.first, frameAt("--from", *cut.from, clip));
  }
  if (cut.to) {
    FORETOUCH_TRY(range.last, frameAt("--to", *cut.to, clip));
  }
  if (cut.skipsTPose) {
    FORETOUCH_CHECK(skipTPose(clip, request.placement.motionUpZ && !isUpright, range));
  }
  if (range.first < range.last || (!cut.from && !cut.to && !cut.skipsTPose)) return range;
  return Error::in(cut.to ? "--to" : "--from", ErrorCode::OutOfRange,
                   fmt::format("expected at least two frames between begin and end, found frame {} "
                               "to frame {}",
                               range.first / clip.framesPerRow, range.last / clip.framesPerRow));
}

std::optional<std::string> remarkOnTPose(const ClipRequest& request, const FrameRange& range,
                                         const Clip& clip) {
  if (!request.cut.skipsTPose) return std::nullopt;
  const std::string what = request.motionPath + ": --skip-t-pose: ";
  if (range.tPose == 0) return what + "it begins with none, so nothing is left out";
  return what + fmt::format("left out a T-pose, the first {} ({:.4g} s)",
                            range.tPose == 1 ? "frame" : fmt::format("{} frames", range.tPose),
                            static_cast<double>(range.tPose) * clip.frameTimeS);
}

}  // namespace foretouch::tools
