#include "tools/inputs/step_selection.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "articulated/robot.h"
#include "lss/assert.h"

namespace foretouch::tools {

double rateTaken(const StepSelection& steps, double frameTimeS) {
  return 1.0 / (frameTimeS * static_cast<double>(steps.stride));
}

std::int64_t mostStride(const Clip& clip) {
  if (!(clip.mostTurn > 0.0)) return kAnyStride;
  const double frames = std::floor(Robot::kMostTurn / clip.mostTurn);
  if (frames >= static_cast<double>(clip.frames.size())) return kAnyStride;
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(frames));
}

std::optional<std::string> remarkOnRate(const StepSelection& steps, const Clip& clip,
                                        std::optional<double> rateHz) {
  return remarkOnRate(steps, clip.frameTimeS, rateHz, mostStride(clip));
}

std::optional<std::string> remarkOnRate(const StepSelection& steps, double frameTimeS,
                                        std::optional<double> rateHz, std::int64_t mostStride) {
  if (!rateHz) return std::nullopt;
  const double taken = rateTaken(steps, frameTimeS);
  const double share = taken / *rateHz - 1.0;
  if (std::abs(share) <= kRateSlack) return std::nullopt;
  const bool isMore = share > 0.0;
  const std::string frames =
      steps.stride == 1 ? "every frame" : fmt::format("one frame in {}", steps.stride);
  std::string text = fmt::format(
      "--rate {:.6g}: takes {} of a clip of {:.6g} a second: {:.5g} poses a second, {:.3g} % {} "
      "than asked",
      *rateHz, frames, 1.0 / frameTimeS, taken, 100.0 * std::abs(share), isMore ? "more" : "fewer");
  if (!isMore) return text;
  if (steps.stride == mostStride) {
    return text + "; with fewer, a joint would turn by half a turn or more between two poses";
  }
  const StepSelection fewer{steps.stride + 1, 1};
  return text +
         fmt::format("; --rate {:.5g} would be at most as many", rateTaken(fewer, frameTimeS));
}

Result<StepSelection> selectSteps(const Clip& clip, std::optional<double> rateHz) {
  return selectSteps(clip.frames.size(), clip.frameTimeS, rateHz, mostStride(clip));
}

Result<StepSelection> selectSteps(std::size_t frames, double frameTimeS,
                                  std::optional<double> rateHz, std::int64_t mostStride) {
  FORETOUCH_ASSERT(frameTimeS > 0.0 && (!rateHz || *rateHz > 0.0));
  if (frames < 2) {
    return Error::of(ErrorCode::Empty,
                     fmt::format("expected at least 2 frames to move between, found {}", frames));
  }
  const double clipRateHz = 1.0 / frameTimeS;
  if (rateHz && *rateHz > clipRateHz * (1.0 + kRateSlack)) {
    return Error::of(
        ErrorCode::OutOfRange,
        fmt::format("expected a --rate of at most the clip's own {:.6g} Hz, found {:.6g}",
                    clipRateHz, *rateHz));
  }
  const auto intervals = static_cast<std::int64_t>(frames) - 1;
  // Compared as doubles before the cast: a tiny rate's stride does not fit an integer.
  const double wanted = rateHz ? std::round(1.0 / (*rateHz * frameTimeS)) : 1.0;
  if (wanted > static_cast<double>(intervals)) {
    return Error::of(
        ErrorCode::OutOfRange,
        fmt::format("lasts {:.6g} s, less than one step of {:.6g} s at --rate {:.6g}",
                    static_cast<double>(intervals) * frameTimeS, wanted * frameTimeS, *rateHz));
  }
  StepSelection steps;
  steps.stride = std::clamp<std::int64_t>(static_cast<std::int64_t>(wanted), 1, mostStride);
  steps.count = intervals / steps.stride;
  return steps;
}

}  // namespace foretouch::tools
