// tools/inputs/step_selection.h: which frames of a clip are the poses of a replay.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "articulated/clip.h"
#include "articulated/result.h"

namespace foretouch::tools {

/// Step n goes from frameOf(n) to frameOf(n + 1).
struct StepSelection {
  std::int64_t stride = 1;
  std::int64_t count = 0;  ///< Steps, at least 1.
  std::int64_t first = 0;  ///< The frame that step 0 begins at.

  [[nodiscard]] std::int64_t frameOf(std::int64_t step) const { return first + step * stride; }
};

/// A rate may exceed the clip's own by this share: people say 30 for 29.97, and a frame time
/// printed with few digits is off by about as much. Beyond it, we would have to invent poses.
inline constexpr double kRateSlack = 0.01;

/// The poses per second that the steps take, for a clip with this frame time.
[[nodiscard]] double rateTaken(const StepSelection& steps, double frameTimeS);

/// The most frames from one pose to the next: as many as keep every joint's turn by its coordinate
/// within Robot::kMostTurn, as the shorter arc would be another way. For poses, which know no
/// coordinates, any number.
[[nodiscard]] std::int64_t mostStride(const Clip& clip);
inline constexpr std::int64_t kAnyStride = std::numeric_limits<std::int64_t>::max();

/// The rate that a request gets where no whole number of frames gives it, and how many more
/// or fewer poses these are. Nothing for a rate that it gets, within kRateSlack.
[[nodiscard]] std::optional<std::string> remarkOnRate(const StepSelection& steps, double frameTimeS,
                                                      std::optional<double> rateHz,
                                                      std::int64_t mostStride);
[[nodiscard]] std::optional<std::string> remarkOnRate(const StepSelection& steps, const Clip& clip,
                                                      std::optional<double> rateHz);

/// stride = max(1, round(1 / (rate * frame time))), at most `mostStride`; without a rate, every
/// frame. Errors: a rate above the clip's own, and a clip without a whole step. Preconditions:
/// frameTimeS and *rateHz are finite and greater than 0 (asserted).
[[nodiscard]] Result<StepSelection> selectSteps(std::size_t frames, double frameTimeS,
                                                std::optional<double> rateHz,
                                                std::int64_t mostStride);
[[nodiscard]] Result<StepSelection> selectSteps(const Clip& clip, std::optional<double> rateHz);

}  // namespace foretouch::tools
