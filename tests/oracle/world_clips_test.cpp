// Real clips in one world, each held against the judge's own: everybody against everybody at rates
// of their own, a ring thrown through them, a sword in the hand.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/oracle/world_campaign.h"
#include "tests/oracle/world_stage.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// Those that move; one more than a person has links is left to other tests.
const char* const kClips[] = {"bandai1_dance-short_normal_001.bvh",
                              "bandai1_kick_normal_001.bvh",
                              "bandai1_slash_normal_001.bvh",
                              "cmu_01_01_playground_jumps.bvh",
                              "fair_dab.bvh",
                              "cmu_cgspeed_walk_crlf.bvh"};

struct Total {
  WorldTally tally;
  std::size_t windows = 0;

  void add(const BothWorlds& both) {
    for (const std::string& problem : both.problems) ADD_FAILURE() << problem;
    tally.clear += both.tally.clear;
    tally.contact += both.tally.contact;
    tally.start += both.tally.start;
    tally.undecided += both.tally.undecided;
    tally.grazing += both.tally.grazing;
  }
  void expectKept(int contacts) const {
    std::cout << windows << " windows: " << tally.clear << " clear, " << tally.contact
              << " contacts, " << tally.start << " in contact from the start, " << tally.grazing
              << " too slow for the judge\n";
    EXPECT_GT(tally.contact, contacts);
    EXPECT_EQ(tally.undecided, 0);
    EXPECT_LE(tally.grazing, tally.contact / 50);
  }
};

std::vector<SweepClip> loadedClips() {
  std::vector<SweepClip> clips;
  for (const char* const name : kClips) {
    const auto path = sharedData(std::string("mocap/") + name);
    if (!path) continue;
    auto clip = loadClip(*path);
    EXPECT_TRUE(clip.ok()) << describe(clip.error());
    if (clip.ok()) clips.push_back(std::move(clip).value());
  }
  return clips;
}

constexpr std::int64_t kWindowUs = 150'000, kWindows = 4;

TEST(WorldOfClips, ProvesEveryClipAgainstEveryOther) {
  FORETOUCH_REQUIRE_SHARED(any, std::string("mocap/") + kClips[0]);
  const std::vector<SweepClip> clips = loadedClips();
  const double rates[] = {30.0, 90.0, 120.0, 10.0};
  Total total;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    for (std::size_t j = i; j < clips.size(); ++j) {
      SCOPED_TRACE(clips[i].name + " and " + clips[j].name);
      Random random(100 * i + j);
      BothWorlds both(random.chance(0.5) ? 1e-3 : 1e-5);
      const BodyId one = both.add(clips[i].avatar), other = both.add(clips[j].avatar);
      Walk beside;
      beside.place.yaw = random.uniform(-3.0, 3.0);
      beside.place.position = Vector3d(random.uniform(0.5, 0.9), 0.0, random.uniform(-0.3, 0.3));
      beside.speed = Vector3d(random.uniform(-2.0, -0.5), 0.0, random.uniform(-0.5, 0.5));
      pushAll(both, one, posesOf(clips[i], rates[random.below(4)], 0, kWindows * kWindowUs));
      pushAll(both, other,
              posesOf(clips[j], rates[random.below(4)], -random.below(5000), kWindows * kWindowUs,
                      beside));
      for (std::int64_t from = 0; from < kWindows * kWindowUs; from += kWindowUs) {
        both.judgeAll(from, from + kWindowUs);
        ++total.windows;
      }
      total.add(both);
    }
  }
  total.expectKept(100);
}

