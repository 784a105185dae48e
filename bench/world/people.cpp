#include "bench/world/people.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "articulated/try.h"
#include "lss/index.h"
#include "tools/inputs/example_folder.h"

namespace foretouch::tools {
namespace {

constexpr const char* kCrowdClips[] = {"bandai1_kick_normal_001.bvh",
                                       "bandai1_punch_normal_001.bvh",
                                       "bandai1_dance-short_normal_001.bvh",
                                       "cmu_01_01_playground_jumps.bvh",
                                       "fair_dab.bvh",
                                       "cmu_jumping_jacks.bvh"};
constexpr double kMostSeconds = 8.0;
/// So that neighbours neither face the same way nor move together.
constexpr double kGoldenTurnDeg = 137.508;
constexpr std::size_t kPhaseStep = 37;

bool isFile(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

}  // namespace

std::string namesOf(const WorldCast& cast) {
  std::string names;
  for (const SolidActor& actor : cast.actors) {
    names += fmt::format("{}{} ({} links)", names.empty() ? "" : ", ", actor.name,
                         actor.avatar.numLinks());
  }
  return names;
}

Result<WorldCast> loadWorldCast(const std::string& dataFolder,
                                const std::vector<std::string>& clips) {
  WorldCast cast;
  std::vector<std::string> names = clips;
  if (names.empty()) names.assign(std::begin(kCrowdClips), std::end(kCrowdClips));
  for (const std::string& name : names) {
    const std::string path = isFile(name) ? name : dataFolder + "/mocap/" + name;
    if (!isFile(path)) {
      cast.leftOut.push_back(name);
      continue;
    }
    FORETOUCH_TRY(auto actor, loadActor(path));
    cast.actors.push_back(std::move(actor));
  }
  if (!cast.actors.empty()) return cast;
  FORETOUCH_TRY(const auto folder, exampleFolder());
  FORETOUCH_TRY(auto actor, loadActor(folder + "/dancer.bvh"));
  cast.actors.push_back(std::move(actor));
  return cast;
}

std::vector<ClipPoses> clipPosesOf(const WorldCast& cast, double rateHz) {
  std::vector<ClipPoses> all;
  for (const SolidActor& actor : cast.actors) {
    ClipPoses clip{&actor, std::llround(1e6 / rateHz),
                   trackedPoses(actor, {}, rateHz, 0.0, kMostSeconds)};
    if (clip.poses.size() < 2) continue;
    // They begin where they are put.
    const Eigen::Vector3d begin = clip.poses.front().translations[0];
    for (Pose& pose : clip.poses) {
      pose.translations[0] -= Eigen::Vector3d(begin.x(), actor.lowestM, begin.z());
    }
    all.push_back(std::move(clip));
  }
  return all;
}

Pose Person::pose(std::int64_t k) const {
  const std::size_t last = clip->poses.size() - 1;
  const std::size_t at = (phase + static_cast<std::size_t>(k)) % (2 * last);
  return placed(clip->actor->avatar.skeleton(), clip->poses[at <= last ? at : 2 * last - at],
                place);
}

std::vector<Person> crowdOf(const std::vector<ClipPoses>& clips, int count, double spacing) {
  std::vector<Person> people;
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    Person person;
    person.clip = &clips[n % clips.size()];
    person.place.origin = spacing * Eigen::Vector3d(i % side, 0.0, i / side);
    person.place.yawDeg = std::fmod(kGoldenTurnDeg * i, 360.0);
    person.phase = kPhaseStep * n % (2 * person.clip->poses.size() - 2);
    people.push_back(person);
  }
  return people;
}

}  // namespace foretouch::tools
