// `foretouch repair` as a user types it, on clips in which the test plants faults; an oracle that
// shares no code with the product judges what comes out, between the poses as well.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/shared_data.h"
#include "tests/tools/program_run.h"
#include "tests/tools/repair/clip_oracle.h"
#include "tests/tools/repair/legged_walk.h"

namespace foretouch::test {
namespace {

using nlohmann::json;

constexpr double kMm = 1e-3;
/// What `foretouch feet` counts as a slide (m).
constexpr double kSlide = 2 * kMm;

/// The capsules of kLeggedAvatar, once more.
const std::vector<OracleCapsule>& feetCapsules() {
  static const std::vector<OracleCapsule> all{
      {"LeftFoot", {0, -0.05, -0.05}, {0, -0.05, 0.12}, 0.03},
      {"LeftToeBase", {0, 0, 0}, {0, 0, 0.05}, 0.02},
      {"RightFoot", {0, -0.05, -0.05}, {0, -0.05, 0.12}, 0.03},
      {"RightToeBase", {0, 0, 0}, {0, 0, 0.05}, 0.02}};
  return all;
}
const OracleCapsule kTrunk{"Hips", {0, 0.05, 0}, {0, 0.45, 0}, 0.1};
const std::vector<OracleCapsule>& armCapsules() {
  static const std::vector<OracleCapsule> all{{"LeftForeArm", {0, -0.02, 0}, {0, -0.22, 0}, 0.03},
                                              {"LeftHand", {0, -0.02, 0}, {0, -0.12, 0}, 0.025}};
  return all;
}

/// Two steps of each foot. The left one's first stances are `sunk` below the floor, and slide.
LeggedWalk steps(double sunk, double slide) {
  LeggedWalk walk;
  walk.left.stances = {{{0.1, -sunk, 0}, {0.1, -sunk, slide}, 0.0, 0.6},
                       {{0.1, -sunk, 0.6}, {0.1, -sunk, 0.6 + slide}, 1.0, 1.6},
                       {{0.1, 0, 1.2}, {0.1, 0, 1.2}, 2.0, 2.6}};
  walk.right.stances = {{{-0.1, 0, -0.3}, {-0.1, 0, -0.3}, 0.0, 0.1},
                        {{-0.1, 0, 0.3}, {-0.1, 0, 0.3}, 0.5, 1.1},
                        {{-0.1, 0, 0.9}, {-0.1, 0, 0.9}, 1.5, 2.6}};
  walk.durationS = 2.4;
  return walk;
}

/// Stands still.
LeggedWalk stander() {
  LeggedWalk walk;
  walk.left.stances = {{{0.1, kMm, 0}, {0.1, kMm, 0}, 0.0, 2.6}};
  walk.right.stances = {{{-0.1, kMm, 0}, {-0.1, kMm, 0}, 0.0, 2.6}};
  return walk;
}

/// There and back, in the middle of two seconds.
double swing(double timeS) {
  return eased(timeS / 0.7 - 0.2) - eased((timeS - 1.1) / 0.7);
}

struct Mended {
  Ended ended;
  json told;
  std::string text;
};

class RepairProgram : public testing::Test {
 protected:
  RepairProgram() { folder_.write("man.json", kLeggedAvatar); }

  Mended mend(const std::string& bvh, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"repair", folder_.write("clip.bvh", bvh),
                                       folder_ / "man.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.insert(arguments.end(), {"--json", "-o", folder_ / "mended.bvh"});
    Mended mended{runForetouch(arguments), {}, ""};
    if (mended.ended.exitCode < 0 || mended.ended.exitCode > 1) {
      ADD_FAILURE() << mended.ended.err;
      return mended;
    }
    mended.told = json::parse(mended.ended.out);
    mended.text = contentOf(folder_ / "mended.bvh");
    return mended;
  }

