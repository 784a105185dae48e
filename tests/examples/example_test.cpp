// tests/examples/example_test.cpp: the bundled files are what examples/README.md says, and show
// what they are there to show.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "assets/avatar/avatar_file.h"
#include "assets/avatar/joint_match.h"
#include "assets/bvh/bvh_reader.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "tests/reference/reference_query.h"

namespace foretouch {
namespace {

const std::string kFolder = FORETOUCH_EXAMPLE_FOLDER;

std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// What an OBJ file of `o`, `v` and three-cornered `f` lines holds; a failure for any other line.
RawScene readPlainObj(const std::string& path) {
  RawScene scene;
  std::vector<Eigen::Vector3d> vertices;
  std::ifstream file(path);
  EXPECT_TRUE(file.is_open()) << path;
  std::string line, kind;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    words >> kind;
    if (kind == "o") {
      words >> scene.objectNames.emplace_back();
    } else if (kind == "v") {
      Eigen::Vector3d& p = vertices.emplace_back();
      words >> p.x() >> p.y() >> p.z();
    } else if (kind == "f") {
      std::size_t a = 0, b = 0, c = 0;
      words >> a >> b >> c;
      const bool known = std::min({a, b, c}) >= 1 && std::max({a, b, c}) <= vertices.size();
      EXPECT_TRUE(known) << line;
      if (known) {
        scene.triangles.push_back({{vertices[a - 1], vertices[b - 1], vertices[c - 1]}});
        scene.objectOf.push_back(static_cast<ObjectId>(scene.objectNames.size()) - 1);
      }
    } else {
      EXPECT_EQ(kind, "#") << line;
    }
    EXPECT_FALSE(words.fail()) << line;
  }
  return scene;
}

/// The clip as poses of the avatar, every one of them legal.
struct ExampleMotion {
  Avatar avatar;
  Clip clip;
  std::vector<Pose> poses;

