// tests/oracle/solid_oracle.cpp: the campaign of solid_campaign.h at any length. Exit code 0: every
// promise kept; 1: one broken; 2: bad use or nothing to do.
#include <iostream>

#include <CLI/CLI.hpp>

#include "tests/oracle/solid_campaign.h"
#include "tests/oracle/sweep_inputs.h"
#include "tests/support/shared_data.h"

namespace {

using namespace foretouch;
using test::SolidCampaign;
using test::SolidCampaignTally;
using test::SolidTargets;

struct Arguments {
  std::vector<std::string> scenes{"kitchen", "office", "collision-world", "undulating"}, clips,
      targets{"clip", "random", "hostile"};
  std::vector<double> rates{90, 30, 10}, skins{2e-3, 1e-3};
  std::string data, self = "both";
  double seconds = 4.0, sunk = 0.0;
  int places = 1;
  std::uint64_t seeds = 1, first = 1;
};

Result<tools::SolidStage> loadStage(const std::string& name, const std::string& data) {
  auto scene = test::loadScene(name, data);
  if (!scene) return scene.error();
  return tools::SolidStage{name, scene.value().scene, std::move(scene.value().oracle)};
}

std::vector<SolidCampaign> campaignsOf(const Arguments& a) {
  std::vector<SolidCampaign> all;
  for (std::uint64_t seed = a.first; seed < a.first + a.seeds; ++seed) {
    for (const double rate : a.rates) {
      for (const double skin : a.skins) {
        for (std::uint8_t t = 0; t < test::kNumSolidTargets; ++t) {
          const auto kind = static_cast<SolidTargets>(t);
          if (std::find(a.targets.begin(), a.targets.end(), toString(kind)) == a.targets.end()) {
            continue;
          }
          for (const bool self : {false, true}) {
            if (a.self != "both" && (a.self == "on") != self) continue;
            all.push_back({kind, rate, skin, a.seconds, a.sunk, self, a.places, seed});
          }
        }
      }
    }
  }
  return all;
}

int judgeAll(const Arguments& a) {
  SolidCampaignTally total;
  for (const std::string& name : a.scenes) {
    const auto stage = loadStage(name, a.data);
    if (!stage) {
      std::cerr << describe(stage.error()) << "\n";
      return 2;
    }
    for (const std::string& path : a.clips) {
      const auto actor = tools::loadActor(path);
      if (!actor) {
        std::cerr << "left out: " << describe(actor.error()) << "\n";
        continue;
      }
      SolidCampaignTally ofClip;
      for (const SolidCampaign& campaign : campaignsOf(a)) {
        ofClip.add(judgeSolid(stage.value(), actor.value(), campaign));
      }
      std::cout << name << ", " << actor.value().name << ": " << ofClip.summary() << std::endl;
      total.add(ofClip);
    }
  }
  std::cout << "total: " << total.summary() << "\n";
  for (const std::string& finding : total.way.findings) std::cout << "  " << finding << "\n";
  std::cout << total.motion.table();
  for (const std::string& finding : total.motion.findings) std::cout << "  " << finding << "\n";
  if (total.way.ticks == 0) return 2;
  return total.way.violations() + total.motion.violations() > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  a.data = test::sharedDataFolder().value_or("");
  CLI::App app{"Judges all that a solid avatar shows, by an oracle that shares no code with it"};
  app.add_option("--scenes", a.scenes, "By name")->delimiter(',');
  app.add_option("--clips", a.clips, "BVH files of DATA/mocap; all if none is given")
      ->delimiter(',');
  app.add_option("--targets", a.targets, "clip, random, hostile")
      ->delimiter(',')
      ->check(CLI::IsMember({"clip", "random", "hostile"}));
  app.add_option("--rates", a.rates, "Hz")->delimiter(',')->check(CLI::PositiveNumber);
  app.add_option("--skins", a.skins, "Metres")->delimiter(',')->check(CLI::PositiveNumber);
  app.add_option("--self", a.self, "on, off or both")->check(CLI::IsMember({"on", "off", "both"}));
  app.add_option("--seconds", a.seconds, "Of each clip at each place")->check(CLI::PositiveNumber);
  app.add_option("--sunk", a.sunk, "How far the tracked body is too low, in metres");
  app.add_option("--places", a.places, "Per combination")->check(CLI::PositiveNumber);
  app.add_option("--seeds", a.seeds, "How often, each time at other places");
  app.add_option("--first", a.first, "The first seed");
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
