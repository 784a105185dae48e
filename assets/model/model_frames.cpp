#include "assets/model/model_frames.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include "lss/index.h"

namespace foretouch::internal {

/// U V^T of the singular value decomposition; if that reflects, negates the direction of the
/// smallest singular value.
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  const Eigen::Matrix3d v = svd.matrixV();
  if ((u * v.transpose()).determinant() < 0.0) u.col(2) = -u.col(2);
  return u * v.transpose();
}

std::vector<Affine> worldFrames(const Model& model, const std::vector<Affine>& toParent) {
  std::vector<Affine> frames(model.nodes.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::int32_t parent = model.nodes[i].parent;
    frames[i] = parent < 0 ? toParent[i] : frames[slotOf(parent)] * toParent[i];
  }
  return frames;
}

std::vector<Affine> restFrames(const Model& model) {
  std::vector<Affine> frames;
  for (const ModelNode& node : model.nodes) frames.push_back(node.toParent);
  return frames;
}

}  // namespace foretouch::internal
