// assets/import/model_files.h: what assimp opens, and what it does not: the model, and regular
// files beside it that are parts of models (assets/import/side_files.h). Never a pipe or a device,
// which would hold up the import. In foretouch-import only. Not installed.
#pragma once

#include <string>

#include <assimp/DefaultIOSystem.h>

namespace foretouch::internal {

class ModelFiles : public Assimp::DefaultIOSystem {
 public:
  explicit ModelFiles(std::string model) : model_(std::move(model)) {}

  bool Exists(const char* path) const override;
  /// Counts the bytes of what it opens (assets/import/memory_budget.h).
  Assimp::IOStream* Open(const char* path, const char* mode) override;

 private:
  [[nodiscard]] bool isModel(const std::string& path) const;

  std::string model_;
};

}  // namespace foretouch::internal
