#include "assets/import/declared_frame.h"

#include <array>
#include <charconv>
#include <cmath>

namespace foretouch::internal {
namespace {

/// 0.01 of the float nearest to it: what the file's text was.
double asWritten(float number) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.begin(), text.end(), number).ptr;
  double written = static_cast<double>(number);
  std::from_chars(text.begin(), end, written);
  return written;
}

/// FBX states both in its global settings (or means centimetres and Y), and assimp applies neither.
void findFbxFrame(AssimpFile& file) {
  const aiMetadata* const settings = file.scene->mMetaData;
  if (settings == nullptr) return;
  float centimetres = 0.0F;
  if (settings->Get("UnitScaleFactor", centimetres) && std::isfinite(centimetres) &&
      centimetres > 0.0F) {
    file.metresPerUnit = static_cast<double>(centimetres) / 100.0;
    file.frame.metresPerUnit = asWritten(centimetres) / 100.0;
    file.frame.declared.metresPerUnit = file.frame.metresPerUnit;
  }
  int axis = -1, sign = 0;
  if (!settings->Get("UpAxis", axis) || !settings->Get("UpAxisSign", sign) || sign != 1) return;
  if (axis == 1) file.frame.declared.up = UpAxis::Y;
  if (axis == 2) file.frame.declared.up = UpAxis::Z;
}

/// Collada: assimp's root is the visual scene, which has no transform of its own, so that its
/// matrix is what assimp applied: the unit, then the turn of a Z-up file.
void findColladaFrame(AssimpFile& file) {
  const aiMatrix4x4& root = file.scene->mRootNode->mTransformation;
  const float unit = root.a1;
  if (!std::isfinite(unit) || !(unit > 0.0F)) return;
  const aiMatrix4x4 yUp(unit, 0, 0, 0, 0, unit, 0, 0, 0, 0, unit, 0, 0, 0, 0, 1);
  const aiMatrix4x4 zUp(unit, 0, 0, 0, 0, 0, unit, 0, 0, -unit, 0, 0, 0, 0, 0, 1);
  FileFrame& frame = file.frame;
  if (root == zUp) {
    frame.declared.up = frame.up = UpAxis::Z;
  } else if (root == yUp) {
    frame.declared.up = UpAxis::Y;
  } else {
    return;
  }
  frame.metresPerUnit = asWritten(unit);
  frame.declared.metresPerUnit = frame.metresPerUnit;
}

}  // namespace

void findFrame(std::string_view extensions, AssimpFile& file) {
  if (extensions == "fbx") findFbxFrame(file);
  if (extensions.find("dae") != std::string_view::npos) findColladaFrame(file);
  if (extensions.find("gltf") != std::string_view::npos) {
    file.frame.declared = {1.0, UpAxis::Y, true};
  }
}

}  // namespace foretouch::internal
