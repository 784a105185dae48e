// tests/oracle/world_oracle.cpp: the campaign of world_campaign.h at any length. Exit code 0: every
// promise kept; 1: one broken; 2: bad use or nothing to do.
#include <algorithm>
#include <iostream>

#include <CLI/CLI.hpp>

#include "tests/oracle/world_campaign.h"
#include "tests/support/shared_data.h"

namespace {

using namespace foretouch;
using test::SweepClip;
using test::WorldCampaign;
using test::WorldCampaignTally;
using test::WorldPart;

struct Arguments {
  std::vector<std::string> clips, parts{"pairs", "thrown", "held", "doors", "lifts"};
  std::vector<double> otherRates{90, 120}, tolerances{1e-3, 1e-5};
  std::string data;
  double rate = 30.0;
  int windows = 4, instants = 400;
  std::uint64_t seeds = 1;

  [[nodiscard]] bool judgesEvents() const {
    return std::find(parts.begin(), parts.end(), "events") != parts.end();
  }
};

std::vector<SweepClip> loadedClips(const Arguments& a) {
  std::vector<SweepClip> clips;
  for (const std::string& path : a.clips) {
    auto clip = test::loadClip(path);
    if (!clip) {
      std::cerr << "left out: " << describe(clip.error()) << "\n";
      continue;
    }
    clips.push_back(std::move(clip).value());
  }
  return clips;
}

/// Events are followed on every stage, unless some are named.
bool isAsked(const Arguments& a, WorldPart part) {
  if (a.judgesEvents() && a.parts.size() == 1) return true;
  return std::find(a.parts.begin(), a.parts.end(), toString(part)) != a.parts.end();
}

/// All tolerances and rates of one part, for two clips; different seeds for different clips.
WorldCampaignTally judgePart(const Arguments& a, WorldPart part, const SweepClip& one,
                             const SweepClip& other, std::uint64_t seed) {
  WorldCampaignTally tally;
  for (const double tolerance : a.tolerances) {
    for (const double otherRate : a.otherRates) {
      tally.add(judgeWorld(one, other,
                           {part, a.rate, otherRate, tolerance, a.windows, seed++, nullptr,
                            a.judgesEvents() ? a.instants : 0}));
    }
  }
  return tally;
}

std::string summaryOf(const Arguments& a, const WorldCampaignTally& tally) {
  return a.judgesEvents() ? tally.summaryOfEvents() : tally.summary();
}

int judgeAll(const Arguments& a) {
  const std::vector<SweepClip> clips = loadedClips(a);
  WorldCampaignTally total;
  for (std::uint64_t seed = 0; seed < a.seeds; ++seed) {
    for (std::size_t i = 0; i < clips.size(); ++i) {
      WorldCampaignTally ofClip;
      for (std::size_t j = i; j < clips.size(); ++j) {
        const std::uint64_t first = 1'000'000 * seed + 10'000 * i + 100 * j;
        for (std::uint8_t p = 0; p < test::kNumWorldParts; ++p) {
          const auto part = static_cast<WorldPart>(p);
          // Every clip against every other; props beside one more.
          const bool isNext = j == (i + 1 < clips.size() ? i + 1 : i);
          if (!isAsked(a, part) || (part != WorldPart::Pairs && !isNext)) continue;
          ofClip.add(judgePart(a, part, clips[i], clips[j], first + 10 * p));
        }
      }
      total.add(ofClip);
      std::cout << "seed " << seed << ", " << clips[i].name << ": " << summaryOf(a, ofClip)
                << "; so far " << total.pairInstants << " pair-instants, " << total.violations()
                << " broken" << std::endl;
    }
  }
  std::cout << "total: " << summaryOf(a, total) << "\n";
  for (const std::string& finding : total.findings) std::cout << "  " << finding << "\n";
  if (total.windows == 0) return 2;
  return total.violations() > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  a.data = test::sharedDataFolder().value_or("");
  CLI::App app{"Judges a moving world by an oracle that shares no code with it"};
  app.add_option("--clips", a.clips, "BVH files of DATA/mocap; all if none is given")
      ->delimiter(',');
  app.add_option("--parts", a.parts,
                 "pairs, thrown, held, doors, lifts, wild, sheets; events: what a follower tells, "
                 "on all of these, or on those that are named beside it")
      ->delimiter(',')
      ->check(
          CLI::IsMember({"pairs", "thrown", "held", "doors", "lifts", "wild", "sheets", "events"}));
  app.add_option("--rate", a.rate, "Of the first clip, Hz")->check(CLI::PositiveNumber);
  app.add_option("--other-rates", a.otherRates, "Of the others and of props, Hz")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  app.add_option("--tolerances", a.tolerances, "Metres")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  app.add_option("--windows", a.windows, "Of 150 ms each, per world")->check(CLI::PositiveNumber);
  app.add_option("--instants", a.instants, "At which events are sampled, per world")
      ->check(CLI::PositiveNumber);
  app.add_option("--seeds", a.seeds, "How often, each time at other places");
  app.add_option("--data", a.data, "Folder with mocap/");
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
