// assets/import/model.h: a model as assimp or a URDF tells it, and what both keep count of
// while they build it. In foretouch-import only. Not installed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/import/model_stream.h"
#include "assets/model/model.h"

namespace foretouch::internal {

/// What the parent asks for beside the file.
struct ModelQuestion {
  std::string path;
  bool visual = false;  ///< Of a URDF: its visual description rather than its collision one.
  std::vector<std::string> packagePaths;
};

/// A model in the making that stays within the limits: each part is counted before it is added.
class ModelBuilder {
 public:
  /// Throws Failure (assets/import/assimp.h) where the limits do not allow `more`.
  void count(const ModelSize& more);
  /// Keeps the first few distinct notes; the last one says how many were left out.
  void note(const std::string& text);
  [[nodiscard]] Model take();

  Model model;

 private:
  ModelSize size_;
  std::uint64_t notesLeftOut_ = 0;
};

/// Metres, the file's unit applied to lengths. Throw Failure.
[[nodiscard]] Model readModel(const ModelQuestion& question);
[[nodiscard]] Model readUrdf(const ModelQuestion& question);

}  // namespace foretouch::internal
