#include "bench/rigid_comparison.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"
#include "tests/tools/small_inputs.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

// An upper arm of one metre without a surface turns by a quarter about Z, and carries a forearm
// that points outward from 1 m to 1.5 m. The true forearm keeps its distance from the origin. The
// rigid model moves it along the chord: at half time, from 0.707 m to 1.207 m.
class RigidComparisonOfAnArm : public testing::Test {
 protected:
  static Avatar arm() {
    RawSkeleton raw;
    raw.joints.push_back({"Upper", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
    raw.joints.push_back({"Fore", 0, Vector3d(1, 0, 0), Quaternion::Identity()});
    return Avatar::build(Skeleton::build(raw).value(),
                         {{}, {Lss{Vector3d::Zero(), Vector3d(0.5, 0, 0), 0.02}}})
        .value();
  }

  static RigidCounts compare(RawScene raw) {
    const Avatar avatar = arm();
    const Pose from = restPose(avatar.skeleton());
    Pose to = from;
    to.rotations[0] = Quaternion(std::sqrt(0.5), 0, 0, std::sqrt(0.5));
    const ChainMotion motion(avatar.skeleton(), from, to);
    const Scene scene = Scene::build(std::move(raw)).value();
    const auto truth = firstContacts(avatar, motion, scene);
    Scratch scratch;
    return RigidComparison::build(avatar, scene, {})
        .value()
        .compare(motion, truth.value(), scratch)
        .value();
  }

  /// A small triangle in the plane z = 0 at a distance from the origin, 45 degrees up.
  static RawScene speckAt(double distance) {
    const Vector3d p = distance * std::sqrt(0.5) * Vector3d(1, 1, 0);
    return {{Triangle{{p, p + Vector3d(1e-3, 0, 0), p + Vector3d(0, 1e-3, 0)}}}, {0}, {"speck"}};
  }
};

TEST_F(RigidComparisonOfAnArm, CountsWhatOnlyTheArcMeetsAsMissed) {
  const RigidCounts counts = compare(speckAt(1.4));
  EXPECT_EQ(counts.contacts, 1);
  EXPECT_EQ(counts.missed, 1);
  EXPECT_EQ(counts.late + counts.early + counts.falseContacts + counts.undecided, 0);
}

TEST_F(RigidComparisonOfAnArm, CountsWhatOnlyTheChordMeetsAsFalse) {
  const RigidCounts counts = compare(speckAt(0.75));
  EXPECT_EQ(counts.contacts, 0);
  EXPECT_EQ(counts.falseContacts, 1);
}

TEST_F(RigidComparisonOfAnArm, CountsLateContacts) {
  // The ceiling y = 0.8: the tip is there at 1.5 sin(90 t) = 0.78, t = 0.35; in the rigid model at
  // t + 0.5 sin(90 t) = 0.78, t = 0.45.
  RawScene ceiling;
  ceiling.triangles = {
      Triangle{{Vector3d(-9, 0.8, -9), Vector3d(9, 0.8, -9), Vector3d(0, 0.8, 9)}}};
  ceiling.objectOf = {0};
  ceiling.objectNames = {"ceiling"};
  const RigidCounts counts = compare(ceiling);
  EXPECT_EQ(counts.contacts, 1);
  EXPECT_EQ(counts.late, 1);
  EXPECT_EQ(counts.missed + counts.early, 0);
}

TEST_F(RigidComparisonOfAnArm, CountsEarlyContacts) {
  // The wall x = 0.5: the elbow is there at cos(90 t) = 0.52; in the rigid model at 1 - t = 0.52.
  const RigidCounts counts = compare(test::wallAt(0.5, "wall"));
  EXPECT_EQ(counts.contacts, 1);
  EXPECT_EQ(counts.early, 1);
  EXPECT_EQ(counts.missed + counts.late, 0);
}

TEST(RigidComparison, AgreesWhereALinkIsARigidBody) {
  RawSkeleton raw;
  raw.joints.push_back({"Body", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
  const Avatar body =
      Avatar::build(Skeleton::build(raw).value(), {{Lss{{-0.2, 0, 0}, {0.3, 0.1, 0}, 0.05}}})
          .value();
  const Scene scene = Scene::build(test::wallAt(0.0, "wall")).value();
  const RigidComparison comparison = RigidComparison::build(body, scene, {}).value();
  Scratch scratch;
  RigidCounts counts;
  constexpr int kCases = 300;
  for (int i = 0; i < kCases; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    Pose from{{random.rotation()}, {Vector3d(-1, 0, 0) + random.inBox(0.4)}};
    Pose to{{random.rotation()}, {random.inBox(1.2)}};
    from = validatedPose(body.skeleton(), from).value();
    to = validatedPose(body.skeleton(), to).value();
    const ChainMotion motion(body.skeleton(), from, to);
    const auto truth = firstContacts(body, motion, scene);
    counts.add(comparison.compare(motion, truth.value(), scratch).value());
  }
  EXPECT_GT(counts.contacts, kCases / 4);
  EXPECT_LT(counts.contacts, kCases * 9 / 10);
  EXPECT_EQ(counts.missed + counts.late + counts.early + counts.falseContacts + counts.undecided,
            0);
}

}  // namespace
}  // namespace foretouch::tools
