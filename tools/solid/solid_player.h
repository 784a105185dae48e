// tools/solid/solid_player.h: a recorded clip played through a solid avatar, tick by tick.
#pragma once

#include <cstdint>
#include <functional>

#include "articulated/result.h"
#include "middleware/solid/solid_avatar.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/settings/solid_settings.h"

namespace foretouch::tools {

/// One tick as it was played.
struct PlayedTick {
  std::int64_t tick = 0;  ///< From 0: the pose after `tick` steps of the clip.
  double timeS = 0.0;     ///< The time of its pose since the clip's first frame.
  Pose tracked;
  SolidTick answer;
  double latencyUs = 0.0;

  /// Where the shown curve begins anew in this tick (SolidTick::hasAppeared); null: nowhere.
  [[nodiscard]] const Pose* start() const {
    return answer.hasAppeared && answer.numWay > 0 ? &answer.way.front() : nullptr;
  }
  /// The poses that motions lead to, one after the other.
  [[nodiscard]] std::size_t numPieces() const { return answer.numWay - firstPiece(); }
  [[nodiscard]] const Pose& piece(std::size_t i) const { return answer.way[firstPiece() + i]; }
  [[nodiscard]] double timeOfPiece(std::size_t i) const { return answer.times[firstPiece() + i]; }
  [[nodiscard]] bool isShownTracked() const;

 private:
  [[nodiscard]] std::size_t firstPiece() const { return start() == nullptr ? 0 : 1; }
};

/// Bit for bit: -0 and 0 differ.
[[nodiscard]] bool areSamePoses(const Pose& a, const Pose& b);

/// The request with what the inputs decide: pairs that are ignored, rules of own links, the work
/// that a tick may cost. `hasTolerance`: the tolerance of the inputs was asked for; else it follows
/// the skin.
[[nodiscard]] SolidOptions solidOptionsOf(const SolidRequest& request, const ReplayInputs& inputs,
                                          bool hasTolerance);

/// The same with what SolidAvatar::options() completes. Errors: those of playSolid().
[[nodiscard]] Result<SolidOptions> completedOptions(const ReplayInputs& inputs,
                                                    const SolidOptions& options);

/// Takes the ticks in order; false ends the playing early. The tick is the player's: valid until
/// the next.
using TickSink = std::function<bool(const PlayedTick&)>;

/// Ticks of a clip: one more than its steps.
[[nodiscard]] inline std::int64_t ticksOf(const ReplayInputs& inputs) {
  return inputs.steps.count + 1;
}
/// Seconds from one tick to the next.
[[nodiscard]] inline double tickS(const ReplayInputs& inputs) {
  return static_cast<double>(inputs.steps.stride) * inputs.clip.frameTimeS;
}

/// Plays every pose that the inputs select. Errors: options that a solid avatar refuses, by the
/// names of the command's options; poses beyond the legal coordinates; poses so far apart in time
/// that no tick is so long.
[[nodiscard]] Result<Done> playSolid(const ReplayInputs& inputs, const SolidOptions& options,
                                     const TickSink& sink);

}  // namespace foretouch::tools