  static ExampleMotion read() {
    auto avatar = readAvatarFile(kFolder + "/dancer.avatar.json");
    auto clip = readBvhFile(kFolder + "/dancer.bvh");
    if (!avatar.ok() || !clip.ok()) {
      ADD_FAILURE() << (avatar.ok() ? describe(clip.error()) : describe(avatar.error()));
      std::abort();
    }
    ExampleMotion motion{std::move(avatar).value(), std::move(clip).value(), {}};
    const Skeleton& skeleton = motion.avatar.skeleton();
    const auto match = matchJoints(skeleton, motion.clip.skeleton);
    EXPECT_TRUE(match.ok());
    for (std::size_t frame = 0; match.ok() && frame < motion.clip.frames.size(); ++frame) {
      auto pose =
          validatedPose(skeleton, poseOfAvatar(skeleton, motion.clip, match.value(), frame));
      EXPECT_TRUE(pose.ok()) << "frame " << frame;
      motion.poses.push_back(pose.ok() ? std::move(pose).value() : restPose(skeleton));
    }
    return motion;
  }
};

constexpr std::size_t kFramesAStep = 6;  // 10 Hz of 60

TEST(ExampleRoom, HasAboutAHundredThousandFiniteTrianglesWithArea) {
  const SceneAudit audit = auditScene(readPlainObj(kFolder + "/room.obj"));
  EXPECT_GE(audit.triangles, 95'000u);
  EXPECT_LE(audit.triangles, 110'000u);
  EXPECT_EQ(audit.droppedNonFinite, 0u);
  EXPECT_EQ(audit.zeroArea, 0u);
  EXPECT_EQ(audit.duplicates, 0u);
}

TEST(ExampleRoom, IsInMetresWithItsFloorAtZero) {
  const SceneAudit audit = auditScene(readPlainObj(kFolder + "/room.obj"));
  EXPECT_NEAR(audit.boxMin.y(), 0.0, 1e-9);
  EXPECT_GT(audit.boxMax.y(), 2.0);
  EXPECT_LT(audit.boxMax.y(), 5.0);
  EXPECT_GT((audit.boxMax - audit.boxMin).x(), 5.0);
  EXPECT_LT((audit.boxMax - audit.boxMin).x(), 10.0);
}

TEST(ExampleRoom, NamesEveryObjectOnceAndLeavesNoneEmpty) {
  const RawScene scene = readPlainObj(kFolder + "/room.obj");
  const std::set<std::string> names(scene.objectNames.begin(), scene.objectNames.end());
  EXPECT_EQ(names.size(), scene.objectNames.size());
  EXPECT_EQ(names.count(""), 0u);
  for (const char* name :
       {"floor", "table", "chair_1", "string_curtain", "railing_bars", "plant"}) {
    EXPECT_EQ(names.count(name), 1u) << name;
  }
  ASSERT_FALSE(scene.objectOf.empty());
  EXPECT_GE(*std::min_element(scene.objectOf.begin(), scene.objectOf.end()), 0);
  const std::set<ObjectId> used(scene.objectOf.begin(), scene.objectOf.end());
  EXPECT_EQ(used.size(), scene.objectNames.size());
}

TEST(ExampleClip, LastsAsLongAsItsFramesSay) {
  const ExampleMotion motion = ExampleMotion::read();
  EXPECT_TRUE(motion.clip.notes.empty()) << motion.clip.notes.front();
  EXPECT_NEAR(motion.clip.frameTimeS, 1.0 / 60.0, 1e-9);
  EXPECT_NEAR(motion.clip.durationS(), 13.6, 1e-6);
  EXPECT_EQ((motion.clip.frames.size() - 1) % kFramesAStep, 0u);  // no frames left over at 10 Hz
}

TEST(ExampleClip, DrivesEveryLinkOfTheAvatarByName) {
  const ExampleMotion motion = ExampleMotion::read();
  const Skeleton &avatar = motion.avatar.skeleton(), &clip = motion.clip.skeleton;
  EXPECT_GE(avatar.numJoints(), 20);
  const auto match = matchJoints(avatar, clip);
  ASSERT_TRUE(match.ok());
  EXPECT_TRUE(match.value().unmatchedAvatar.empty());
  EXPECT_TRUE(match.value().unmatchedClip.empty());
  for (JointId joint = 0; joint < avatar.numJoints(); ++joint) {
    const auto twin = clip.find(avatar.name(joint));
    ASSERT_TRUE(twin.has_value());
    EXPECT_LT((clip.restOffset(*twin) - avatar.restOffset(joint)).norm(), 1e-9);
    EXPECT_FALSE(motion.avatar.lss(joint).empty()) << avatar.name(joint);
  }
}

TEST(ExampleClip, TurnsNoJointTooFarInATenthOfASecond) {
  const ExampleMotion motion = ExampleMotion::read();
  constexpr double kMost = 120.0 * 3.14159265358979323846 / 180.0;
  double most = 0.0;
  for (std::size_t f = 0; f + kFramesAStep < motion.poses.size(); f += kFramesAStep) {
    for (std::size_t joint = 0; joint < motion.poses[f].rotations.size(); ++joint) {
      most = std::max(most, motion.poses[f].rotations[joint].angularDistance(
                                motion.poses[f + kFramesAStep].rotations[joint]));
    }
  }
  EXPECT_LT(most, kMost);
  EXPECT_GT(most, 0.5 * kMost);  // it is a dance
}

TEST(ExampleClip, KeepsTheSolesJustAboveTheFloor) {
  const ExampleMotion motion = ExampleMotion::read();
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    const ChainMotion still(motion.avatar.skeleton(), motion.poses[f], motion.poses[f]);
    double lowest = std::numeric_limits<double>::max();
    for (LinkId link = 0; link < motion.avatar.numLinks(); ++link) {
      const LinkState state = still.stateAt(link, 0.0);
      for (const Lss& lss : motion.avatar.lss(link)) {
        const double axis = std::min(state.pointAt(lss.a).y(), state.pointAt(lss.b).y());
        lowest = std::min(lowest, axis - lss.radius);
      }
    }
    EXPECT_GT(lowest, 0.008) << "frame " << f;
    EXPECT_LT(lowest, 0.35) << "frame " << f;  // leaps included
  }
}

/// What the steps of the clip at 10 Hz meet in the room.
struct Tally {
  int steps = 0, stepsWithContact = 0, contacts = 0, missedByPoses = 0, starts = 0;
  std::set<LinkId> touched;
};

Tally tallyOf(const ExampleMotion& motion, const Scene& scene) {
  Tally tally;
  Scratch scratch;
  const Query query = Query::build(motion.avatar, scene).value();
  for (std::size_t f = 0; f + kFramesAStep < motion.poses.size(); f += kFramesAStep) {
    const ChainMotion step(motion.avatar.skeleton(), motion.poses[f],
                           motion.poses[f + kFramesAStep]);
    const StepContacts answer = query.answer(step, scratch);
    bool any = false;
    for (const LinkContact& link : answer.links) {
      any = any || link.verdict != Verdict::Clear;
      tally.starts += link.verdict == Verdict::StartsInContact ? 1 : 0;
      if (link.verdict == Verdict::Contact) {
        const auto touches = [&](double t) { return query.touchesAt(step, link.link, t, scratch); };
        ++tally.contacts;
        tally.missedByPoses += !touches(0.0) && !touches(1.0) ? 1 : 0;
        tally.touched.insert(link.link);
      }
    }
    ++tally.steps;
    tally.stepsWithContact += any ? 1 : 0;
  }
  return tally;
}

TEST(ExampleSteps, AreAnsweredAlikeByEitherCuller) {
  const ExampleMotion motion = ExampleMotion::read();
  const Scene room = Scene::build(readPlainObj(kFolder + "/room.obj")).value();
  ReferenceOptions pointQuery;
  pointQuery.culler = Culler::PointQuery;
  const Query flat = Query::build(motion.avatar, room).value();
  const Query slow = buildReference(motion.avatar, room, {}, pointQuery).value();
  Scratch scratch;
  int contacts = 0;
  for (std::size_t f = 0; f + kFramesAStep < motion.poses.size(); f += kFramesAStep) {
    SCOPED_TRACE(f);
    const ChainMotion step(motion.avatar.skeleton(), motion.poses[f],
                           motion.poses[f + kFramesAStep]);
    const StepContacts expected = flat.answer(step, scratch), got = slow.answer(step, scratch);
    for (std::size_t i = 0; i < expected.links.size(); ++i) {
      const LinkContact &x = expected.links[i], &y = got.links[i];
      EXPECT_EQ(x.verdict, y.verdict);
      EXPECT_EQ(x.toi, y.toi);
      EXPECT_EQ(x.separation, y.separation);
      EXPECT_EQ(x.triangle, y.triangle);
      EXPECT_EQ(x.p_WScene, y.p_WScene);
      EXPECT_EQ(x.p_WLink, y.p_WLink);
      contacts += x.verdict != Verdict::Clear ? 1 : 0;
    }
  }
  EXPECT_GT(contacts, 20);
}

TEST(ExampleSteps, HoldContactsThatNoPoseShows) {
  const ExampleMotion motion = ExampleMotion::read();
  const auto scene = Scene::build(readPlainObj(kFolder + "/room.obj"));
  ASSERT_TRUE(scene.ok());
  const Tally tally = tallyOf(motion, scene.value());
  EXPECT_EQ(tally.steps, 136);
  EXPECT_GE(tally.stepsWithContact, 0.30 * tally.steps);
  EXPECT_LE(tally.stepsWithContact, 0.45 * tally.steps);
  EXPECT_GE(tally.missedByPoses, 0.5 * tally.contacts);  // what a check of the poses alone misses
  EXPECT_LE(tally.starts, tally.contacts);               // few limbs stay inside the furniture
  EXPECT_EQ(tally.touched.size(), static_cast<std::size_t>(motion.avatar.numLinks()));
}

class MakeExample : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("foretouch_make_example_") + test->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static int run(const std::string& argument) {
    return std::system(("\"" FORETOUCH_MAKE_EXAMPLE "\" " + argument).c_str());
  }

  std::filesystem::path folder_;
};

TEST_F(MakeExample, WritesTheSameBytesAgain) {
  ASSERT_EQ(run("\"" + folder_.string() + "\""), 0);
  for (const char* name : {"room.obj", "dancer.bvh", "dancer.avatar.json"}) {
    const std::string first = bytesOf(kFolder + "/" + name);
    EXPECT_FALSE(first.empty()) << name;
    EXPECT_TRUE(first == bytesOf((folder_ / name).string())) << name;
  }
}

TEST_F(MakeExample, FailsWhereItCannotWrite) {
  EXPECT_NE(run("\"" + (folder_ / "absent").string() + "\""), 0);
  EXPECT_NE(run(""), 0);
}

}  // namespace
}  // namespace foretouch