  TempFolder folder_;
};

/// Feet that sink in by 1 to 50 mm come to lie on the floor, and nothing of them below it.
TEST_F(RepairProgram, LiftsFeetThatSinkIn) {
  for (const double sunk : {1.0, 3.0, 10.0, 25.0, 50.0}) {
    SCOPED_TRACE(sunk);
    const std::string bvh = steps(sunk * kMm, 0.0).bvh();
    const OracleClip before(bvh);
    EXPECT_NEAR(leastHeight(before, feetCapsules()[0]), -sunk * kMm, 1e-4);
    const Mended mended = mend(bvh);
    EXPECT_EQ(mended.ended.exitCode, 0) << mended.ended.out;
    const OracleClip after(mended.text);
    for (const OracleCapsule& foot : feetCapsules()) {
      EXPECT_GT(leastHeight(after, foot), 0.0) << foot.joint;
      EXPECT_LT(leastHeight(after, foot), 2.5 * kMm) << foot.joint << " rests no more";
    }
    for (const auto& [beginS, endS] : {std::pair{0.05, 0.55}, std::pair{1.05, 1.55}}) {
      EXPECT_LT(farthestSlide(after, feetCapsules()[0], beginS, endS), kSlide);
    }
    const OracleChange change = changeBetween(before, after);
    EXPECT_LT(change.mean(), std::max(1.0, sunk) * kMm);
    EXPECT_LT(change.jerkAfter, (sunk <= 10.0 ? 1.05 : 1.1) * change.jerkBefore);
  }
}

/// Feet that slide by 4 to 50 mm stay where they are, by no more change than half of it.
TEST_F(RepairProgram, HoldsFeetThatSlide) {
  for (const double slide : {4.0, 10.0, 25.0, 50.0}) {
    SCOPED_TRACE(slide);
    const std::string bvh = steps(0.0, slide * kMm).bvh();
    const OracleClip before(bvh);
    EXPECT_NEAR(farthestSlide(before, feetCapsules()[0], 0.05, 0.55), slide * kMm, 1e-4);
    const Mended mended = mend(bvh);
    EXPECT_EQ(mended.ended.exitCode, 0) << mended.ended.out;
    const OracleClip after(mended.text);
    for (const auto& [beginS, endS] : {std::pair{0.05, 0.55}, std::pair{1.05, 1.55}}) {
      for (const std::size_t foot : {0, 1}) {
        EXPECT_LT(farthestSlide(after, feetCapsules()[foot], beginS, endS), kSlide);
      }
    }
    for (const OracleCapsule& foot : feetCapsules()) EXPECT_GT(leastHeight(after, foot), 0.0);
    const OracleChange change = changeBetween(before, after);
    EXPECT_LT(change.mean(), std::max(1.0, 0.5 * slide) * kMm);
    EXPECT_LT(change.jerkAfter, 1.05 * change.jerkBefore);
  }
}

/// A hand that goes through a board and comes back stays before it.
TEST_F(RepairProgram, KeepsAHandBeforeABoard) {
  LeggedWalk walk = stander();
  walk.arm = [](double timeS) { return ArmTurn{0.0, -50.0 * swing(timeS), -20.0 * swing(timeS)}; };
  const std::string board =
      folder_.write("board.obj",
                    "o floor\nv -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 1 3 2\nf 1 4 3\n"
                    "o board\nv 0 0.6 0.5\nv 0.6 0.6 0.5\nv 0.6 1.6 0.5\nv 0 1.6 0.5\n"
                    "f 5 6 7\nf 5 7 8\n");
  const oracle::Triangle one{Vec3d(0, 0.6, 0.5), Vec3d(0.6, 0.6, 0.5), Vec3d(0.6, 1.6, 0.5)};
  const oracle::Triangle other{Vec3d(0, 0.6, 0.5), Vec3d(0.6, 1.6, 0.5), Vec3d(0, 1.6, 0.5)};
  const std::string bvh = walk.bvh();
  const OracleClip before(bvh);
  EXPECT_LT(std::min(leastDistance(before, armCapsules()[1], one),
                     leastDistance(before, armCapsules()[1], other)),
            0.0);
  const Mended mended = mend(bvh, {board});
  EXPECT_EQ(mended.ended.exitCode, 0) << mended.ended.out;
  const OracleClip after(mended.text);
  for (const OracleCapsule& arm : armCapsules()) {
    EXPECT_GT(leastDistance(after, arm, one), 0.0);
    EXPECT_GT(leastDistance(after, arm, other), 0.0);
    for (double at = 0.0; at < 200.0; at += 0.25) {
      EXPECT_LT(after.pointAt(arm.joint, arm.b, at).z + arm.radius, 0.5) << at;
    }
  }
  // The legs had no part in it.
  EXPECT_EQ(before.pointAt("LeftFoot", {}, 100.0).x, after.pointAt("LeftFoot", {}, 100.0).x);
}

/// A forearm that goes into the own trunk goes around it.
TEST_F(RepairProgram, KeepsAForearmOutOfTheTrunk) {
  LeggedWalk walk = stander();
  walk.arm = [](double timeS) { return ArmTurn{-19.0 * swing(timeS), 0.0, -90.0}; };
  const std::string bvh = walk.bvh();
  const OracleClip before(bvh);
  EXPECT_LT(leastDistance(before, armCapsules()[0], kTrunk), -10 * kMm);
  const Mended mended = mend(bvh, {"--self"});
  EXPECT_EQ(mended.ended.exitCode, 0) << mended.ended.out;
  const OracleClip after(mended.text);
  for (const OracleCapsule& arm : armCapsules()) EXPECT_GT(leastDistance(after, arm, kTrunk), 0.0);
  const OracleChange change = changeBetween(before, after);
  EXPECT_LT(change.mean(), 5 * kMm);
}

/// What is free stays as it is, byte by byte; and where something is mended, frames far from it.
TEST_F(RepairProgram, LeavesAloneWhatIsFree) {
  const std::string free = stander().bvh();
  const Mended same = mend(free);
  EXPECT_EQ(same.ended.exitCode, 0);
  EXPECT_EQ(same.text, free);

  LeggedWalk walk = stander();
  walk.durationS = 4.0;
  walk.left.stances = walk.right.stances = {};
  walk.left.stances.push_back({{0.1, kMm, 0}, {0.1, kMm, 0}, 0.0, 9.0});
  walk.right.stances.push_back({{-0.1, kMm, 0}, {-0.1, kMm, 0}, 0.0, 9.0});
  walk.arm = [](double timeS) { return ArmTurn{-19.0 * swing(timeS), 0.0, -90.0}; };
  const std::string bvh = walk.bvh();
  const Mended mended = mend(bvh, {"--self"});
  EXPECT_EQ(mended.ended.exitCode, 0) << mended.ended.out;
  EXPECT_NE(mended.text, bvh);
  EXPECT_EQ(mended.text.substr(0, bvh.find("Frame Time")), bvh.substr(0, bvh.find("Frame Time")));
  EXPECT_TRUE(mended.text.substr(mended.text.size() - 9000) == bvh.substr(bvh.size() - 9000));
}

/// Somebody who walks through a wall cannot be mended: the report names when and why, the exit code
/// says so, and the rest is mended all the same.
TEST_F(RepairProgram, NamesWhatItCannotMend) {
  const std::string wall = folder_.write(
      "wall.obj",
      "o floor\nv -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 1 3 2\nf 1 4 3\n"
      "o wall\nv -1 0.1 0.35\nv 1 0.1 0.35\nv 1 2 0.35\nv -1 2 0.35\nf 5 6 7\nf 5 7 8\n");
  LeggedWalk walk = steps(10 * kMm, 0.0);
  walk.durationS = 1.0;
  const Mended mended = mend(walk.bvh(), {wall});
  EXPECT_EQ(mended.ended.exitCode, 1);
  ASSERT_FALSE(mended.told["not_mended"].empty());
  bool isTold = false;
  for (const json& fault : mended.told["not_mended"]) {
    EXPECT_FALSE(fault["reason"].get<std::string>().empty());
    isTold =
        isTold || (fault["what"] == "Hips touches wall" &&
                   fault["reason"].get<std::string>().find("goes through") != std::string::npos);
  }
  EXPECT_TRUE(isTold) << mended.ended.out;
  EXPECT_LT(mended.told["after"]["faulty"], mended.told["before"]["faulty"]);
}

struct RealClip {
  const char* file;
  double unit;  // metres
  std::size_t first, last;
  double mostMeanMm, mostTurnDeg;  // of the change: mean, 99th percentile

