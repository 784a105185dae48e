#include "bench/world/people.h"

#include <cmath>

#include <fmt/format.h>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

constexpr double kMostSeconds = 8.0;
/// With these, neighbours neither face the same way nor move together.
constexpr double kGoldenTurnDeg = 137.508;
constexpr std::size_t kPhaseStep = 37;

}  // namespace

std::string namesOf(const Cast& cast) {
  std::string names;
  for (const SolidActor& actor : cast.actors) {
    names += fmt::format("{}{} ({} links)", names.empty() ? "" : ", ", actor.name,
                         actor.avatar.numLinks());
  }
  return names;
}

std::vector<ClipPoses> clipPosesOf(const Cast& cast, double rateHz) {
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
