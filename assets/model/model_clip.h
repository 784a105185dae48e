// assets/model/model_clip.h: a model's animation, or a robot's joint positions, as a clip.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "articulated/clip.h"
#include "articulated/result.h"
#include "assets/model/model.h"

namespace foretouch {

struct ModelClipOptions {
  std::string animation;  ///< By name; empty: the first. Also its number, counted from 0.
  double rateHz = 30.0;   ///< Samples of the animation per second.
};

/// The animation sampled at a fixed rate, on a skeleton with the joints that avatarFromModel()
/// makes of the same model (names, order, frames), so that it drives that avatar directly. Error if
/// the model has no animation of that name.
[[nodiscard]] Result<Clip> clipFromModel(const Model& model, const ModelClipOptions& options = {});

/// Joint positions as a clip of the robot `model` (a URDF's). CSV text: a header `time` (seconds)
/// and joint names, then one row per instant, equally spaced; radians or metres. From each row to
/// the next the robot moves as EdgeQuery moves it: where a joint turns too far for the shorter arc,
/// poses are put in between (Clip::framesPerRow). Joints that the table does not name stay at zero,
/// or follow the one that they mimic; notes positions outside a joint's limits. Errors name `name`
/// as the file. Safe on hostile text.
[[nodiscard]] Result<Clip> clipFromJointPositions(const Model& model, std::string_view csv,
                                                  const std::string& name);

/// Poses at `samples` configurations of the robot `model`, drawn within its limits
/// (Robot::sampledPoses()), as a clip whose frames have no order. All its joints are named.
[[nodiscard]] Result<Clip> clipFromSampledJoints(const Model& model, std::int32_t samples,
                                                 std::uint64_t seed);

}  // namespace foretouch
