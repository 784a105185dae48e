// tests/oracle/sweep_inputs.cpp: loading, scaling, placing and converting.
#include "tests/oracle/sweep_inputs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "assets/bvh/bvh_reader.h"
#include "assets/import/model_import.h"
#include "assets/import/scene_import.h"
#include "assets/model/model_avatar.h"

namespace foretouch::test {
namespace {

/// The largest side of the rest skeleton's box, in file units: arm span or height, alike for
/// people.
double restExtent(const Clip& clip) {
  const Skeleton& skeleton = clip.skeleton;
  const Pose rest = restPose(skeleton);
  std::vector<LinkState> states;
  ChainMotion(skeleton, rest, rest).statesAt(0.0, states);
  Eigen::Vector3d low = states.front().p_WL, high = low;
  for (std::size_t j = 0; j < states.size(); ++j) {
    std::vector<Eigen::Vector3d> points{states[j].p_WL};
    for (const auto& site : clip.endSites[j]) points.push_back(states[j].pointAt(site));
    for (const auto& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  return (high - low).maxCoeff();
}

void findStand(SweepClip& clip) {
  const auto& frames = clip.clip.frames;
  std::vector<LinkState> states;
  const auto statesOf = [&](const Pose& pose) {
    ChainMotion(clip.clip.skeleton, pose, pose).statesAt(0.0, states);
  };
  clip.lowest = std::numeric_limits<double>::infinity();
  for (const Pose& pose : frames) {
    statesOf(pose);
    for (const LinkState& s : states) clip.lowest = std::min(clip.lowest, s.p_WL.y());
  }
  statesOf(frames[frames.size() / 2]);
  clip.standsAt.setZero();
  for (const LinkState& s : states) {
    clip.standsAt += s.p_WL / static_cast<double>(states.size());
  }
}

std::vector<std::vector<oracle::Capsule>> capsulesOf(const Avatar& avatar) {
  std::vector<std::vector<oracle::Capsule>> capsules(static_cast<std::size_t>(avatar.numLinks()));
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    capsules[static_cast<std::size_t>(link)] = plainCapsules(avatar, link);
  }
  return capsules;
}

/// Per link.
std::vector<std::vector<oracle::SkinTriangle>> skinsOf(
    const Skin& skin, const std::vector<std::size_t>& trianglesOfLink) {
  std::vector<std::vector<oracle::SkinTriangle>> skins(trianglesOfLink.size());
  std::size_t next = 0;
  for (std::size_t link = 0; link < skins.size(); ++link) {
    for (std::size_t i = 0; i < trianglesOfLink[link]; ++i, ++next) {
      oracle::SkinTriangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t vertex = skin.triangles[next][k];
        for (const SkinInfluence& share : skin.vertices[static_cast<std::size_t>(vertex)]) {
          triangle[k].push_back({share.link, share.weight, plain(share.p_L)});
        }
      }
      skins[link].push_back(triangle);
    }
  }
  return skins;
}

struct KnownScene {
  const char* name;
  const char* file;
  std::optional<UpAxis> up;
};
// Units are metres in all four. The office says Z_UP itself, and is turned by that.
constexpr KnownScene kScenes[] = {
    {"kitchen", "scenes/kitchen_fatihrmutfak.ply", UpAxis::Z},
    {"office", "scenes/cpr_office.dae", std::nullopt},
    {"collision-world", "scenes/collision-world.glb", UpAxis::Y},
    {"undulating", "scenes/undulating.obj", UpAxis::Y},
};

}  // namespace

int strideFor(const Clip& clip, double rateHz) {
  return std::max(1, static_cast<int>(std::lround(1.0 / (rateHz * clip.frameTimeS))));
}

/// A model's avatar, mesh and first animation, in metres of `scale` a unit.
Result<SweepClip> loadModel(const std::string& path, double scale) {
  ModelImportOptions options;
  options.import.scale = scale;
  const auto model = importModel(path, options);
  if (!model) return model.error();
  auto clip = clipFromModel(model.value());
  if (!clip) return clip.error();
  auto made = avatarFromModel(model.value());
  if (!made) return made.error();
  auto capsules = capsulesOf(made.value().avatar);
  SweepClip result{std::filesystem::path(path).filename().string(),
                   scale,
                   std::move(clip).value(),
                   std::move(made.value().avatar),
                   std::move(capsules),
                   std::nullopt,
                   {},
                   std::nullopt,
                   {},
                   Eigen::Vector3d::Zero(),
                   0.0};
  std::vector<std::size_t> trianglesOfLink;
  for (const auto& triangles : made.value().surface) {
    trianglesOfLink.push_back(triangles.size());
    result.meshes.push_back(plain(triangles));
  }
  result.skins = skinsOf(made.value().skin, trianglesOfLink);
  auto skin = SkinnedSurface::build(result.avatar, std::move(made.value().skin), trianglesOfLink);
  if (!skin) return skin.error();
  result.skin = std::move(skin).value();
  auto surface = AvatarSurface::build(result.avatar, std::move(made.value().surface));
  if (!surface) return surface.error();
  result.surface = std::move(surface).value();
  findStand(result);
  return result;
}

Result<SweepClip> loadClip(const std::string& path) {
  constexpr double kPersonM = 1.7;
  if (std::filesystem::path(path).extension() != ".bvh") {
    const auto unscaledModel = loadModel(path, 1.0);
    if (!unscaledModel) return unscaledModel.error();
    return loadModel(path, kPersonM / restExtent(unscaledModel.value().clip));
  }
  auto unscaled = readBvhFile(path);
  if (!unscaled) return unscaled.error();
  const double extent = restExtent(unscaled.value());
  if (unscaled.value().frames.size() < 2 || !(extent > 0.0)) {
    return Error::in(path, ErrorCode::Empty, "fewer than two frames, or no extent");
  }
  BvhOptions options;
  options.scale = kPersonM / extent;
  auto clip = readBvhFile(path, options);
  if (!clip) return clip.error();
  auto avatar = avatarFromClip(clip.value());
  if (!avatar) return avatar.error();
  auto capsules = capsulesOf(avatar.value());
  SweepClip result{std::filesystem::path(path).filename().string(),
                   options.scale,
                   std::move(clip).value(),
                   std::move(avatar).value(),
                   std::move(capsules),
                   std::nullopt,
                   {},
                   std::nullopt,
                   {},
                   Eigen::Vector3d::Zero(),
                   0.0};
  findStand(result);
  return result;
}

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const KnownScene& known : kScenes) names.emplace_back(known.name);
  return names;
}

