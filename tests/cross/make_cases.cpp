// make_cases ROOM.obj DATA FOLDER: every clip of DATA/mocap in two scenes, the room and
// DATA/scenes/undulating.obj, placed where it has contacts now and then: FOLDER/cases, and the
// avatars beside it. Ten and thirty steps a second.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

#include "assets/avatar/avatar_file.h"
#include "tests/cross/cases.h"
#include "tests/oracle/sweep_placement.h"

namespace foretouch::test {
namespace {

constexpr double kRatesHz[] = {10.0, 30.0}, kPi = 3.14159265358979323846;

SweepScene sceneOf(const std::string& path) {
  const ObjScene read = readObj(path);
  const auto vertex = [&](std::size_t corner) {
    const std::size_t at = 3 * std::size_t{read.indices[corner]};
    return Eigen::Vector3d(read.positions[at], read.positions[at + 1], read.positions[at + 2]);
  };
  RawScene raw;
  raw.objectNames = {"all"};
  for (std::size_t i = 0; i < read.indices.size(); i += 3) {
    raw.triangles.push_back({{vertex(i), vertex(i + 1), vertex(i + 2)}});
    raw.objectOf.push_back(0);
  }
  std::vector<oracle::Triangle> triangles = plain(raw.triangles);
  auto scene = Scene::build(std::move(raw));
  if (!scene) throw std::runtime_error(path + ": " + describe(scene.error()));
  return {std::filesystem::path(path).stem().string(), std::move(scene).value(),
          oracle::Scene(std::move(triangles))};
}

/// Frames from one step to the next; a clip has at least one step.
std::set<int> stridesOf(const Clip& clip) {
  std::set<int> strides;
  for (const double rate : kRatesHz) {
    strides.insert(std::min(strideFor(clip, rate), static_cast<int>(clip.frames.size()) - 1));
  }
  return strides;
}

/// The clip at its place in the scene; its avatar goes to a file.
CrossCase caseOf(const SweepClip& clip, const SweepScene& scene, const std::string& avatar) {
  const auto placements = choosePlacements(clip, scene, 1);
  if (placements.empty())
    throw std::runtime_error("no place for " + clip.name + " in " + scene.name);
  if (const auto written = writeAvatarFile(clip.avatar, avatar); !written) {
    throw std::runtime_error(describe(written.error()));
  }
  const Placement& place = placements.front();
  CrossCase asked;
  asked.avatar = avatar;
  asked.scale = clip.scale;
  asked.yawDeg = place.yaw * 180.0 / kPi;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    asked.origin[axis] = place.position[static_cast<Eigen::Index>(axis)];
  }
  return asked;
}

void make(const std::string& room, const std::string& data, const std::string& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream cases(folder + "/cases");
  std::size_t made = 0;
  for (const std::string& path : {room, data + "/scenes/undulating.obj"}) {
    const SweepScene scene = sceneOf(path);
    for (const std::string& clipPath : clipPaths(data)) {
      const auto clip = loadClip(clipPath);
      if (!clip) {
        std::fprintf(stderr, "make_cases: left out: %s\n", describe(clip.error()).c_str());
        continue;
      }
      CrossCase asked =
          caseOf(clip.value(), scene, folder + "/" + std::to_string(made++) + ".avatar.json");
      asked.scene = path;
      asked.clip = clipPath;
      for (const int stride : stridesOf(clip.value().clip)) {
        asked.stride = stride;
        cases << formatCase(asked) << '\n';
      }
    }
  }
  if (!cases.flush()) throw std::runtime_error(folder + "/cases: cannot be written");
  if (made == 0) throw std::runtime_error(data + "/mocap: expected clips, found none");
}

}  // namespace
}  // namespace foretouch::test

int main(int count, char** arguments) {
  if (count != 4) {
    std::fprintf(stderr, "make_cases ROOM.obj DATA FOLDER\n");
    return 2;
  }
  try {
    foretouch::test::make(arguments[1], arguments[2], arguments[3]);
  } catch (const std::exception& failed) {
    std::fprintf(stderr, "make_cases: %s\n", failed.what());
    return 1;
  }
  return 0;
}
