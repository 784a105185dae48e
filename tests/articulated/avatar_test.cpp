#include "articulated/avatar.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

Skeleton twoJoints() {
  RawSkeleton raw;
  raw.joints.resize(2);
  raw.joints[0].name = "a";
  raw.joints[1].name = "b";
  raw.joints[1].parent = 0;
  return Skeleton::build(raw).value();
}

Lss unitLss() {
  return {Eigen::Vector3d::Zero(), Eigen::Vector3d(0, 1, 0), 0.1};
}

using LssLists = std::vector<std::vector<Lss>>;

void expectRefusal(LssLists lss, std::vector<MeshReference> meshes, ErrorCode code,
                   std::int64_t index) {
  const auto avatar = Avatar::build(twoJoints(), std::move(lss), std::move(meshes));
  ASSERT_FALSE(avatar.ok());
  EXPECT_STREQ(toString(avatar.error().code), toString(code)) << avatar.error().message;
  EXPECT_EQ(avatar.error().index, index) << avatar.error().message;
}

TEST(AvatarBuild, KeepsLssAndMeshes) {
  const auto avatar =
      Avatar::build(twoJoints(), {{}, {unitLss(), unitLss()}}, {{}, {"body.glb", "Arm"}});
  ASSERT_TRUE(avatar.ok());
  EXPECT_EQ(avatar.value().numLinks(), 2);
  EXPECT_EQ(avatar.value().numLss(), 2);
  EXPECT_TRUE(avatar.value().lss(0).empty());
  EXPECT_EQ(avatar.value().lss(1)[0].radius, 0.1);
  EXPECT_TRUE(avatar.value().mesh(0).file.empty());
  EXPECT_EQ(avatar.value().mesh(1).node, "Arm");
}

TEST(AvatarBuild, AllowsPointsSegmentsAndSpheres) {
  const Lss point;
  EXPECT_TRUE(Avatar::build(twoJoints(), {{point}, {}}).ok());
}

TEST(AvatarBuild, RefusesCountsThatDoNotFit) {
  expectRefusal({{unitLss()}}, {}, ErrorCode::Mismatch, -1);
  expectRefusal({{unitLss()}, {}, {}}, {}, ErrorCode::Mismatch, -1);
  expectRefusal({{unitLss()}, {}}, {{}}, ErrorCode::Mismatch, -1);
  expectRefusal({{}, std::vector<Lss>(kMaxLssPerLink + 1, unitLss())}, {}, ErrorCode::LimitExceeded,
                1);
  EXPECT_TRUE(Avatar::build(twoJoints(), {{}, std::vector<Lss>(kMaxLssPerLink, unitLss())}).ok());
}

TEST(AvatarBuild, RefusesAnAvatarWithoutLss) {
  expectRefusal({{}, {}}, {}, ErrorCode::Empty, -1);
}

TEST(AvatarBuild, RefusesNumbersOutOfRangeAndNamesTheLink) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Lss lss = unitLss();
    lss.a.y() = bad;
    expectRefusal({{}, {lss}}, {}, ErrorCode::NonFinite, 1);
    lss = unitLss();
    lss.b.z() = bad;
    expectRefusal({{unitLss()}, {unitLss(), lss}}, {}, ErrorCode::NonFinite, 1);
    lss = unitLss();
    lss.radius = bad;
    expectRefusal({{lss}, {}}, {}, ErrorCode::NonFinite, 0);
  }
  Lss lss = unitLss();
  lss.radius = -1e-300;
  expectRefusal({{lss}, {}}, {}, ErrorCode::NonFinite, 0);
  lss.radius = 2 * kMaxCoordinate;
  expectRefusal({{lss}, {}}, {}, ErrorCode::OutOfRange, 0);
  lss = unitLss();
  lss.a.x() = -2 * kMaxCoordinate;
  expectRefusal({{}, {lss}}, {}, ErrorCode::OutOfRange, 1);
}

TEST(AvatarBuild, RefusesMeshReferencesThatAreNone) {
  const LssLists lss = {{unitLss()}, {}};
  expectRefusal(lss, {{}, {"", "Arm"}}, ErrorCode::Empty, 1);
  expectRefusal(lss, {{"body\n.glb", "Arm"}, {}}, ErrorCode::Syntax, 0);
  expectRefusal(lss, {{"body.glb", "\xff"}, {}}, ErrorCode::Syntax, 0);
  EXPECT_TRUE(Avatar::build(twoJoints(), lss, {{"body.glb", ""}, {}}).ok());
}

TEST(AvatarGrownBy, NeverRoundsARadiusBelowTheExactSum) {
  int inexact = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    test::Random random(seed);
    Lss lss = unitLss();
    lss.radius = seed % 10 == 0 ? 0.0 : random.magnitude(1e-12, 10.0);
    const double growth = seed % 7 == 0 ? 0.0 : random.magnitude(1e-16, 1.0);
    const Avatar thin = Avatar::build(twoJoints(), {{}, {lss}}, {{}, {"body.glb", "Arm"}}).value();
    const Avatar grown = thin.grownBy(growth).value();
    const double radius = grown.lss(1)[0].radius;
    // Knuth's sum: nearest + error is the exact sum.
    const double nearest = lss.radius + growth, part = nearest - lss.radius;
    const double error = (lss.radius - (nearest - part)) + (growth - part);
    EXPECT_TRUE(radius > nearest || (radius == nearest && error <= 0.0)) << seed;
    EXPECT_LE(radius, nearest * (1.0 + 2e-12)) << seed;
    inexact += error > 0.0;
    EXPECT_EQ(grown.lss(1)[0].b, lss.b);
    EXPECT_TRUE(grown.mesh(1).file.empty());
    EXPECT_NE(grown.identity(), thin.identity());
  }
  EXPECT_GT(inexact, 500) << "the nearest double would be too small";
  const Avatar avatar = Avatar::build(twoJoints(), {{}, {unitLss()}}).value();
  EXPECT_EQ(avatar.grownBy(2 * kMaxCoordinate).error().index, 1);
}

}  // namespace
}  // namespace foretouch
