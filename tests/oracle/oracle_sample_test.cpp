// tests/oracle/oracle_sample_test.cpp: a sample of the sweep, short enough for every change. The
// whole: oracle_sweep.
#include <algorithm>
#include <iostream>
#include <optional>
#include <ostream>
#include <vector>

#include <gtest/gtest.h>

#include "lss/simd.h"
#include "middleware/pair/link_query.h"
#include "tests/oracle/sweep.h"
#include "tests/oracle/sweep_placement.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

struct SampleScene {
  const char* name;
  const char* file;
  std::uint64_t fewestContacts;  // about half of what the sample holds: it must keep its reach
};

/// The case's name, for test listings.
void PrintTo(const SampleScene& tested, std::ostream* out) {
  *out << tested.name;
}

class OracleSample : public ::testing::TestWithParam<SampleScene> {};

/// How an answer may be come by: nothing is lanes not at all.
using Way = std::optional<Simd>;
std::vector<Way> everyWay() {
  std::vector<Way> ways{std::nullopt};
  for (const Simd simd : supportedSimd()) ways.emplace_back(simd);
  return ways;
}

/// The combination, answered in every way.
SweepTally sweepEveryWay(const SweepClip& clip, const SweepScene& scene, const Placement& placement,
                         SweepOptions options) {
  SweepTally total;
  for (const Way way : everyWay()) {
    options.reference.backtracking = way ? Backtracking::Lanes : Backtracking::Scalar;
    EXPECT_TRUE(useSimd(way));
    total.add(sweep(clip, scene, placement, options));
  }
  useSimd(std::nullopt);
  return total;
}

TEST_P(OracleSample, EveryAnswerKeepsThePromise) {
  FORETOUCH_REQUIRE_SHARED(file, GetParam().file);
  const std::string data = *sharedDataFolder();
  const auto scene = loadScene(GetParam().name, data);
  ASSERT_TRUE(scene.ok()) << describe(scene.error());
  SweepTally total;
  for (const char* name : {"cmu_01_01_playground_jumps.bvh", "bandai1_kick_normal_001.bvh",
                           "fair_dab.bvh", "pybvh_per_joint_orders.bvh"}) {
    FORETOUCH_REQUIRE_SHARED(path, std::string("mocap/") + name);
    const auto clip = loadClip(*path);
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    for (const Placement& placement : choosePlacements(clip.value(), scene.value(), 1)) {
      for (const double rate : {5.0, 30.0}) {
        for (const double tolerance : {1e-3, 1e-5}) {
          SweepOptions options;
          options.rateHz = rate;
          options.tolerance = tolerance;
          options.maxSteps = 30;
          total.add(sweepEveryWay(clip.value(), scene.value(), placement, options));
        }
      }
    }
  }
  std::cout << GetParam().name << ": " << total.summary() << "\n";
  RecordProperty("judged", std::to_string(total.judged));
  for (const std::string& line : total.violations) ADD_FAILURE() << line;
  EXPECT_EQ(total.broken(), 0u);
  EXPECT_EQ(total.of(oracle::Finding::Unproved), 0u);
  EXPECT_EQ(total.of(oracle::Verdict::Undecided), 0u);  // no budget was set
  EXPECT_GT(total.of(oracle::Verdict::Contact), GetParam().fewestContacts);
  EXPECT_GT(total.of(oracle::Verdict::Clear), total.judged / 4);
}

// Exact fidelity, by the triangles of a model's links.
TEST(OracleSampleOfMeshes, EveryExactAnswerKeepsThePromise) {
  FORETOUCH_REQUIRE_SHARED(file, "scenes/cpr_office.dae");
  FORETOUCH_REQUIRE_SHARED(path, "avatars/robot_expressive.glb");
  const auto scene = loadScene("office", *sharedDataFolder());
  ASSERT_TRUE(scene.ok()) << describe(scene.error());
  const auto clip = loadClip(*path);
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  SweepTally total;
  for (const Placement& placement : choosePlacements(clip.value(), scene.value(), 2)) {
    for (const LeafMethod method : {LeafMethod::Advancement, LeafMethod::Cubics}) {
      for (const double tolerance : {1e-3, 1e-5, 1e-6}) {
        SweepOptions options;
        options.rateHz = 5.0;
        options.tolerance = tolerance;
        options.maxSteps = 8;
        options.reference.leafMethod = method;
        total.add(sweepEveryWay(clip.value(), scene.value(), placement, options));
      }
    }
  }
  std::cout << total.summary() << "\n";
  for (const std::string& line : total.violations) ADD_FAILURE() << line;
  EXPECT_EQ(total.broken(), 0u);
  EXPECT_EQ(total.of(oracle::Finding::Unproved), 0u);
  EXPECT_GT(total.of(oracle::Verdict::Contact), 60u);
  EXPECT_GT(total.of(oracle::Verdict::Clear), total.judged / 4);
}

