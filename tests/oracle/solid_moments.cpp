// tests/oracle/solid_moments.cpp: the ten ugliest moments of a file of shown poses
// (docs/formats.md), of any version: joints in turns in which nobody saw them, jerk, and links in
// each other, by the judge's kinematics. Of each a GLB, and what docs/pictures/moment_strips.py
// draws. Exit code 0: done; 2: bad use or bad input.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "bench/judged.h"
#include "judge/scene.h"
#include "tests/oracle/motion_audit.h"
#include "tools/glb/solid_glb.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/solid/shown_track.h"
#include "tools/solid/solid_reader.h"

namespace {

using namespace foretouch;
using nlohmann::json;
using test::MotionAudit;
using test::UglyTick;

constexpr std::size_t kMoments = 10, kMeasures = 3;
/// Moments of one measure are so far apart (s); so much is written around each.
constexpr double kApartS = 0.5, kAroundS = 0.5;
/// Less of any measure is rounding.
constexpr double kLeast = 1e-6;
/// Of the scene, triangles so near to the middle of the body are drawn (m).
constexpr double kNearM = 1.0;

struct Recorded {
  tools::ReplayInputs inputs;
  std::string header;
  std::vector<tools::PlayedTick> ticks;
};

struct Moment {
  std::size_t tick = 0, measure = 0;
  UglyTick::Worst worst;
};

Result<Recorded> read(const std::string& path, const std::string& scenePath,
                      const std::string& avatarPath) {
  FORETOUCH_TRY(auto reader, tools::SolidReader::open(path));
  tools::ReplayRequest request;
  request.scenePath = scenePath;
  request.avatarPath = avatarPath;
  request.sceneImport.scale = reader.header().sceneScale;
  request.sceneImport.up = reader.header().sceneUp;
  FORETOUCH_TRY(auto scene, tools::loadScene(request));
  FORETOUCH_TRY(auto avatar, readAvatarFile(avatarPath));
  Clip clip{avatar.skeleton(), 0.0, {}, {}, {}, {}, {}};
  Recorded recorded{
      {request, std::move(scene), std::move(avatar), std::move(clip), {}, {}, {}}, {}, {}};
  std::getline(std::ifstream(path), recorded.header);
  Pose shown;
  for (;;) {
    FORETOUCH_TRY(auto record, reader.next());
    if (!record) break;
    tools::PlayedTick tick;
    tick.tick = record->tick;
    tick.timeS = record->timeS;
    SolidTick& answer = tick.answer;
    answer.state = record->state;
    answer.isCertified = record->isCertified;
    answer.deviation = record->deviation;
    answer.lift = record->lift;
    answer.hasAppeared = record->start.has_value();
    if (record->start) answer.way.push_back(*record->start);
    if (record->start) answer.times.push_back(0.0);
    answer.way.insert(answer.way.end(), record->way.begin(), record->way.end());
    answer.times.insert(answer.times.end(), record->times.begin(), record->times.end());
    answer.numWay = answer.way.size();
    if (!answer.way.empty()) shown = answer.way.back();
    if (answer.state == SolidState::Placing && record->tracked) shown = *record->tracked;
    tick.tracked = record->tracked.value_or(shown);
    answer.shown = shown;
    recorded.ticks.push_back(std::move(tick));
  }
  if (recorded.ticks.size() < 2) {
    return Error::in(path, ErrorCode::Empty, "expected two ticks or more");
  }
  recorded.inputs.clip.frameTimeS = recorded.ticks[1].timeS - recorded.ticks[0].timeS;
  return recorded;
}

/// The worst of each measure in turn.
std::vector<Moment> ugliest(const Recorded& recorded, MotionAudit& audit) {
  std::array<std::vector<Moment>, kMeasures> all;
  const double dtS = recorded.inputs.clip.frameTimeS;
  audit.begin("recorded");
  for (std::size_t i = 0; i < recorded.ticks.size(); ++i) {
    audit.look(recorded.ticks[i].tracked, recorded.ticks[i].answer, dtS);
    const UglyTick& ugly = audit.ugly();
    const std::array<UglyTick::Worst, kMeasures> worst{ugly.unseen, ugly.jerk, ugly.ownDepth};
    for (std::size_t m = 0; m < kMeasures; ++m) {
      if (worst[m].value > kLeast) all[m].push_back({i, m, worst[m]});
    }
  }
  for (auto& moments : all) {
    std::stable_sort(moments.begin(), moments.end(), [](const Moment& a, const Moment& b) {
      return a.worst.value > b.worst.value;
    });
  }
  std::vector<Moment> chosen;
  const auto isApart = [&](const Moment& one) {
    return std::none_of(chosen.begin(), chosen.end(), [&](const Moment& other) {
      const double apart = recorded.ticks[one.tick].timeS - recorded.ticks[other.tick].timeS;
      return std::abs(apart) < kApartS;
    });
  };
  for (std::size_t turn = 0; chosen.size() < kMoments && turn < kMeasures * kMoments; ++turn) {
    const auto& moments = all[turn % kMeasures];
    const auto next = std::find_if(moments.begin(), moments.end(), isApart);
    if (next != moments.end()) chosen.push_back(*next);
  }
  return chosen;
}

json numbers(const oracle::Vec3d& p) {
  return json::array({p.x, p.y, p.z});
}

json axesOf(MotionAudit& audit, const Pose& pose) {
  const MotionAudit::Body body = audit.placed(pose);
  json axes = json::array();
  for (std::size_t i = 0; i < body.axes.size(); ++i) {
    axes.push_back(
        {numbers(body.axes[i][0]), numbers(body.axes[i][1]), audit.radii()[i], audit.nameOf(i)});
  }
  return axes;
}

json nearTriangles(const oracle::Scene& scene, const oracle::Vec3d& middle) {
  oracle::Box box;
  box.add(middle);
  json found = json::array();
  double within = kNearM;
  scene.visitNear(box, within, [&](int id) {
    const oracle::Triangle& triangle = scene.triangle(id);
    found.push_back({numbers(triangle[0]), numbers(triangle[1]), numbers(triangle[2])});
  });
  return found;
}

/// What is drawn of a moment.
json drawn(const Recorded& recorded, const Moment& moment, const oracle::Scene& scene,
           MotionAudit& audit, std::size_t first, std::size_t end) {
  constexpr std::array<const char*, kMeasures> kNames = {"turned as never seen", "jerk",
                                                         "in itself"};
  constexpr std::array<double, kMeasures> kScales = {180.0 / 3.14159265358979, 1.0, 1e3};
  constexpr std::array<const char*, kMeasures> kUnits = {"degrees", "m/s3", "mm"};
  const tools::PlayedTick& tick = recorded.ticks[moment.tick];
  json told{
      {"tick", tick.tick},
      {"time", tick.timeS},
      {"state", toString(tick.answer.state)},
      {"measure", kNames[moment.measure]},
      {"value", kScales[moment.measure] * moment.worst.value},
      {"unit", kUnits[moment.measure]},
      {"link", recorded.inputs.avatar.skeleton().name(static_cast<LinkId>(moment.worst.link))},
      {"frames", json::array()}};
  for (std::size_t i = first; i < end; ++i) {
    const tools::PlayedTick& one = recorded.ticks[i];
    told["frames"].push_back({{"tick", one.tick},
                              {"time", one.timeS},
                              {"shown", axesOf(audit, one.answer.shown)},
                              {"tracked", axesOf(audit, one.tracked)}});
  }
  const auto body = audit.placed(tick.answer.shown);
  told["triangles"] = nearTriangles(scene, body.axes.front()[0]);
  return told;
}

Result<Done> write(const Recorded& recorded, const std::string& folder) {
  std::vector<oracle::Triangle> triangles;
  const Scene& scene = recorded.inputs.scene;
  for (std::size_t i = 0; i < scene.numTriangles(); ++i) {
    triangles.push_back(tools::plain(scene.triangle(static_cast<TriangleId>(i))));
  }
  const oracle::Scene judged(std::move(triangles));
  MotionAudit audit(judged, recorded.inputs.avatar, {});
  const std::vector<Moment> moments = ugliest(recorded, audit);
  const auto around = static_cast<std::size_t>(kAroundS / recorded.inputs.clip.frameTimeS);
  json all = json::array();
  for (const Moment& moment : moments) {
    const std::size_t first = moment.tick - std::min(around, moment.tick),
                      end = std::min(recorded.ticks.size(), moment.tick + around + 1);
    tools::ShownTrack track(recorded.inputs);
    for (std::size_t i = first; i < end; ++i) track.add(recorded.ticks[i]);
    track.finish();
    tools::GlbRequest glb;
    glb.path = fmt::format("{}/{:02}.glb", folder, all.size());
    FORETOUCH_CHECK(tools::writeSolidGlb(recorded.inputs, track, recorded.header, glb));
    all.push_back(drawn(recorded, moment, judged, audit, first, end));
    const json& told = all.back();
    std::cout << fmt::format("{}: tick {} at {:.3f} s, {}: {}, {:.3g} {}\n", glb.path,
                             told["tick"].get<int>(), told["time"].get<double>(),
                             told["link"].get<std::string>(), told["measure"].get<std::string>(),
                             told["value"].get<double>(), told["unit"].get<std::string>());
  }
  std::ofstream(folder + "/moments.json") << all;
  std::cout << audit.tally().table();
  return Done{};
}

}  // namespace

int main(int argc, char** argv) {
  std::string path, scene, avatar, folder;
  CLI::App app{"The ten ugliest moments of a file of shown poses"};
  app.add_option("FILE", path, "Of foretouch replay --solid")->required();
  app.add_option("--scene", scene, "That it was made with")->required();
  app.add_option("--avatar", avatar, "That it was made with")->required();
  app.add_option("--output", folder, "A folder")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  const auto recorded = read(path, scene, avatar);
  const auto done = recorded.ok() ? write(recorded.value(), folder) : recorded.error();
  if (!done.ok()) std::cerr << describe(done.error()) << "\n";
  return done.ok() ? 0 : 2;
}
