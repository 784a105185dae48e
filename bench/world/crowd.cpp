#include "bench/world/crowd.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "bench/machine.h"
#include "bench/solid/cells.h"
#include "bench/world/timed_world.h"
#include "lss/index.h"
#include "middleware/world/box_sweep.h"

namespace foretouch::tools {
namespace {

constexpr double kCrowdRateHz = 30.0;
constexpr std::int64_t kCrowdWindowUs = 33'333;

/// More windows of small crowds, so that each row takes about as long.
CrowdWindows windowsFor(int count) {
  CrowdWindows windows;
  windows.counted = std::clamp(20'000 / count, 20, 400);
  return windows;
}

/// The box around all LSS of a person at both of a window's poses.
internal::BodyBox boxOf(const Person& person, std::int64_t k) {
  constexpr float kSwell = 0.02F;  // for what lies between them
  const Avatar& avatar = person.clip->actor->avatar;
  internal::BodyBox box;
  for (const std::int64_t at : {k, k + 1}) {
    const Pose pose = person.pose(at);
    std::vector<LinkState> states;
    ChainMotion(avatar.skeleton(), pose, pose).statesAt(0.0, states);
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      for (const Lss& lss : avatar.lss(link)) {
        for (const Eigen::Vector3d& end : {lss.a, lss.b}) {
          const Eigen::Vector3f p = states[slotOf(link)].pointAt(end).cast<float>();
          const float r = static_cast<float>(lss.radius) + kSwell;
          internal::BodyBox one;
          for (int axis = 0; axis < 3; ++axis) {
            one.lower[axis] = p[axis] - r;
            one.upper[axis] = p[axis] + r;
          }
          box.add(one);
        }
      }
    }
  }
  return box;
}

/// Mean microseconds of the sweep over the boxes of all, from window to window.
double broadPhaseUs(const std::vector<Person>& people) {
  constexpr std::int64_t kSweeps = 12, kFirst = 2;
  internal::BoxSweep sweep;
  std::vector<internal::MeetingBodies> meeting;
  std::vector<internal::BodyBox> boxes(people.size());
  double sum = 0.0;
  for (std::int64_t k = 0; k < kSweeps; ++k) {
    for (std::size_t i = 0; i < people.size(); ++i) boxes[i] = boxOf(people[i], k);
    const ThreadStopwatch watch;
    sweep.collect(boxes, meeting);
    if (k >= kFirst) sum += watch.us();
  }
  return sum / static_cast<double>(kSweeps - kFirst);
}

WindowFigures crowdFigures(const std::vector<Person>& people, const CrowdWindows& windows,
                           bool asksSelf) {
  TimedWorld world;
  for (const Person& person : people) static_cast<void>(world.add(person, asksSelf));
  runCrowd(people, windows, world);
  return std::move(world.figures);
}

double meanOf(const std::vector<double>& us) {
  return percentilesOf(us).mean;
}

/// What stands or moves under people.
struct PlatformPose {
  Quaternion rotation = Quaternion::Identity();
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

/// Turns 57 degrees per second, drives and rises.
PlatformPose platformAt(std::int64_t utimeUs) {
  const double s = 1e-6 * static_cast<double>(utimeUs);
  return {Quaternion(Eigen::AngleAxisd(s, Eigen::Vector3d::UnitY())),
          s * Eigen::Vector3d(1.0, 0.3, 0.5)};
}

Pose carriedBy(const PlatformPose& platform, Pose pose) {
  pose.rotations[0] = (platform.rotation * pose.rotations[0]).normalized();
  pose.translations[0] = platform.place + platform.rotation * pose.translations[0];
  return pose;
}

enum class PlatformCase { Still, Told, Untold };

WindowFigures platformFigures(const std::vector<Person>& people, const Scene& square,
                              PlatformCase which) {
  CrowdWindows windows;
  windows.counted = 300;
  TimedWorld world;
  for (const Person& person : people) static_cast<void>(world.add(person, false));
  BodyOptions apart;
  apart.group = 1;
  const BodyId platform = world.world().add(square, apart).value();
  static_cast<void>(world.world().ask(0, 1, false));  // they stand on it
  const bool isMoving = which != PlatformCase::Still;
  for (std::int64_t k = 0; k < windows.warm + windows.counted; ++k) {
    const std::int64_t us = kCrowdWindowUs * k;
    const PlatformPose at = isMoving ? platformAt(us) : PlatformPose();
    world.push(platform, us, Pose{{at.rotation}, {at.place}});
    for (std::size_t i = 0; i < people.size(); ++i) {
      const auto body = static_cast<BodyId>(i);
      const Pose pose = people[i].pose(k);
      if (which == PlatformCase::Told && k == 0) {
        static_cast<void>(world.world().attach(body, {platform, 0, true}, us, pose).value());
      } else {
        world.push(body, us, which == PlatformCase::Untold ? carriedBy(at, pose) : pose);
      }
    }
    if (k > 0) world.ask(us - kCrowdWindowUs, us, k > windows.warm);
  }
  return std::move(world.figures);
}

Scene squareOf(double side) {
  const double h = 0.5 * side;
  const Eigen::Vector3d a(-h, 0, -h), b(h, 0, -h), c(h, 0, h), d(-h, 0, h);
  RawScene raw;
  raw.objectNames = {"platform"};
  raw.triangles = {{{a, b, c}}, {{a, c, d}}};
  raw.objectOf = {0, 0};
  return Scene::build(std::move(raw)).value();
}

}  // namespace

BenchTable crowdTable(const Cast& cast, const std::vector<int>& counts) {
  BenchTable table{"crowd",
                   "Crowds at 30 Hz, one person per 2.25 m2, own links and each other; per window, "
                   "one thread",
                   {{"avatars", "avatars", 0},
                    {"answer_us", "answer us", 1},
                    {"answer_p99_us", "p99", 1},
                    {"avatar_us", "us per avatar", 2},
                    {"push_us", "push us per avatar", 2},
                    {"broad_us", "broad phase us", 2},
                    {"all_pairs", "pairs of avatars", 0},
                    {"pairs", "whose boxes meet", 1},
                    {"near_pairs", "near", 1},
                    {"contacts", "contacts", 2},
                    {"starts", "go on", 2},
                    {"touching_us", "us per pair that touches", 2},
                    {"spans", "spans", 1},
                    {"advancements", "advancements", 0}},
                   {}};
  const auto clips = clipPosesOf(cast, kCrowdRateHz);
  for (const int count : counts) {
    const auto people = crowdOf(clips, count, kCrowdSpacing);
    const WindowFigures figures = crowdFigures(people, windowsFor(count), true);
    const Percentiles us = percentilesOf(figures.answerUs);
    table.rows.push_back(
        {std::int64_t{count}, us.mean, us.p99, us.mean / count, meanOf(figures.pushUs) / count,
         broadPhaseUs(people), std::int64_t{count} * (count - 1) / 2,
         figures.perWindow(figures.sum.pairs), figures.perWindow(figures.sum.nearPairs),
         figures.perWindow(figures.contacts), figures.perWindow(figures.starts),
         us.mean / std::max(1e-9, figures.perWindow(figures.contacts + figures.starts)),
         figures.perWindow(figures.sum.spans),
         figures.perWindow(figures.sum.queries.advancements)});
  }
  return table;
}

BenchTable clocksTable(const Cast& cast) {
  BenchTable table{"clocks",
                   "The same crowd by one clock, and by clocks of their own; per window of 33 ms",
                   {{"avatars", "avatars", 0},
                    {"same_us", "one clock us", 1},
                    {"different_us", "own clocks us", 1},
                    {"ratio", "ratio", 3},
                    {"same_spans", "spans, one clock", 1},
                    {"different_spans", "own clocks", 1}},
                   {}};
  const auto clips = clipPosesOf(cast, kCrowdRateHz);
  for (const int count : {2, 30, 300}) {
    auto people = crowdOf(clips, count, kCrowdSpacing);
    const WindowFigures same = crowdFigures(people, windowsFor(count), true);
    // Spread over the period, in no order.
    for (std::size_t i = 0; i < people.size(); ++i) {
      people[i].offsetUs = static_cast<std::int64_t>(12'347 * i % 33'333);
    }
    const WindowFigures different = crowdFigures(people, windowsFor(count), true);
    const double one = meanOf(same.answerUs), other = meanOf(different.answerUs);
    table.rows.push_back({std::int64_t{count}, one, other, other / one,
                          same.perWindow(same.sum.spans),
                          different.perWindow(different.sum.spans)});
  }
  return table;
}

BenchTable platformTable(const Cast& cast) {
  BenchTable table{"platform",
                   "Thirty people on a platform that turns 57 degrees per second and drives; per "
                   "window, beside one that stands still",
                   {{"platform", "platform"},
                    {"answer_us", "answer us", 1},
                    {"ratio", "ratio", 3},
                    {"contacts", "contacts", 2},
                    {"starts", "go on", 2},
                    {"near_pairs", "near pairs", 1},
                    {"advancements", "advancements", 0}},
                   {}};
  constexpr int kRiders = 30;
  constexpr double kRidersSpacing = 0.8;
  const auto clips = clipPosesOf(cast, kCrowdRateHz);
  const auto people = crowdOf(clips, kRiders, kRidersSpacing);
  const Scene square = squareOf(20.0);
  double still = 0.0;
  for (const auto& [name, which] :
       {std::pair{"still", PlatformCase::Still}, std::pair{"moves, told", PlatformCase::Told},
        std::pair{"moves, untold", PlatformCase::Untold}}) {
    const WindowFigures figures = platformFigures(people, square, which);
    const double us = meanOf(figures.answerUs);
    if (which == PlatformCase::Still) still = us;
    table.rows.push_back({std::string(name), us, us / still, figures.perWindow(figures.contacts),
                          figures.perWindow(figures.starts),
                          figures.perWindow(figures.sum.nearPairs),
                          figures.perWindow(figures.sum.queries.advancements)});
  }
  return table;
}

BenchTable selfTable(const Cast& cast) {
  BenchTable table{"self",
                   "One person alone, with and without own links; per window, mean of all clips",
                   {{"rate_hz", "Hz", 0},
                    {"without_us", "without us", 2},
                    {"with_us", "with us", 2},
                    {"own_us", "own links us", 2},
                    {"contacts", "contacts", 2},
                    {"starts", "go on", 2}},
                   {}};
  for (const double rateHz : {5.0, 10.0, 30.0}) {
    const auto clips = clipPosesOf(cast, rateHz);
    CrowdWindows windows;
    windows.windowUs = std::llround(1e6 / rateHz);
    windows.counted = 300;
    double without = 0.0, with = 0.0, contacts = 0.0, starts = 0.0;
    for (const ClipPoses& clip : clips) {
      Person person;
      person.clip = &clip;
      without += meanOf(crowdFigures({person}, windows, false).answerUs);
      const WindowFigures own = crowdFigures({person}, windows, true);
      with += meanOf(own.answerUs);
      contacts += own.perWindow(own.contacts);
      starts += own.perWindow(own.starts);
    }
    const auto n = static_cast<double>(std::max<std::size_t>(clips.size(), 1));
    table.rows.push_back(
        {rateHz, without / n, with / n, (with - without) / n, contacts / n, starts / n});
  }
  return table;
}

}  // namespace foretouch::tools
