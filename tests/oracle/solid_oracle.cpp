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
      targets{"clip", "random", "hostile"}, beside{"none"};
  std::vector<double> rates{90, 30, 10}, skins{2e-3, 1e-3}, sunk{0.0};
  std::string data, self = "both";
  double seconds = 4.0;
  int places = 1;
  std::uint64_t seeds = 1, first = 1;
};

Result<tools::SolidStage> loadStage(const std::string& name, const std::string& data) {
  auto scene = test::loadScene(name, data);
  if (!scene) return scene.error();
  return tools::SolidStage{name, scene.value().scene, std::move(scene.value().oracle)};
}

/// Each of `campaigns` once for each value, which `set` sets.
template <typename Value, typename Set>
std::vector<SolidCampaign> timesEach(const std::vector<SolidCampaign>& campaigns,
                                     const std::vector<Value>& values, const Set& set) {
  std::vector<SolidCampaign> all;
  for (SolidCampaign campaign : campaigns) {
    for (const Value& value : values) {
      set(campaign, value);
      all.push_back(campaign);
    }
  }
  return all;
}

/// The kinds that the words name, in their own order.
template <typename Kind>
std::vector<Kind> kindsOf(const std::vector<std::string>& words, std::uint8_t count) {
  std::vector<Kind> kinds;
  for (std::uint8_t i = 0; i < count; ++i) {
    const auto kind = static_cast<Kind>(i);
    if (std::find(words.begin(), words.end(), toString(kind)) != words.end()) kinds.push_back(kind);
  }
  return kinds;
}

std::vector<SolidCampaign> campaignsOf(const Arguments& a) {
  SolidCampaign one;
  one.seconds = a.seconds;
  one.places = a.places;
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = a.first; seed < a.first + a.seeds; ++seed) seeds.push_back(seed);
  std::vector<bool> selves;
  if (a.self != "on") selves.push_back(false);
  if (a.self != "off") selves.push_back(true);
  auto all = timesEach({one}, seeds, [](auto& c, std::uint64_t seed) { c.seed = seed; });
  all = timesEach(all, a.rates, [](auto& c, double rate) { c.rateHz = rate; });
  all = timesEach(all, a.skins, [](auto& c, double skin) { c.skin = skin; });
  all = timesEach(all, a.sunk, [](auto& c, double sunk) { c.sunk = sunk; });
  all = timesEach(all, kindsOf<test::Obstacles>(a.beside, test::kNumObstacles),
                  [](auto& c, test::Obstacles beside) { c.beside = beside; });
  all = timesEach(all, kindsOf<SolidTargets>(a.targets, test::kNumSolidTargets),
                  [](auto& c, SolidTargets targets) { c.targets = targets; });
  return timesEach(all, selves, [](auto& c, bool self) { c.self = self; });
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
  app.add_option("--sunk", a.sunk, "How far the tracked body is too low, in metres")
      ->delimiter(',');
  app.add_option("--beside", a.beside, "none, plates, cage, spikes: what stands where limbs go")
      ->delimiter(',')
      ->check(CLI::IsMember({"none", "plates", "cage", "spikes"}));
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
