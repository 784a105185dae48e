#include "tools/inputs/skin_file.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/import/model_import.h"
#include "assets/model/model_avatar.h"
#include "assets/text_file.h"
#include "tools/console.h"

namespace foretouch::tools {
namespace {

/// Metres, and the sine of half an angle: far above rounding, far below another body.
constexpr double kSameFrame = 1e-3;

std::optional<std::string> difference(const Skeleton& avatar, const Skeleton& model) {
  if (avatar.numJoints() != model.numJoints()) {
    return "expected the avatar's " + std::to_string(avatar.numJoints()) + " links, found " +
           std::to_string(model.numJoints());
  }
  for (JointId j = 0; j < avatar.numJoints(); ++j) {
    const std::string link = "link " + std::to_string(j) + " " + inQuotes(avatar.name(j));
    if (avatar.name(j) != model.name(j) || avatar.parent(j) != model.parent(j)) {
      return "expected the avatar's " + link + ", found " + inQuotes(model.name(j)) +
             " or another parent";
    }
    const double offset = (avatar.restOffset(j) - model.restOffset(j)).norm();
    const double turn = 1.0 - std::abs(avatar.restRotation(j).dot(model.restRotation(j)));
    if (offset > kSameFrame || turn > kSameFrame * kSameFrame) {
      return "its " + link +
             " rests elsewhere than the avatar's; are --skin-scale and --skin-up right?";
    }
  }
  return std::nullopt;
}

}  // namespace

Result<SkinnedSurface> loadSkin(const std::string& path, const SceneImportOptions& import,
                                const Avatar& avatar) {
  if (path.empty()) {
    return Error::in("--skin", ErrorCode::Empty,
                     "expected the model whose skin is the surface, which skinned fidelity needs");
  }
  ModelImportOptions options;
  options.import = import;
  FORETOUCH_TRY(const auto model, importModel(path, options));
  FORETOUCH_TRY(auto made, inFile(avatarFromModel(model), path));
  ModelAvatar& body = made;
  if (const auto problem = difference(avatar.skeleton(), body.avatar.skeleton())) {
    return Error::in(path, ErrorCode::Mismatch, *problem);
  }
  std::vector<std::size_t> trianglesOfLink;
  for (const auto& triangles : body.surface) trianglesOfLink.push_back(triangles.size());
  auto skin = SkinnedSurface::build(avatar, std::move(body.skin), trianglesOfLink);
  if (!skin.ok()) return inFile(skin.error(), path);
  return skin;
}

}  // namespace foretouch::tools
