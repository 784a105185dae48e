// tests/tools/sweep/sweep_program_test.cpp: `foretouch sweep` from files to files, read back.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "assets/import/scene_import.h"
#include "tests/tools/inputs/arms_bvh.h"
#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"

namespace foretouch::test {
namespace {

using nlohmann::json;

/// The files of the small world, and the arguments that sweep them.
struct SweepWorld {
  SmallWorld world;

  [[nodiscard]] Ended run(const std::string& output,
                          const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"sweep",
                                       "--avatar",
                                       world.folder / "man.json",
                                       "--motion",
                                       world.folder / "clip.bvh",
                                       "--output",
                                       world.folder / output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runForetouch(arguments);
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    return contentOf(world.folder / name);
  }
};

/// Six times the volume that triangles enclose.
double volumeOf(const std::vector<Triangle>& triangles) {
  double six = 0.0;
  for (const Triangle& t : triangles) {
    six += t.vertices[0].dot(t.vertices[1].cross(t.vertices[2]));
  }
  return six / 6.0;
}

// The hips, a sphere of 0.1 m, go 1.5 m along x; the arm, 0.5 m and 0.05 m, goes across itself.
constexpr double kPi = 3.14159265358979;
constexpr double kHips = 4.0 / 3.0 * kPi * 1e-3 + 1.5 * kPi * 1e-2;
constexpr double kArm =
    kPi * 0.05 * 0.05 * (0.5 + 4.0 / 3.0 * 0.05) + 1.5 * (0.5 * 0.1 + kPi * 0.0025);

TEST(SweepProgram, WritesWhatAnotherReaderFindsInEveryFormat) {
  const SweepWorld world;
  for (const std::string name : {"out.obj", "out.ply", "out.glb"}) {
    SCOPED_TRACE(name);
    const Ended ended = world.run(name, {"--error", "0.002"});
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    EXPECT_NE(ended.out.find("certified error, mm"), std::string::npos) << ended.out;
    const auto scene = importScene(world.world.folder / name, {});
    ASSERT_TRUE(scene.ok()) << describe(scene.error());
    const double volume = volumeOf(scene.value().scene.triangles);
    EXPECT_GT(volume, kHips + kArm);
    EXPECT_LT(volume, 1.06 * (kHips + kArm));
    for (const Triangle& t : scene.value().scene.triangles) {
      for (const Eigen::Vector3d& v : t.vertices) {
        ASSERT_GE(v.x(), -0.852);
        ASSERT_LE(v.x(), 0.852);
        ASSERT_GE(v.y(), -0.102);
        ASSERT_LE(v.y(), 0.852);
      }
    }
    if (name != "out.ply") {
      const auto& names = scene.value().scene.objectNames;
      EXPECT_EQ(std::set<std::string>(names.begin(), names.end()),
                (std::set<std::string>{"Arm", "Hips"}));
    }
  }
}

TEST(SweepProgram, InnerSurfaceIsSmaller) {
  const SweepWorld world;
  ASSERT_EQ(world.run("in.obj", {"--error", "0.002", "--inner"}).exitCode, 0);
  const auto scene = importScene(world.world.folder / "in.obj", {});
  ASSERT_TRUE(scene.ok());
  const double volume = volumeOf(scene.value().scene.triangles);
  EXPECT_LT(volume, kHips + kArm);
  EXPECT_GT(volume, 0.93 * (kHips + kArm));
}

TEST(SweepProgram, PlyHoldsTimeAndLinkOfEveryVertex) {
  const SweepWorld world;
  ASSERT_EQ(world.run("out.ply", {"--from", "0.05", "--to", "0.25", "--error", "0.01"}).exitCode,
            0);
  const std::string text = world.text("out.ply");
  EXPECT_NE(text.find("comment link 0 Hips\ncomment link 1 Arm\n"), std::string::npos);
  const std::size_t count = std::stoul(text.substr(text.find("element vertex ") + 15));
  const std::string end = "end_header\n";
  const std::size_t body = text.find(end) + end.size();
  constexpr std::size_t kRow = 4 * sizeof(double) + sizeof(std::int32_t);
  std::map<std::int32_t, std::size_t> links;
  double least = 1e9, most = -1e9;
  for (std::size_t i = 0; i < count; ++i) {
    double row[4];
    std::int32_t link = -1;
    std::memcpy(row, text.data() + body + i * kRow, sizeof row);
    std::memcpy(&link, text.data() + body + i * kRow + sizeof row, sizeof link);
    ++links[link];
    least = std::min(least, row[3]);
    most = std::max(most, row[3]);
    // The hips are at -0.75 + 5 (m/s) time, and no vertex of theirs is farther than the sphere.
    if (link == 0) {
      ASSERT_NEAR(row[0], -0.75 + 5.0 * row[3], 0.111);
    }
  }
  EXPECT_EQ(links.size(), 2u);
  EXPECT_NEAR(least, 0.05, 1e-12);
  EXPECT_NEAR(most, 0.25, 1e-12);
}

/// The clip holds a T-pose for its first five frames: then nothing of what they sweep is there.
TEST(SweepProgram, LeavesOutATPoseWhenAsked) {
  const TempFolder folder;
  folder.write("arms.bvh", armsBvh(5, 12));
  ASSERT_EQ(
      runForetouch({"avatar", "bvh", folder / "arms.bvh", "-o", folder / "arms.json"}).exitCode, 0);
  const auto highest = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"sweep",           "--avatar",          folder / "arms.json",
                                       "--motion",        folder / "arms.bvh", "--output",
                                       folder / "out.obj"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    const auto scene = importScene(folder / "out.obj", {});
    EXPECT_TRUE(scene.ok());
    double most = 0.0;
    for (const Triangle& t : scene.value().scene.triangles) {
      for (const Eigen::Vector3d& v : t.vertices) most = std::max(most, std::abs(v.x()));
    }
    return std::pair{most, ended.err};
  };
  const auto all = highest({}), cut = highest({"--skip-t-pose"}),
             named = highest({"--from", "0.05"});
  EXPECT_NE(cut.second.find("--skip-t-pose: left out a T-pose, the first 5 frames"),
            std::string::npos)
      << cut.second;
  EXPECT_LT(cut.first, all.first - 0.05) << "arms held out reach farther than arms that hang";
  EXPECT_NEAR(cut.first, named.first, 1e-9);
}

TEST(SweepProgram, GlbIsWhatItsJsonSays) {
  const SweepWorld world;
  ASSERT_EQ(world.run("out.glb", {"--links", "Arm", "--error", "0.01"}).exitCode, 0);
  const std::string text = world.text("out.glb");
  std::uint32_t total = 0, jsonBytes = 0;
  std::memcpy(&total, text.data() + 8, 4);
  std::memcpy(&jsonBytes, text.data() + 12, 4);
  EXPECT_EQ(total, text.size());
  const json root = json::parse(text.substr(20, jsonBytes));
  ASSERT_EQ(root["nodes"].size(), 1u);
  EXPECT_EQ(root["nodes"][0]["name"], "Arm");
  const json attributes = root["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_EQ(attributes.size(), 3u);
  EXPECT_TRUE(attributes.contains("_TIME") && attributes.contains("_LINK"));
  EXPECT_EQ(root["buffers"][0]["byteLength"].get<std::size_t>(), text.size() - 20 - jsonBytes - 8);
}

TEST(SweepProgram, IsTheSameTwice) {
  const SweepWorld world;
  ASSERT_EQ(world.run("one.ply").exitCode, 0);
  ASSERT_EQ(world.run("two.ply").exitCode, 0);
  EXPECT_EQ(world.text("one.ply"), world.text("two.ply"));
}

TEST(SweepProgram, RefusesBadUse) {
  const SweepWorld world;
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--links", "Arms"}, "did you mean 'Arm'"},
      {{"--links", ","}, "--links"},
      {{"--from", "2"}, "--from, --to"},
      {{"--from", "0.2", "--to", "0.1"}, "--from, --to"},
      {{"--from", "nan"}, "--from"},
      {{"--error", "0"}, "--error"},
      {{"--error", "-1"}, "--error"},
      {{"--rate", "100"}, "--rate"},
      {{"--max-triangles", "10"}, "--max-triangles"},
      {{"--inner", "--error", "0.5"}, "too thin"},
      {{"--place", "1e9,0,0"}, "--place"},
      {{"--place", "9e6,0,0", "--error", "1e-9"}, "too small"},
  };
  for (const auto& [arguments, expected] : cases) {
    const Ended ended = world.run("out.ply", arguments);
    EXPECT_EQ(ended.exitCode, 2) << expected;
    EXPECT_NE(ended.err.find(expected), std::string::npos) << ended.err;
  }
  const Ended format = world.run("out.stl");
  EXPECT_EQ(format.exitCode, 2);
  EXPECT_NE(format.err.find(".obj, .ply or .glb"), std::string::npos) << format.err;
  const Ended floats = world.run("out.glb", {"--place", "1000,0,0", "--error", "0.0001"});
  EXPECT_EQ(floats.exitCode, 2);
  EXPECT_NE(floats.err.find("single-precision"), std::string::npos) << floats.err;
  EXPECT_EQ(contentOf(world.world.folder / "out.ply"), "");  // nothing is left behind
}

}  // namespace
}  // namespace foretouch::test
