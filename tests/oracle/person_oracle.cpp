// tests/oracle/person_oracle.cpp: what a person touched between two poses, of whom the poses
// between are held back, against brackets with the bounds that hold on that clip: nothing is
// missed, nothing is a lie. Exit code 0: every promise kept; 1: one broken; 2: bad use or nothing
// to do.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/person/person_trial.h"
#include "bench/solid/busy_places.h"
#include "tests/oracle/sweep_inputs.h"
#include "tests/support/shared_data.h"

namespace {

using namespace foretouch;
using tools::PersonTally;
using tools::PersonTrial;

struct Arguments {
  std::vector<std::string> scenes{"kitchen", "office", "collision-world"}, clips,
      models{"constant-rate", "cubic", "cubic-late"};
  std::vector<double> rates{60, 30, 15, 10, 5};
  std::string data;
  double seconds = 4.0, boundShare = 1.0;
  int places = 1, instants = 4;
  std::uint64_t seed = 1;
  bool isConstant = false;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

std::string summary(const PersonTally& t) {
  return fmt::format(
      "{} intervals, {} looks, {} missed, {} lied; undecided {:.3f} %, touched {}, fresh {} "
      "(poses miss {}), certain {:.1f} %, width p50 {:.3f} ms p90 {:.3f}; growth mm p50 {:.2f} max "
      "{:.2f}; {:.2f} pieces, {:.0f} looks, {:.2f} us per step, {:.2f} times plain",
      t.intervals, t.looked, t.missed, t.lied, percent(t.possible, t.intervals), t.touched, t.fresh,
      t.missedByPoses, percent(t.freshCertain, t.fresh), quantile(t.widthsMs, 0.5),
      quantile(t.widthsMs, 0.9), quantile(t.growthsMm, 0.5), quantile(t.growthsMm, 1.0),
      static_cast<double>(t.pieces) / static_cast<double>(std::max<std::uint64_t>(1, t.steps)),
      static_cast<double>(t.looks) / static_cast<double>(std::max<std::uint64_t>(1, t.steps)),
      1e6 * t.bracketS / static_cast<double>(std::max<std::uint64_t>(1, t.steps)),
      t.plainS > 0.0 ? t.bracketS / t.plainS : 0.0);
}

int judgeAll(const Arguments& a) {
  std::map<std::string, PersonTally> byKind;
  PersonTally total;
  for (const std::string& name : a.scenes) {
    auto scene = test::loadScene(name, a.data);
    if (!scene) {
      std::cerr << describe(scene.error()) << "\n";
      return 2;
    }
    const tools::SolidStage stage{name, scene.value().scene, std::move(scene.value().oracle)};
    for (const std::string& path : a.clips) {
      auto actor = tools::loadActor(path);
      if (!actor) {
        std::cerr << "left out: " << describe(actor.error()) << "\n";
        continue;
      }
      tools::BusyPlaceRequest request;
      request.count = a.places;
      request.seconds = std::min(a.seconds, actor.value().clip.durationS());
      request.seed = a.seed;
      for (const tools::BusyPlace& place : tools::busyPlaces(stage, actor.value(), request)) {
        tools::SolidActor part = actor.value();
        const double frameTimeS = part.clip.frameTimeS;
        const auto from = static_cast<std::size_t>(place.fromS / frameTimeS);
        const auto count = static_cast<std::size_t>(request.seconds / frameTimeS) + 1;
        auto& frames = part.clip.frames;
        frames.erase(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(from));
        if (frames.size() > count) frames.resize(count);
        for (const double rate : a.rates) {
          if (rate * frameTimeS > 0.51) continue;
          for (const MotionModel model :
               {MotionModel::ConstantRate, MotionModel::Cubic, MotionModel::CubicLate}) {
            if (std::find(a.models.begin(), a.models.end(), toString(model)) == a.models.end()) {
              continue;
            }
            for (const bool self : {false, true}) {
              const PersonTrial trial{rate, model, !a.isConstant, self, a.boundShare, a.instants};
              const PersonTally tally = judgePerson(stage, part, place.placement, trial);
              byKind[fmt::format("{:>3} Hz {:<13} {}", rate, toString(model),
                                 self ? "own links" : "scene")]
                  .add(tally);
              total.add(tally);
            }
          }
        }
      }
      std::cout << name << ", " << actor.value().name << ": " << total.intervals << " intervals, "
                << total.missed << " missed, " << total.lied << " lied" << std::endl;
    }
  }
  for (const auto& [kind, tally] : byKind) std::cout << kind << ": " << summary(tally) << "\n";
  std::cout << "total: " << summary(total) << "\n";
  for (const std::string& finding : total.findings) std::cout << "  " << finding << "\n";
  if (total.intervals == 0) return 2;
  return total.missed + total.lied > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  a.data = test::sharedDataFolder().value_or("");
  CLI::App app{"Judges what brackets say of a person whose poses are held back"};
  app.add_option("--scenes", a.scenes, "By name")->delimiter(',');
  app.add_option("--clips", a.clips, "BVH files of DATA/mocap; all if none is given")
      ->delimiter(',');
  app.add_option("--models", a.models, "constant-rate, cubic, cubic-late")->delimiter(',');
  app.add_option("--rates", a.rates, "Given poses per second")->delimiter(',');
  app.add_option("--seconds", a.seconds, "Of each clip at each place")->check(CLI::PositiveNumber);
  app.add_option("--places", a.places, "Per clip and scene")->check(CLI::PositiveNumber);
  app.add_option("--instants", a.instants, "Per frame")->check(CLI::PositiveNumber);
  app.add_option("--seed", a.seed, "Of the places");
  app.add_option("--bound-share", a.boundShare,
                 "Of the bounds that hold: below 1 to plant a fault");
  app.add_flag("--constant", a.isConstant, "Bounds do not follow how the poses bend");
  app.add_option("--data", a.data, "Folder with mocap/ and scenes/");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (a.clips.empty()) {
    a.clips = test::clipPaths(a.data);
  } else {
    for (std::string& clip : a.clips) clip = a.data + "/mocap/" + clip;
  }
  return judgeAll(a);
}
