#include "assets/import/declared_frame.h"

#include <array>
#include <charconv>
#include <cmath>

namespace foretouch::internal {
namespace {

/// What the file's text was: for the float nearest to 0.01, it returns 0.01.
double asWritten(float number) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.begin(), text.end(), number).ptr;
  double written = static_cast<double>(number);
  std::from_chars(text.begin(), end, written);
  return written;
}

/// FBX states both in its global settings (or means centimetres and Y), and assimp applies neither.
ReadFrame fbxFrame(const aiScene& scene) {
  ReadFrame read;
  const aiMetadata* const settings = scene.mMetaData;
  if (settings == nullptr) return read;
  float centimetres = 0.0F;
  if (settings->Get("UnitScaleFactor", centimetres) && std::isfinite(centimetres) &&
      centimetres > 0.0F) {
    read.metresPerUnit = static_cast<double>(centimetres) / 100.0;
    read.frame.metresPerUnit = asWritten(centimetres) / 100.0;
    read.frame.declared.metresPerUnit = read.frame.metresPerUnit;
  }
  int axis = -1, sign = 0;
  if (!settings->Get("UpAxis", axis) || !settings->Get("UpAxisSign", sign) || sign != 1) {
    return read;
  }
  if (axis == 1) read.frame.declared.up = UpAxis::Y;
  if (axis == 2) read.frame.declared.up = UpAxis::Z;
  return read;
}

/// Collada: assimp's root is the visual scene, which has no transform of its own, so that its
/// matrix is what assimp applied: the unit, then the turn of a Z-up file.
ReadFrame colladaFrame(const aiScene& scene) {
  ReadFrame read;
  const aiMatrix4x4& root = scene.mRootNode->mTransformation;
  const float unit = root.a1;
  if (!std::isfinite(unit) || !(unit > 0.0F)) return read;
  const aiMatrix4x4 yUp(unit, 0, 0, 0, 0, unit, 0, 0, 0, 0, unit, 0, 0, 0, 0, 1);
  const aiMatrix4x4 zUp(unit, 0, 0, 0, 0, 0, unit, 0, 0, -unit, 0, 0, 0, 0, 0, 1);
  FileFrame& frame = read.frame;
  if (root == zUp) {
    frame.declared.up = frame.up = UpAxis::Z;
  } else if (root == yUp) {
    frame.declared.up = UpAxis::Y;
  } else {
    return read;
  }
  frame.metresPerUnit = asWritten(unit);
  frame.declared.metresPerUnit = frame.metresPerUnit;
  return read;
}

}  // namespace

ReadFrame frameOf(const aiScene& scene, std::string_view extensions) {
  if (extensions == "fbx") return fbxFrame(scene);
  if (extensions.find("dae") != std::string_view::npos) return colladaFrame(scene);
  return {};
}

}  // namespace foretouch::internal