SweepScene emptySurroundings() {
  using Eigen::Vector3d;
  RawScene raw;
  raw.objectNames = {"far"};
  // Not farther than it must: the product's places are relative to the scene's middle, and round by
  // their distance from it.
  raw.triangles.push_back({{Vector3d(90, 90, 90), Vector3d(91, 90, 90), Vector3d(90, 91, 90)}});
  raw.objectOf = {0};
  std::vector<oracle::Triangle> triangles = plain(raw.triangles);
  return {"nothing", std::move(Scene::build(std::move(raw))).value(),
          oracle::Scene(std::move(triangles))};
}

Result<SweepScene> loadScene(const std::string& name, const std::string& dataFolder) {
  const auto* known = std::find_if(std::begin(kScenes), std::end(kScenes),
                                   [&](const KnownScene& k) { return name == k.name; });
  if (known == std::end(kScenes)) {
    return Error::in(name, ErrorCode::UnknownName, "not a scene of the sweep");
  }
  SceneImportOptions options;
  options.up = known->up;
  auto imported = importScene(dataFolder + "/" + known->file, options);
  if (!imported) return imported.error();
  std::vector<oracle::Triangle> triangles = plain(imported.value().scene.triangles);
  auto scene = Scene::build(std::move(imported.value().scene));
  if (!scene) return scene.error();
  if (scene.value().audit().droppedNonFinite > 0) {
    return Error::in(name, ErrorCode::NonFinite, "the oracle needs finite triangles");
  }
  return SweepScene{name, std::move(scene).value(), oracle::Scene(std::move(triangles))};
}

std::vector<std::string> clipPaths(const std::string& dataFolder) {
  std::vector<std::string> paths;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(dataFolder + "/mocap", ignored)) {
    if (entry.path().extension() == ".bvh") paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

Pose placed(const Skeleton& skeleton, const Pose& pose, const Placement& placement) {
  const Quaternion turn(std::cos(0.5 * placement.yaw), 0.0, std::sin(0.5 * placement.yaw), 0.0);
  Pose moved = pose;
  for (JointId j = 0; j < skeleton.numJoints(); ++j) {
    if (skeleton.parent(j) != kNoParent) continue;
    const auto i = static_cast<std::size_t>(j);
    moved.rotations[i] = turn * pose.rotations[i];
    moved.translations[i] = placement.position + turn * pose.translations[i];
  }
  // Renormalises what the turn rounded. The poses were valid and stay so.
  return std::move(validatedPose(skeleton, std::move(moved))).value();
}

}  // namespace foretouch::test
