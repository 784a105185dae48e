#include "assets/import/model_import.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include "assets/import/model_stream.h"
#include "assets/import/run.h"
#include "assets/import/side_files.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::importError;

std::vector<std::string> argumentsFor(const std::string& path, const ModelImportOptions& options) {
  std::vector<std::string> arguments{"--model", path};
  if (options.urdfSurface == UrdfSurface::Visual) arguments.emplace_back("--visual");
  if (options.isRobot) arguments.emplace_back("--robot");
  if (options.needsMeshes) arguments.emplace_back("--meshes");
  for (const std::string& folder : options.packagePaths) {
    arguments.emplace_back("--package");
    arguments.push_back(folder);
  }
  return arguments;
}

/// Scales every length; frames and scales of nodes stay as they are.
void scaleLengths(Model& model, double scale) {
  for (ModelNode& node : model.nodes) {
    node.toParent.translation *= scale;
    for (Lss& lss : node.lss) lss = {lss.a * scale, lss.b * scale, lss.radius * scale};
    if (node.joint == ModelJointType::Prismatic) {
      node.lowerLimit *= scale;
      node.upperLimit *= scale;
    }
  }
  const auto inMetres = [&model](std::int32_t node) {
    return model.nodes[slotOf(node)].joint == ModelJointType::Prismatic;
  };
  for (ModelMimic& mimic : model.mimics) {
    if (inMetres(mimic.node)) mimic.offset *= scale;
    // Metres per radian, or radians per metre.
    if (inMetres(mimic.node) && !inMetres(mimic.leader)) mimic.factor *= scale;
    if (!inMetres(mimic.node) && inMetres(mimic.leader)) mimic.factor /= scale;
  }
  for (ModelMesh& mesh : model.meshes) {
    for (Vector3d& vertex : mesh.vertices) vertex *= scale;
    for (ModelBone& bone : mesh.bones) bone.meshToBone.translation *= scale;
  }
  for (ModelAnimation& animation : model.animations) {
    for (ModelTrack& track : animation.tracks) {
      for (auto& key : track.positions) key.value *= scale;
      for (auto& [in, out] : track.positionTangents) {
        in *= scale;
        out *= scale;
      }
    }
  }
}

/// FBX files of one rig may have another axis each, and what other programs turn then is what
/// stands directly in the scene. assimp's root above it, which nothing moves, is left alone for
/// that.
bool isBareRootOfFbx(const Model& model, const ModelNode& node) {
  const DeclaredFrame& declared = model.frame.declared;
  return declared.up && !declared.isOfFormat && node.parent < 0 && node.name == "RootNode" &&
         node.toParent.linear.isIdentity(0.0) && node.toParent.translation.isZero(0.0);
}

/// Per node: does a turn of the scene go into its frame?
std::vector<bool> topNodes(const Model& model) {
  std::vector<bool> isBare, isTop;
  for (const ModelNode& node : model.nodes) {
    isBare.push_back(isBareRootOfFbx(model, node));
    isTop.push_back(node.parent < 0 ? !isBare.back() : isBare[slotOf(node.parent)]);
  }
  return isTop;
}

/// At the top, and in the animations that move what is there.
void turnTop(Model& model, internal::FrameChange::Turn by) {
  if (by == internal::FrameChange::Turn::None) return;
  const double sign = by == internal::FrameChange::Turn::FromZUp ? 1.0 : -1.0;
  Affine turn;
  turn.linear << 1, 0, 0, 0, 0, sign, 0, -sign, 0;
  const double half = std::sqrt(0.5);
  const Quaternion rotation(half, -sign * half, 0, 0);
  const std::vector<bool> isTop = topNodes(model);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (isTop[i]) model.nodes[i].toParent = turn * model.nodes[i].toParent;
  }
  for (ModelAnimation& animation : model.animations) {
    for (ModelTrack& track : animation.tracks) {
      if (!isTop[slotOf(track.node)]) continue;
      for (auto& key : track.positions) key.value = turn * key.value;
      for (auto& key : track.rotations) key.value = rotation * key.value;
      for (auto& [in, out] : track.positionTangents) {
        in = turn * in;
        out = turn * out;
      }
      for (auto& [in, out] : track.rotationTangents) {
        in = (rotation * Quaternion(in)).coeffs();
        out = (rotation * Quaternion(out)).coeffs();
      }
    }
  }
}

bool holdsNothing(const Model& model) {
  return model.meshes.empty() && model.animations.empty() &&
         std::all_of(model.nodes.begin(), model.nodes.end(),
                     [](const ModelNode& node) { return node.lss.empty(); });
}

Result<Model> importChecked(const std::string& path, const ModelImportOptions& options) {
  for (const std::string& folder : options.packagePaths) {
    if (folder.find('\0') == std::string::npos) continue;
    return importError(path, ErrorCode::OutOfRange, "expected package paths without zero bytes");
  }
  internal::ModelReader reader;
  if (const auto error =
          internal::runImporter(path, options.import, argumentsFor(path, options),
                                internal::foldersBeside(path, options.packagePaths), reader)) {
    return *error;
  }
  Model model = reader.take();
  model.frame = reader.fileFrame();
  if (holdsNothing(model)) {
    return importError(path, ErrorCode::Empty,
                       "expected triangles, spheres, capsules or animations, found none" +
                           (model.notes.empty() ? "" : " (" + model.notes.front() + ")"));
  }
  if (const std::string weakness = importerWeakness(); !weakness.empty()) {
    model.notes.push_back(weakness);
  }
  const auto change = internal::settleFrame(options.import.scale, options.import.up, model.frame);
  if (change.scale != 1.0) scaleLengths(model, change.scale);
  turnTop(model, change.turn);
  return Result<Model>(std::move(model));
}

}  // namespace

Result<Model> importModel(const std::string& path, const ModelImportOptions& options) {
  try {
    return importChecked(path, options);
  } catch (const std::bad_alloc&) {
    return importError(path, ErrorCode::LimitExceeded, "not enough memory for the model");
  } catch (const std::system_error& error) {
    return importError(path, ErrorCode::ImportFailed, error.what());
  }
}

}  // namespace foretouch