TEST(WorldOfClips, ProvesRingsThatAreThrownAndSwordsThatAreHeld) {
  FORETOUCH_REQUIRE_SHARED(any, std::string("mocap/") + kClips[0]);
  const std::vector<SweepClip> clips = loadedClips();
  Total total;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    SCOPED_TRACE(clips[i].name);
    Random random(i);
    BothWorlds both(random.chance(0.5) ? 1e-3 : 1e-5);
    const BodyId body = both.add(clips[i].avatar);
    const BodyId thrown = both.add(ring(0.12, 0.02, 24)), held = both.add(sword());
    pushAll(both, body, posesOf(clips[i], 30.0, 0, kWindows * kWindowUs));
    Flight flight;
    const double stepS = 1e-6 * static_cast<double>(flight.periodUs);
    flight.pose = {random.rotation(), Vector3d(-0.6, -0.1, random.uniform(-0.2, 0.2))};
    flight.turnBy = random.turn(8.0 * stepS);
    flight.stepBy.x() = 3.5 * stepS;
    fly(both, thrown, flight, kWindows * kWindowUs);
    const auto hand = clips[i].avatar.skeleton().find("RightHand");
    const LinkId holding = hand ? *hand : clips[i].avatar.numLinks() - 1;
    both.attach(held, {body, holding}, 0, {random.rotation(), Vector3d::Zero()});
    for (std::int64_t from = 0; from < kWindows * kWindowUs; from += kWindowUs) {
      both.judge(body, thrown, from, from + kWindowUs);
      both.judge(body, held, from, from + kWindowUs);
      ++total.windows;
    }
    total.add(both);
  }
  total.expectKept(20);
}

/// One short world of each part, of the first two clips.
WorldCampaignTally shortCampaign(const std::function<void(WorldContacts&)>& tamper) {
  const std::vector<SweepClip> clips = loadedClips();
  WorldCampaignTally total;
  for (std::uint8_t part = 0; part < kNumWorldParts; ++part) {
    WorldCampaign campaign;
    campaign.part = static_cast<WorldPart>(part);
    campaign.tolerance = 1e-5;
    campaign.windows = 2;
    campaign.seed = 10u + part;
    campaign.tamper = tamper;
    total.add(judgeWorld(clips.at(0), clips.at(1), campaign));
  }
  return total;
}

TEST(WorldCampaign, KeepsThePromiseInEveryPart) {
  FORETOUCH_REQUIRE_SHARED(first, std::string("mocap/") + kClips[0]);
  FORETOUCH_REQUIRE_SHARED(second, std::string("mocap/") + kClips[1]);
  const WorldCampaignTally total = shortCampaign(nullptr);
  std::cout << total.summary() << "\n";
  for (const std::string& finding : total.findings) ADD_FAILURE() << finding;
  EXPECT_EQ(total.worlds, kNumWorldParts);
  EXPECT_EQ(total.windows, 2u * kNumWorldParts);
  EXPECT_GT(total.pairInstants, 100'000u);
  EXPECT_GT(total.answers.contact, 20);
  EXPECT_EQ(total.violations(), 0u);
}

// The control: each lie is counted for what it is.
TEST(WorldCampaign, CountsLies) {
  FORETOUCH_REQUIRE_SHARED(first, std::string("mocap/") + kClips[0]);
  FORETOUCH_REQUIRE_SHARED(second, std::string("mocap/") + kClips[1]);
  const auto shifted = [](std::int64_t us) {
    return [us](WorldContacts& answer) {
      for (WorldContact& contact : answer.contacts) {
        if (contact.verdict == Verdict::Contact) contact.time.us += us;
      }
    };
  };
  const auto silent = shortCampaign([](WorldContacts& answer) { answer.contacts.clear(); });
  EXPECT_GT(silent.missed, 20u);
  EXPECT_EQ(silent.violations(), silent.missed);
  const auto late = shortCampaign(shifted(500)), early = shortCampaign(shifted(-500));
  EXPECT_GT(late.late, 20u);
  EXPECT_EQ(late.early + late.missed, 0u);
  EXPECT_GT(early.early, 20u);
  EXPECT_EQ(early.late + early.missed, 0u);
  EXPECT_FALSE(late.findings.empty());
}

}  // namespace
}  // namespace foretouch::test
