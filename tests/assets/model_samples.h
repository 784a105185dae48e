// tests/assets/model_samples.h: models made in memory, and the places of their parts, computed with
// 4x4 matrices from the leaf up: shares no code with the tested one.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "articulated/motion.h"
#include "assets/model/model.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

inline std::size_t at(std::int32_t index) {
  return static_cast<std::size_t>(index);
}

inline Matrix4d matrixOf(const Affine& frame) {
  Matrix4d m = Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = frame.linear;
  m.topRightCorner<3, 1>() = frame.translation;
  return m;
}

inline Vector3d transformed(const Matrix4d& m, const Vector3d& p) {
  return (m * p.homogeneous()).head<3>();
}

/// The node's frame in the world; `local`: the nodes' frames in their parents'.
inline Matrix4d worldOf(const Model& model, const std::vector<Matrix4d>& local, std::int32_t node) {
  Matrix4d m = Matrix4d::Identity();
  for (std::int32_t n = node; n >= 0; n = model.nodes[at(n)].parent) m = local[at(n)] * m;
  return m;
}

inline std::vector<Matrix4d> restMatrices(const Model& model) {
  std::vector<Matrix4d> local;
  for (const ModelNode& node : model.nodes) local.push_back(matrixOf(node.toParent));
  return local;
}

inline std::int32_t addNode(Model& model, const std::string& name, std::int32_t parent,
                            const Vector3d& offset = Vector3d::Zero(),
                            const Matrix3d& linear = Matrix3d::Identity()) {
  ModelNode node;
  node.name = name;
  node.parent = parent;
  node.toParent = {linear, offset};
  model.nodes.push_back(node);
  return static_cast<std::int32_t>(model.nodes.size()) - 1;
}

/// Triangles over consecutive triples of `vertices`.
inline ModelMesh& addMesh(Model& model, std::int32_t node, const std::vector<Vector3d>& vertices) {
  ModelMesh mesh;
  mesh.name = "mesh" + std::to_string(model.meshes.size());
  mesh.node = node;
  mesh.vertices = vertices;
  for (std::int32_t v = 0; at(v) + 2 < vertices.size(); v += 3) {
    mesh.triangles.push_back({v, v + 1, v + 2});
  }
  model.meshes.push_back(mesh);
  return model.meshes.back();
}

inline void addBone(ModelMesh& mesh, std::int32_t node,
                    const std::vector<ModelBone::Weight>& weights, const Affine& meshToBone = {}) {
  mesh.bones.push_back({node, "bone" + std::to_string(node), meshToBone, weights});
}

/// One triangle near the origin.
inline std::vector<Vector3d> oneTriangle() {
  return {{0, 0, 0}, {0.1, 0, 0}, {0, 0.2, 0}};
}

/// The skeleton's frames in a pose.
inline std::vector<LinkState> statesIn(const Skeleton& skeleton, const Pose& pose) {
  std::vector<LinkState> states;
  ChainMotion(skeleton, pose, pose).statesAt(0.0, states);
  return states;
}

/// The scale of a random model's nodes.
enum class RandomScale { None, Even, Mirrored, Uneven };

inline Vector3d randomScale(Random& random, RandomScale kind) {
  const double size = random.magnitude(0.1, 10.0);
  switch (kind) {
    case RandomScale::None: return Vector3d::Ones();
    case RandomScale::Even: return Vector3d::Constant(size);
    case RandomScale::Mirrored: return size * Vector3d(-1, 1, 1);
    case RandomScale::Uneven:
      return {size, random.magnitude(0.1, 10.0), random.magnitude(0.1, 10.0)};
  }
  return Vector3d::Ones();
}

}  // namespace foretouch::test
