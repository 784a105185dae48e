// tests/tools/report/view_transforms.cpp: where the library has each link of a played clip at
// random or given times, as lines of JSON: what a page that plays the clip is held to.
//   view_transforms --avatar A --motion M [--rate HZ] [--scale S] [--motion-up y|z] [--place ..]
//                   [--times N] [--seed S] | [--at FILE]
// The file has a time a line, in seconds of the clip.
// A line a time: {"time":seconds,"step":n,"u":0.25,"links":[[R row by row: 9, p: 3], ...]}.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "articulated/motion.h"
#include "assets/json_writer.h"
#include "tests/support/random_geometry.h"
#include "tools/inputs/clip_pose.h"
#include "tools/inputs/played_clip.h"
#include "tools/inputs/replay_inputs.h"

namespace foretouch::tools {
namespace {

struct Texts {
  std::string avatar, motion, motionUp = "y", place = "0,0,0,0";
  double scale = 1.0, rate = 0.0;  // a rate of 0: every frame
  int times = 100;
  std::uint64_t seed = 1;
  std::string timesFile;
};

/// A time of the clip, as the step that it lies in and how far into it.
struct Instant {
  double timeS = 0.0;
  std::int64_t step = 0;
  double u = 0.0;
};

Result<ReplayRequest> settled(const Texts& texts) {
  ReplayRequest request;
  request.avatarPath = texts.avatar;
  request.motionPath = texts.motion;
  auto place = placementFrom(texts.place);
  if (!place.ok()) return place.error();
  request.placement = std::move(place).value();
  request.placement.motionUpZ = texts.motionUp == "z";
  if (texts.motionUp == "z") request.motionUp = UpAxis::Z;
  if (texts.scale != 1.0) request.motionScale = texts.scale;
  if (texts.rate > 0.0) request.rateHz = texts.rate;
  return request;
}

std::string stateText(const LinkState& state) {
  std::string text = "[";
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) text += numberText(state.R_WL(row, column)) + ",";
  }
  return text + numberText(state.p_WL.x()) + "," + numberText(state.p_WL.y()) + "," +
         numberText(state.p_WL.z()) + "]";
}

double startOf(const StepSelection& steps, double frameTimeS, std::int64_t step) {
  return static_cast<double>(step * steps.stride) * frameTimeS;
}

Instant instantIn(const PlayedClip& played, std::int64_t step, double timeS) {
  const double t0S = startOf(played.steps, played.clip.frameTimeS, step);
  const double t1S = startOf(played.steps, played.clip.frameTimeS, step + 1);
  return {timeS, step, std::clamp((timeS - t0S) / (t1S - t0S), 0.0, 1.0)};
}

std::vector<Instant> randomInstants(const PlayedClip& played, int times, std::uint64_t seed) {
  std::vector<Instant> instants;
  test::Random random(seed);
  for (int i = 0; i < times; ++i) {
    const auto count = static_cast<double>(played.steps.count);
    const auto step =
        std::min(played.steps.count - 1, static_cast<std::int64_t>(random.uniform(0.0, count)));
    const double t0S = startOf(played.steps, played.clip.frameTimeS, step);
    const double t1S = startOf(played.steps, played.clip.frameTimeS, step + 1);
    instants.push_back(instantIn(played, step, t0S + random.uniform(0.0, 1.0) * (t1S - t0S)));
  }
  return instants;
}

/// At a pose the step that begins there, but for the last.
std::vector<Instant> givenInstants(const PlayedClip& played, const std::string& path) {
  std::vector<Instant> instants;
  std::ifstream file(path);
  for (double timeS = 0.0; file >> timeS;) {
    std::int64_t step = 0;
    while (step + 1 < played.steps.count &&
           startOf(played.steps, played.clip.frameTimeS, step + 1) <= timeS) {
      ++step;
    }
    instants.push_back(instantIn(played, step, timeS));
  }
  return instants;
}

Result<Done> write(const PlacedClip& placed, std::int64_t stride,
                   const std::vector<Instant>& instants) {
  for (const Instant& instant : instants) {
    const auto from = poseAtFrame(placed, instant.step * stride);
    const auto to = poseAtFrame(placed, (instant.step + 1) * stride);
    if (!from.ok()) return from.error();
    if (!to.ok()) return to.error();
    const ChainMotion motion(placed.avatar.skeleton(), from.value(), to.value());
    std::string line = fmt::format(R"({{"time":{},"step":{},"u":{},"links":[)",
                                   numberText(instant.timeS), instant.step, numberText(instant.u));
    for (LinkId link = 0; link < motion.numLinks(); ++link) {
      line += (link > 0 ? "," : "") + stateText(motion.stateAt(link, instant.u));
    }
    fmt::print("{}]}}\n", line);
  }
  return Done{};
}

Result<Done> write(const ReplayRequest& request, const Texts& texts) {
  const auto loaded = loadPlayedClip(request);
  if (!loaded.ok()) return loaded.error();
  const PlayedClip& played = loaded.value();
  const PlacedClip placed{played.avatar,     played.clip,      played.match,
                          request.placement, played.isUpright, request.motionPath};
  return write(placed, played.steps.stride,
               texts.timesFile.empty() ? randomInstants(played, texts.times, texts.seed)
                                       : givenInstants(played, texts.timesFile));
}

int run(int argc, const char* const* argv) {
  Texts texts;
  CLI::App app("Where the library has each link of a played clip at random times");
  app.add_option("--avatar", texts.avatar)->required();
  app.add_option("--motion", texts.motion)->required();
  app.add_option("--rate", texts.rate)->check(CLI::PositiveNumber);
  app.add_option("--scale", texts.scale)->check(CLI::PositiveNumber);
  app.add_option("--motion-up", texts.motionUp)->check(CLI::IsMember({"y", "z"}));
  app.add_option("--place", texts.place);
  app.add_option("--times", texts.times);
  app.add_option("--seed", texts.seed);
  app.add_option("--at", texts.timesFile)->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);
  const auto request = settled(texts);
  const auto done = request.ok() ? write(request.value(), texts) : Result<Done>(request.error());
  if (done.ok()) return 0;
  fmt::print(stderr, "view_transforms: {}\n", describe(done.error()));
  return 2;
}

}  // namespace
}  // namespace foretouch::tools

int main(int argc, char** argv) {
  return foretouch::tools::run(argc, argv);
}
