#include "bench/solid/stage.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "articulated/try.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/import/scene_import.h"
#include "bench/judged.h"
#include "lss/index.h"
#include "middleware/solid/solid_options.h"
#include "tools/inputs/motion_file.h"

namespace foretouch::tools {
namespace {

/// The largest side of the rest skeleton's box, in the clip's units.
double restExtent(const Clip& clip) {
  const Pose rest = restPose(clip.skeleton);
  std::vector<LinkState> states;
  ChainMotion(clip.skeleton, rest, rest).statesAt(0.0, states);
  Eigen::Vector3d low = states.front().p_WL, high = low;
  for (std::size_t j = 0; j < states.size(); ++j) {
    std::vector<Eigen::Vector3d> points{states[j].p_WL};
    for (const Eigen::Vector3d& site : clip.endSites[j]) points.push_back(states[j].pointAt(site));
    for (const Eigen::Vector3d& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  return (high - low).maxCoeff();
}

double lowestOf(const SolidActor& actor) {
  constexpr double kLookEveryS = 0.1;
  const Skeleton& skeleton = actor.avatar.skeleton();
  const auto stride =
      static_cast<std::size_t>(std::max(1.0, std::floor(kLookEveryS / actor.clip.frameTimeS)));
  double lowest = std::numeric_limits<double>::infinity();
  std::vector<LinkState> states;
  for (std::size_t frame = 0; frame < actor.clip.frames.size(); frame += stride) {
    const Pose& pose = actor.clip.frames[frame];
    ChainMotion(skeleton, pose, pose).statesAt(0.0, states);
    for (LinkId link = 0; link < actor.avatar.numLinks(); ++link) {
      for (const Lss& lss : actor.avatar.lss(link)) {
        for (const Eigen::Vector3d& end : {lss.a, lss.b}) {
          lowest = std::min(lowest, states[slotOf(link)].pointAt(end).y() - lss.radius);
        }
      }
    }
  }
  return lowest;
}

bool says(std::string name, const char* word) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name.find(word) != std::string::npos;
}

}  // namespace

SolidStage stageOf(std::string name, RawScene raw) {
  std::vector<Triangle> finite;
  for (const Triangle& triangle : raw.triangles) {
    if (isFinite(triangle)) finite.push_back(triangle);
  }
  return {std::move(name), std::move(Scene::build(std::move(raw))).value(),
          oracle::Scene(plain(finite))};
}

Result<SolidStage> loadStage(const std::string& name, const std::string& path, bool isUpZ) {
  SceneImportOptions options;
  if (isUpZ) options.up = UpAxis::Z;
  FORETOUCH_TRY(auto imported, importScene(path, options));
  RawScene copy = imported.scene;
  FORETOUCH_CHECK(inFile(Scene::build(std::move(copy)), path));
  return stageOf(name, std::move(imported.scene));
}

Result<SolidActor> loadActor(const std::string& path) {
  MotionRequest request;
  request.path = path;
  request.scale = 1.0;
  FORETOUCH_TRY(const auto unscaled, readMotion(request));
  const double extent = restExtent(unscaled.clip);
  if (unscaled.clip.frames.size() < 2 || !(extent > 0.0)) {
    return Error::in(path, ErrorCode::Empty, "expected two frames or more of a body with extent");
  }
  request.scale = kActorHeight / extent;
  FORETOUCH_TRY(auto motion, readMotion(request));
  FORETOUCH_TRY(auto avatar, inFile(avatarFromClip(motion.clip), path));
  SolidActor actor{std::filesystem::path(path).filename().string(), std::move(avatar),
                   std::move(motion.clip), 0.0};
  actor.lowestM = lowestOf(actor);
  return actor;
}

std::vector<Pose> trackedPoses(const SolidActor& actor, const Placement& place, double rateHz,
                               double fromS, double seconds) {
  const Skeleton& skeleton = actor.avatar.skeleton();
  const std::vector<Pose>& frames = actor.clip.frames;
  std::vector<Pose> poses;
  ChainMotion motion;
  Pose pose;
  for (int i = 0; i <= static_cast<int>(std::lround(seconds * rateHz)); ++i) {
    const double at = (fromS + i / rateHz) / actor.clip.frameTimeS;
    const auto frame = static_cast<std::size_t>(std::max(0.0, at));
    if (frame + 1 >= frames.size()) break;
    motion.assign(skeleton, frames[frame], frames[frame + 1]);
    motion.poseAt(at - static_cast<double>(frame), pose);
    auto valid = validatedPose(skeleton, placed(skeleton, pose, place));
    if (!valid.ok()) break;
    poses.push_back(std::move(valid).value());
  }
  return poses;
}

SolidLinks solidLinks(const Avatar& avatar) {
  SolidLinks links;
  const std::vector<double> visibility = visibilityByName(avatar);
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const double one = visibility[slotOf(link)];
    links.hands.push_back(one > 1.0 && one < 10.0);
    links.trunk.push_back(one >= 10.0);
    links.heads.push_back(says(avatar.skeleton().name(link), "head"));
  }
  return links;
}

}  // namespace foretouch::tools
