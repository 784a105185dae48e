// assets/model/model_frames.h: the nodes of a model as affine frames, and their rigid part.
// Internal to model_avatar and model_clip.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "assets/model/model.h"

namespace foretouch::internal {

/// The rotation nearest to a matrix in the Frobenius norm (never a reflection).
[[nodiscard]] Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& m);

/// Every node's frame in the world. `toParent`: the nodes' frames in their parents'. Parents come
/// before children.
[[nodiscard]] std::vector<Affine> worldFrames(const Model& model,
                                              const std::vector<Affine>& toParent);

/// The nodes' rest frames, in their parents'.
[[nodiscard]] std::vector<Affine> restFrames(const Model& model);

}  // namespace foretouch::internal
