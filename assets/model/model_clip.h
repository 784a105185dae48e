// assets/model/model_clip.h: a model's animation, or a robot's joint positions, as a clip.
#pragma once

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
/// and joint names, then one row per instant, equally spaced; radians or metres. Joints that the
/// table does not name stay at zero; notes positions outside a joint's limits. Errors name `name`
/// as the file. Safe on hostile text.
[[nodiscard]] Result<Clip> clipFromJointPositions(const Model& model, std::string_view csv,
                                                  const std::string& name);

}  // namespace foretouch
