// LSS that hold the same triangles, at exact fidelity: the triangles are the surface, whatever
// holds them; an LSS that contains none is a surface of its own.
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "judge/judge.h"
#include "lss/index.h"
#include "lss/simd.h"
#include "middleware/query/query.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/reference/reference_query.h"
#include "tests/support/asked.h"
#include "tests/support/judged_answer.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

/// A link that moves 0.3 m upwards, to 0.05 m below a plane.
struct Riser {
  static constexpr double kPlane = 0.35;

  explicit Riser(std::vector<Lss> lss) {
    RawSkeleton raw;
    raw.joints = {{"link", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
    avatar = Avatar::build(Skeleton::build(raw).value(), {std::move(lss)}).value();
    RawScene scene;
    scene.triangles = {
        {{Vector3d(-9, -9, kPlane), Vector3d(9, -9, kPlane), Vector3d(0, 9, kPlane)}}};
    scene.objectOf = {0};
    scene.objectNames = {"plane"};
    plane = Scene::build(std::move(scene)).value();
  }

  /// With one triangle of 1 cm at the link's origin.
  [[nodiscard]] LinkContact answer(Backtracking backtracking = Backtracking::Lanes) const {
    const Triangle flat{{Vector3d(0, 0, 0), Vector3d(0.01, 0, 0), Vector3d(0, 0.01, 0)}};
    QueryOptions options;
    options.fidelity = Fidelity::Exact;
    options.surface = AvatarSurface::build(*avatar, {{flat}}).value();
    ReferenceOptions reference;
    reference.backtracking = backtracking;
    const Pose from = restPose(avatar->skeleton());
    Pose to = from;
    to.translations[0].z() += 0.3;
    Scratch scratch;
    const ChainMotion motion(avatar->skeleton(), from, to);
    return test::answerOf(*avatar, motion, *plane, options, reference, scratch).links[0];
  }

  std::optional<Avatar> avatar;
  std::optional<Scene> plane;
};

const Lss kHolder{Vector3d::Zero(), Vector3d(0, 0.2, 0), 0.1};

TEST(TwinLss, ATriangleHeldTwiceIsStillTheSurface) {
  Lss wider = kHolder, thinner = kHolder;
  wider.radius *= 1.2;
  thinner.radius *= 0.7;
  const std::vector<std::vector<Lss>> holders = {{kHolder},
                                                 {kHolder, kHolder},
                                                 {kHolder, wider},
                                                 {wider, kHolder},
                                                 {thinner, kHolder, thinner},
                                                 {wider, thinner, kHolder},
                                                 {kHolder, thinner, wider}};
  for (std::size_t i = 0; i < holders.size(); ++i) {
    SCOPED_TRACE(i);
    for (const auto backtracking : {Backtracking::Lanes, Backtracking::Scalar}) {
      EXPECT_EQ(Riser(holders[i]).answer(backtracking).verdict, Verdict::Clear);
    }
  }
}

TEST(TwinLss, AnLssThatContainsNoTriangleIsASurface) {
  Lss beside = kHolder;
  beside.a.x() = beside.b.x() = 1.0;
  // It holds two corners of the triangle and not the third.
  const Lss across{Vector3d(0, -0.095, 0), Vector3d(0, -0.095, 0), 0.1};
  for (const Lss& lone : {beside, across}) {
    for (const auto backtracking : {Backtracking::Lanes, Backtracking::Scalar}) {
      for (const bool isFirst : {false, true}) {
        const Riser riser(isFirst ? std::vector<Lss>{lone, kHolder} : std::vector{kHolder, lone});
        const LinkContact got = riser.answer(backtracking);
        ASSERT_EQ(got.verdict, Verdict::Contact);
        EXPECT_LE(got.toi, 0.25 / 0.3);
        EXPECT_GT(got.toi, 0.25 / 0.3 - 0.01);
        EXPECT_EQ(got.lss, isFirst ? 0 : 1);
        EXPECT_EQ(got.linkTriangle, -1);
      }
    }
  }
}

class TwinsInClutter : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

// The judge is told of triangles alone, for every LSS here contains some.
TEST_P(TwinsInClutter, ProvesEveryAnswer) {
  int clear = 0, contacts = 0, starts = 0;
  Scratch scratch;
  for (int i = 0; i < 60; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const test::RandomBody body = test::bodyInClutter(random, 6, Vector3d::Zero());
    const auto meshes = test::meshWithin(body.avatar, random, 1 + random.below(30), 0.9);
    const Avatar avatar = test::withTwins(body.avatar, random, 1.0);
    const Scene scene = Scene::build(test::clutter(random, 600, 5, Vector3d::Zero())).value();
    std::vector<oracle::Triangle> triangles;
    for (std::size_t k = 0; k < scene.numTriangles(); ++k) {
      triangles.push_back(test::plain(scene.triangle(static_cast<TriangleId>(k))));
    }
    const oracle::Scene judged(std::move(triangles));
    const oracle::Motion truth(test::plainJoints(avatar.skeleton(), body.from, body.to));
    QueryOptions options;
    options.tolerance = random.magnitude(1e-6, 1e-2);
    options.fidelity = Fidelity::Exact;
    options.surface = AvatarSurface::build(avatar, meshes).value();
    const StepContacts step = test::answerOf(avatar, body.motion(), scene, options, scratch);
    for (const LinkContact& got : step.links) {
      std::vector<oracle::Triangle> mesh;
      for (const Triangle& one : meshes[slotOf(got.link)]) mesh.push_back(test::plain(one));
      if (mesh.empty()) continue;
      oracle::Judge judge(judged, truth, got.link, mesh);
      const auto judgement = judge.judge(test::plain(got), options.tolerance);
      EXPECT_EQ(judgement.finding, oracle::Finding::Ok)
          << "case " << i << " link " << got.link << " eps " << options.tolerance << ": "
          << toString(judgement.finding) << ' ' << judgement.what;
      clear += got.verdict == Verdict::Clear ? 1 : 0;
      contacts += got.verdict == Verdict::Contact ? 1 : 0;
      starts += got.verdict == Verdict::StartsInContact ? 1 : 0;
    }
  }
  EXPECT_GT(clear, 40);
  EXPECT_GT(contacts, 15);
  EXPECT_GT(starts, 5);
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, TwinsInClutter, testing::ValuesIn(supportedSimd()),
                         [](const testing::TestParamInfo<Simd>& simd) {
                           return std::string(toString(simd.param));
                         });

}  // namespace
}  // namespace foretouch
