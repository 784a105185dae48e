#include "bench/solid/cast.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "articulated/try.h"
#include "tools/inputs/example_folder.h"

namespace foretouch::tools {
namespace {

struct StageFile {
  const char* name;
  const char* file;
  bool isUpZ;
};
/// Units are metres in all; the office says itself that z is up.
constexpr StageFile kStageFiles[] = {{"kitchen", "scenes/kitchen_fatihrmutfak.ply", true},
                                     {"office", "scenes/cpr_office.dae", false},
                                     {"collision-world", "scenes/collision-world.glb", false},
                                     {"undulating", "scenes/undulating.obj", false}};
constexpr const char* kClips[] = {"bandai1_kick_normal_001.bvh",
                                  "bandai1_punch_normal_001.bvh",
                                  "bandai1_dance-short_normal_001.bvh",
                                  "cmu_01_01_playground_jumps.bvh",
                                  "fair_dab.bvh",
                                  "cmu_jumping_jacks.bvh"};

bool isThere(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

Result<std::string> stagePath(const std::string& dataFolder, const std::string& name, bool& isUpZ) {
  isUpZ = false;
  if (name == "room") {
    FORETOUCH_TRY(const auto folder, exampleFolder());
    return folder + "/room.obj";
  }
  for (const StageFile& stage : kStageFiles) {
    if (name != stage.name) continue;
    isUpZ = stage.isUpZ;
    return dataFolder + "/" + stage.file;
  }
  return Error::in("--scenes", ErrorCode::UnknownName,
                   "expected kitchen, office, collision-world, undulating or room, found " + name);
}

/// Every BVH clip, sorted.
std::vector<std::string> everyClip(const std::string& folder) {
  std::vector<std::string> clips;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".bvh") clips.push_back(entry.path().string());
  }
  std::sort(clips.begin(), clips.end());
  return clips;
}

/// The clips by name, or paths.
std::vector<std::string> clipPaths(const std::string& folder,
                                   const std::vector<std::string>& names) {
  if (names == std::vector<std::string>{"all"}) return everyClip(folder);
  std::vector<std::string> paths;
  for (const std::string& name : names) paths.push_back(isThere(name) ? name : folder + "/" + name);
  if (!names.empty()) return paths;
  for (const char* const name : kClips) paths.push_back(folder + "/" + name);
  return paths;
}

}  // namespace

Result<Cast> loadCast(const std::string& dataFolder, std::vector<std::string> scenes,
                      const std::vector<std::string>& clips) {
  FORETOUCH_TRY(auto cast, loadActors(dataFolder, clips));
  if (scenes.empty()) scenes = {"kitchen", "office", "room"};
  for (const std::string& name : scenes) {
    bool isUpZ = false;
    FORETOUCH_TRY(const auto path, stagePath(dataFolder, name, isUpZ));
    if (!isThere(path)) {
      cast.leftOut.push_back(name);
      continue;
    }
    FORETOUCH_TRY(auto stage, loadStage(name, path, isUpZ));
    cast.stages.push_back(std::move(stage));
  }
  return cast;
}

Result<Cast> loadActors(const std::string& dataFolder, const std::vector<std::string>& clips) {
  Cast cast;
  for (const std::string& path : clipPaths(dataFolder + "/mocap", clips)) {
    auto actor = loadActor(path);
    if (!isThere(path) || (!actor.ok() && actor.error().code == ErrorCode::Empty)) {
      cast.leftOut.push_back(path);
      continue;
    }
    if (!actor.ok()) return actor.error();
    cast.actors.push_back(std::move(actor).value());
  }
  if (cast.actors.empty()) {
    FORETOUCH_TRY(const auto folder, exampleFolder());
    FORETOUCH_TRY(auto actor, loadActor(folder + "/dancer.bvh"));
    cast.actors.push_back(std::move(actor));
  }
  return cast;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace foretouch::tools