// Skinned fidelity, by the judge of skins.
TEST(OracleSampleOfSkins, EveryAnswerKeepsThePromise) {
  FORETOUCH_REQUIRE_SHARED(file, "scenes/cpr_office.dae");
  FORETOUCH_REQUIRE_SHARED(path, "avatars/cesium_man.gltf");
  const auto scene = loadScene("office", *sharedDataFolder());
  ASSERT_TRUE(scene.ok()) << describe(scene.error());
  const auto clip = loadClip(*path);
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  SweepTally total;
  for (const Placement& placement : choosePlacements(clip.value(), scene.value(), 2)) {
    for (const double tolerance : {1e-3, 1e-5}) {
      SweepOptions options;
      options.rateHz = 10.0;
      options.tolerance = tolerance;
      options.maxSteps = 4;
      options.fidelity = Fidelity::Skinned;
      total.add(sweepEveryWay(clip.value(), scene.value(), placement, options));
    }
  }
  std::cout << total.summary() << "\n";
  for (const std::string& line : total.violations) ADD_FAILURE() << line;
  EXPECT_EQ(total.broken(), 0u);
  EXPECT_EQ(total.of(oracle::Finding::Unproved), 0u);
  EXPECT_GT(total.of(oracle::Verdict::Contact), 30u);
  EXPECT_GT(total.of(oracle::Verdict::Clear), total.judged / 4);
}

// Above the links: each limb's and the avatar's volume, by the same judge.
TEST(OracleSampleOfRungs, EveryAnswerKeepsThePromise) {
  FORETOUCH_REQUIRE_SHARED(file, "scenes/collision-world.glb");
  FORETOUCH_REQUIRE_SHARED(path, "mocap/bandai1_kick_normal_001.bvh");
  const auto scene = loadScene("collision-world", *sharedDataFolder());
  ASSERT_TRUE(scene.ok()) << describe(scene.error());
  const auto clip = loadClip(*path);
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  SweepTally total;
  for (const Placement& placement : choosePlacements(clip.value(), scene.value(), 2)) {
    for (const Rung rung : {Rung::Limb, Rung::Avatar}) {
      for (const double tolerance : {1e-3, 1e-5}) {
        SweepOptions options;
        options.rateHz = 10.0;
        options.tolerance = tolerance;
        options.maxSteps = 10;
        options.reference.rung = rung;
        total.add(sweepEveryWay(clip.value(), scene.value(), placement, options));
      }
    }
  }
  std::cout << total.summary() << "\n";
  for (const std::string& line : total.violations) ADD_FAILURE() << line;
  EXPECT_EQ(total.broken(), 0u);
  EXPECT_EQ(total.of(oracle::Finding::Unproved), 0u);
  EXPECT_GT(total.of(oracle::Verdict::Contact), 10u);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, OracleSample,
    ::testing::Values(SampleScene{"kitchen", "scenes/kitchen_fatihrmutfak.ply", 700},
                      SampleScene{"office", "scenes/cpr_office.dae", 500},
                      SampleScene{"collision-world", "scenes/collision-world.glb", 600},
                      SampleScene{"undulating", "scenes/undulating.obj", 300}),
    [](const auto& sample) {
      std::string name = sample.param.name;
      for (char& c : name) c = c == '-' ? '_' : c;
      return name;
    });

/// The control: the same steps with lies planted in the answers, each of which must be named.
class OracleSampleControl : public ::testing::Test {
 protected:
  void tellLies(const std::function<void(LinkContact&)>& tamper) {
    FORETOUCH_REQUIRE_SHARED(file, "scenes/collision-world.glb");
    FORETOUCH_REQUIRE_SHARED(path, "mocap/bandai1_kick_normal_001.bvh");
    const auto scene = loadScene("collision-world", *sharedDataFolder());
    ASSERT_TRUE(scene.ok()) << describe(scene.error());
    const auto clip = loadClip(*path);
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    const auto placements = choosePlacements(clip.value(), scene.value(), 1);
    ASSERT_EQ(placements.size(), 1u);
    SweepOptions options;
    options.tolerance = 1e-6;  // so that almost no contact is one of mere nearness
    honest_ = sweep(clip.value(), scene.value(), placements[0], options);
    options.tamper = tamper;
    lied_ = sweep(clip.value(), scene.value(), placements[0], options);
    contacts_ = honest_.of(oracle::Verdict::Contact);
    ASSERT_GT(contacts_, 30u);
    EXPECT_EQ(honest_.broken(), 0u);
  }
  SweepTally honest_, lied_;
  std::uint64_t contacts_ = 0;
};

TEST_F(OracleSampleControl, NamesContactsThatAreKeptBack) {
  tellLies([](LinkContact& c) {
    if (c.verdict == Verdict::Contact) c = internal::clearContact(c.link);
  });
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_GT(lied_.of(oracle::Finding::Missed), contacts_ * 9 / 10);
}

TEST_F(OracleSampleControl, NamesContactsThatAreLate) {
  tellLies([](LinkContact& c) {
    if (c.verdict == Verdict::Contact) c.toi = c.freeUntil = std::min(1.0, c.toi + 1e-3);
  });
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_GT(lied_.of(oracle::Finding::Late), contacts_ * 9 / 10);
}

TEST_F(OracleSampleControl, NamesContactsThatAreEarly) {
  tellLies([](LinkContact& c) {
    if (c.verdict == Verdict::Contact) c.toi = c.freeUntil = 0.99 * c.toi;
  });
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_GT(lied_.of(oracle::Finding::Early), contacts_ * 9 / 10);
}

TEST_F(OracleSampleControl, NamesStartsThatAreNone) {
  tellLies([](LinkContact& c) {
    if (c.verdict != Verdict::Clear) return;
    c.verdict = Verdict::StartsInContact;
    c.toi = c.freeUntil = 0.0;
  });
  if (IsSkipped() || HasFatalFailure()) return;
  const auto links = lied_.of(oracle::Finding::WrongStart);
  EXPECT_GT(links, 1000u);
  EXPECT_GE(links, honest_.of(oracle::Verdict::Clear));
}

}  // namespace
}  // namespace foretouch::test
