// assets/clip/webxr_session.h: sessions of WebXR as iwer's ActionRecorder writes them: where the
// head, the hands' joints and the controllers were. Not installed.
// Source: iwer 2.5, lib/action/ActionRecorder.js. A frame is [ms, head, inputs...], each place as
// x, y, z and a quaternion x, y, z, w, rounded to a thousandth; an input is [index, target ray,
// grip if its schema has one, hand if it has one: places of joints in the target ray, each with a
// radius].
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "articulated/clip.h"
#include "articulated/result.h"

namespace foretouch {

/// The most text, which is in memory as a whole; its frames become poses one by one. Enough for
/// three quarters of an hour of two hands at 72 Hz.
inline constexpr std::size_t kMaxSessionBytes = std::size_t{512} << 20;

/// Metres, +Y up, as WebXR has them. Joints: "viewer"; for an input with a hand WebXR's 25 ("left
/// index-finger-tip"), the wrist a root; for another one "left grip", or "left ray". Frames come
/// when the browser draws: the clip has as many at an even rate, or `rateHz`, on the straight way
/// between the two around each instant. An absent input is held at its last place, with a note.
/// Errors name `name`, and the frame.
[[nodiscard]] Result<Clip> parseWebXrSession(std::string_view text, const std::string& name,
                                             std::optional<double> rateHz = {});

}  // namespace foretouch
