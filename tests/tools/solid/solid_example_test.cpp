// tests/tools/solid/solid_example_test.cpp: the bundled hand and the bundled dancer as solid
// avatars, judged by the oracle from the recorded ways alone.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/avatar_file.h"
#include "judge/judge.h"
#include "tests/support/judged.h"
#include "tests/support/temp_folder.h"
#include "tests/tools/program_run.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/solid/solid_reader.h"

namespace foretouch::test {
namespace {

using tools::SolidRecord;

const std::string kExamples = std::string(FORETOUCH_EXAMPLE_FOLDER) + "/";

/// A bundled clip, played solid by the program, and read back.
struct Shown {
  Avatar avatar;
  Scene scene;
  std::vector<SolidRecord> ticks;
};

std::optional<Shown> shown(const std::string& scene, const std::string& body,
                           const std::string& rate, const std::string& ignored = "") {
  const TempFolder folder;
  const std::string out = folder / "shown.jsonl";
  std::vector<std::string> arguments{"replay",
                                     "--scene",
                                     kExamples + scene,
                                     "--avatar",
                                     kExamples + body + ".avatar.json",
                                     "--motion",
                                     kExamples + body + ".bvh",
                                     "--rate",
                                     rate,
                                     "--solid",
                                     "--output",
                                     out};
  if (!ignored.empty()) arguments.insert(arguments.end(), {"--ignore", "*:" + ignored});
  const Ended ended = runForetouch(arguments);
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(runForetouch({"solid", "check", out, "--scene", kExamples + scene, "--avatar",
                          kExamples + body + ".avatar.json"})
                .exitCode,
            0);
  tools::WorldRequest world;
  world.scenePath = kExamples + scene;
  auto avatar = readAvatarFile(kExamples + body + ".avatar.json");
  auto loaded = tools::loadScene(world);
  auto reader = tools::SolidReader::open(out);
  if (!avatar.ok() || !loaded.ok() || !reader.ok()) {
    ADD_FAILURE() << ended.err;
    return std::nullopt;
  }
  Shown all{std::move(avatar).value(), std::move(loaded).value(), {}};
  for (;;) {
    auto record = reader.value().next();
    EXPECT_TRUE(record.ok());
    if (!record.ok() || !record.value()) break;
    all.ticks.push_back(std::move(*record.value()));
  }
  return all;
}

/// Asks the oracle whether the ways are free: it shares no code with what certified them.
class WayJudge {
 public:
  /// Without the triangles of `ignored`.
  WayJudge(const Shown& shown, const std::string& ignored)
      : avatar_(shown.avatar), scene_(plain(trianglesOf(shown.scene, ignored))) {}

  void expectFree(const Pose& from, const Pose& to, std::int64_t tick) {
    const oracle::Motion motion(plainJoints(avatar_.skeleton(), from, to));
    for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
      const auto capsules = plainCapsules(avatar_, link);
      if (capsules.empty()) continue;
      oracle::Judge judge(scene_, motion, link, capsules);
      const auto judged = judge.judge(oracle::Answer{}, 1e-3);
      EXPECT_EQ(judged.finding, oracle::Finding::Ok)
          << "tick " << tick << ", " << avatar_.skeleton().name(link) << ": "
          << oracle::toString(judged.finding);
      ++motions;
    }
  }

  int motions = 0;

 private:
  static std::vector<Triangle> trianglesOf(const Scene& scene, const std::string& ignored) {
    std::vector<Triangle> triangles;
    for (TriangleId id = 0; id < static_cast<TriangleId>(scene.numTriangles()); ++id) {
      const std::string& object = scene.objectNames()[slotOf(scene.object(id))];
      if (object != ignored && isFinite(scene.triangle(id))) {
        triangles.push_back(scene.triangle(id));
      }
    }
    return triangles;
  }

  const Avatar& avatar_;
  oracle::Scene scene_;
};

/// Judges the way of every `stride`-th tick; returns the shown pose of each tick.
std::vector<Pose> judgedWays(const Shown& shown, std::size_t stride, int& motions,
                             const std::string& ignored = "") {
  WayJudge judge(shown, ignored);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < shown.ticks.size(); ++i) {
    const SolidRecord& tick = shown.ticks[i];
    EXPECT_TRUE(tick.isCertified) << i;
    EXPECT_EQ(tick.start.has_value(), i == 0) << i;
    Pose from = tick.start ? *tick.start : poses.back();
    for (const Pose& to : tick.way) {
      if (i % stride == 0) judge.expectFree(from, to, tick.tick);
      from = to;
    }
    poses.push_back(std::move(from));
  }
  motions = judge.motions;
  return poses;
}

TEST(SolidExample, HandPressesSlidesAndLeavesTheDeskByAWayThatIsFree) {
  const auto hand = shown("desk.obj", "hand", "60");
  ASSERT_TRUE(hand);
  int motions = 0;
  const std::vector<Pose> poses = judgedWays(*hand, 1, motions);
  EXPECT_GT(motions, 1000);
  const auto stateAt = [&](double timeS) {
    return hand->ticks[static_cast<std::size_t>(60.0 * timeS)].state;
  };
  EXPECT_EQ(stateAt(0.5), SolidState::Equal);
  EXPECT_EQ(stateAt(1.7), SolidState::Held);  // pressed, at rest
  EXPECT_EQ(stateAt(2.4), SolidState::Sliding);
  EXPECT_EQ(stateAt(4.4), SolidState::Equal);  // and back
  // It follows along the desk: the tracked hand goes 36 cm.
  const JointId link = hand->avatar.skeleton().find("Hand").value();
  const auto placeAt = [&](double timeS) {
    const Pose& pose = poses[static_cast<std::size_t>(60.0 * timeS)];
    return ChainMotion(hand->avatar.skeleton(), pose, pose).stateAt(link, 0.0).p_WL;
  };
  EXPECT_NEAR((placeAt(3.2) - placeAt(1.7)).x(), 0.36, 0.03);
  EXPECT_GT(placeAt(2.4).y(), 0.74);
}

TEST(SolidExample, DancerPassesThroughNothingOfTheRoom) {
  // Behind the curtain's cords the whole dance would be held.
  const auto dancer = shown("room.obj", "dancer", "30", "string_curtain");
  ASSERT_TRUE(dancer);
  int motions = 0;
  static_cast<void>(judgedWays(*dancer, 8, motions, "string_curtain"));
  EXPECT_GT(motions, 1000);
  const auto kept =
      std::count_if(dancer->ticks.begin(), dancer->ticks.end(),
                    [](const SolidRecord& tick) { return tick.state != SolidState::Equal; });
  EXPECT_GT(kept, 40);  // the room is in the way
  EXPECT_LT(kept, static_cast<std::ptrdiff_t>(dancer->ticks.size()));
}

}  // namespace
}  // namespace foretouch::test
