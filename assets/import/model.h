// assets/import/model.h: a model from assimp, glTF, a URDF or MJCF, and the counts that all keep
// while they build it. In foretouch-import only. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "assets/import/model_stream.h"
#include "assets/model/model.h"

namespace foretouch::internal {

/// The parent's request.
struct ModelQuestion {
  std::string path;
  bool visual = false;       ///< For a robot: its visual description, not its collision one.
  bool needsMeshes = false;  ///< ModelImportOptions::needsMeshes.
  bool isRobot = false;      ///< Refuse what ModelImportOptions::isRobot says.
  std::vector<std::string> packagePaths;
};

/// A model under construction, within the limits: count each part before you add it.
class ModelBuilder {
 public:
  /// Throws Failure (assets/import/failure.h) if the limits do not allow `more`.
  void count(const ModelSize& more);
  /// Add and count them. Throw Failure.
  void addLss(std::int32_t node, const Lss& lss);
  void addMesh(std::int32_t node, const std::string& name, std::vector<Eigen::Vector3d> vertices,
               const std::vector<std::array<std::int32_t, 3>>& triangles);
  /// Keeps the first few distinct notes; the last one says how many others there were.
  void note(const std::string& text);
  [[nodiscard]] Model take();

  Model model;

 private:
  ModelSize size_;
  std::uint64_t notesLeftOut_ = 0;
};

/// Metres: converts lengths from the file's unit. Throw Failure.
[[nodiscard]] Model readModel(const ModelQuestion& question);
[[nodiscard]] Model readGltf(const ModelQuestion& question);
[[nodiscard]] Model readUrdf(const ModelQuestion& question);
[[nodiscard]] Model readMvnx(const ModelQuestion& question);
/// Only where the program is built with libmujoco.
[[nodiscard]] Model readMjcf(const ModelQuestion& question);

}  // namespace foretouch::internal