  friend void PrintTo(const RealClip& clip, std::ostream* out) { *out << clip.file; }
};

Vec3d vectorOf(const json& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// Every capsule of an avatar's file, in units of the clip.
std::vector<OracleCapsule> capsulesOf(const std::string& avatarFile, double unit) {
  std::vector<OracleCapsule> all;
  const json avatar = json::parse(contentOf(avatarFile));
  for (const json& link : avatar["links"]) {
    for (const json& lss : link["lss"]) {
      all.push_back({link["name"], (1.0 / unit) * vectorOf(lss["a"]),
                     (1.0 / unit) * vectorOf(lss["b"]), lss["radius"].get<double>() / unit});
    }
  }
  return all;
}

class RepairOfRealClips : public testing::TestWithParam<RealClip> {};

/// With their natural faults: nothing of the body is below the floor afterwards, at no instant, and
/// every interval is proven, by little change, which turns no joint far and adds no jerk.
TEST_P(RepairOfRealClips, ProvesEveryInterval) {
  const RealClip& real = GetParam();
  FORETOUCH_REQUIRE_SHARED(clip, std::string("mocap/") + real.file);
  const TempFolder folder;
  const std::string unit = std::to_string(real.unit), avatar = folder / "body.json";
  ASSERT_EQ(runForetouch({"avatar", "bvh", *clip, "--clip-scale", unit, "--heels", "-o", avatar})
                .exitCode,
            0);
  const Ended ended =
      runForetouch({"repair", *clip, avatar, "--clip-scale", unit, "--ground", "fit", "--from",
                    std::to_string(real.first) + "f", "--to", std::to_string(real.last) + "f",
                    "--json", "-o", folder / "mended.bvh"});
  ASSERT_EQ(ended.exitCode, 0) << ended.out << ended.err;
  const json told = json::parse(ended.out);
  EXPECT_GT(told["before"]["faulty"], 30);
  EXPECT_EQ(told["after"]["faulty"], 0);

  const auto part = [&](const std::string& file) {
    return OracleClip(contentOf(file)).cut(real.first, real.last);
  };
  const OracleClip before = part(*clip), after = part(folder / "mended.bvh");
  const json& fit = told["ground_fit"];
  const OracleFloor floor{(1.0 / real.unit) * vectorOf(fit["point"]), vectorOf(fit["normal"])};
  double lowestBefore = 1e9, lowestAfter = 1e9;
  for (const OracleCapsule& capsule : capsulesOf(avatar, real.unit)) {
    lowestBefore = std::min(lowestBefore, real.unit * leastHeight(before, capsule, floor));
    lowestAfter = std::min(lowestAfter, real.unit * leastHeight(after, capsule, floor));
  }
  EXPECT_LT(lowestBefore, -3 * kMm);
  EXPECT_GT(lowestAfter, 0.0);

  const OracleChange change = changeBetween(before, after, real.unit);
  EXPECT_LT(change.mean(), real.mostMeanMm * kMm);
  EXPECT_LT(change.turns[change.turns.size() * 99 / 100], real.mostTurnDeg);
  EXPECT_LT(change.jerkAfter, 1.05 * change.jerkBefore);
  EXPECT_NEAR(told["moved_mm"]["mean"].get<double>(), 1e3 * change.mean(), 0.05);
}

// The walk jumps from a T-pose, its first frame; the dance is long.
INSTANTIATE_TEST_SUITE_P(
    Clips, RepairOfRealClips,
    testing::Values(RealClip{"cmu_jumping_jacks.bvh", 0.0564, 1, 124, 2.0, 2.0},
                    RealClip{"cmu_cgspeed_walk_crlf.bvh", 0.0564, 1, 343, 2.0, 2.0},
                    RealClip{"bandai1_dance-short_normal_001.bvh", 0.01, 60, 360, 3.0, 2.5}));

}  // namespace
}  // namespace foretouch::test
