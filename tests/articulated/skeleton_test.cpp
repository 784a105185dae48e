#include "articulated/skeleton.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace foretouch {
namespace {

RawJoint joint(const std::string& name, JointId parent) {
  RawJoint raw;
  raw.name = name;
  raw.parent = parent;
  raw.offset = Eigen::Vector3d(0, 1, 0);
  return raw;
}

RawSkeleton threeJoints() {
  return {{joint("a", kNoParent), joint("b", 0), joint("c", 1)}};
}

void expectRefusal(const RawSkeleton& raw, ErrorCode code, std::int64_t index) {
  const auto skeleton = Skeleton::build(raw);
  ASSERT_FALSE(skeleton.ok());
  EXPECT_STREQ(toString(skeleton.error().code), toString(code)) << skeleton.error().message;
  EXPECT_EQ(skeleton.error().index, index) << skeleton.error().message;
}

TEST(SkeletonBuild, KeepsWhatItWasGiven) {
  const auto skeleton = Skeleton::build(threeJoints());
  ASSERT_TRUE(skeleton.ok());
  EXPECT_EQ(skeleton.value().numJoints(), 3);
  EXPECT_EQ(skeleton.value().name(2), "c");
  EXPECT_EQ(skeleton.value().parent(2), 1);
  for (JointId j = 0; j < skeleton.value().numJoints(); ++j) {
    EXPECT_EQ(skeleton.value().parents().at(static_cast<std::size_t>(j)),
              skeleton.value().parent(j));
  }
  EXPECT_EQ(skeleton.value().restOffset(1), Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(skeleton.value().find("b"), JointId{1});
  EXPECT_EQ(skeleton.value().find("d"), std::nullopt);
}

TEST(SkeletonBuild, AllowsSeveralRoots) {
  EXPECT_TRUE(Skeleton::build({{joint("a", kNoParent), joint("b", kNoParent)}}).ok());
}

TEST(SkeletonBuild, RefusesNoJoints) {
  expectRefusal({}, ErrorCode::Empty, -1);
}

TEST(SkeletonBuild, RefusesParentsThatAreNotEarlier) {
  for (const JointId parent : {2, 3, 100, -2, std::numeric_limits<JointId>::min()}) {
    RawSkeleton raw = threeJoints();
    raw.joints[2].parent = parent;
    expectRefusal(raw, ErrorCode::BadHierarchy, 2);
  }
}

TEST(SkeletonBuild, RefusesNamesThatAreNone) {
  const auto named = [](const std::string& name) {
    RawSkeleton raw = threeJoints();
    raw.joints[1].name = name;
    return raw;
  };
  expectRefusal(named(""), ErrorCode::Empty, 1);
  expectRefusal(named("a"), ErrorCode::DuplicateName, 1);
  expectRefusal(named("x\ny"), ErrorCode::Syntax, 1);
  expectRefusal(named("x\x7f"), ErrorCode::Syntax, 1);
  expectRefusal(named("x\xc2\x85"), ErrorCode::Syntax, 1);
  expectRefusal(named("x\xff"), ErrorCode::Syntax, 1);
  expectRefusal(named(std::string(kMaxNameBytes + 1, 'x')), ErrorCode::Syntax, 1);
  EXPECT_TRUE(Skeleton::build(named(std::string(kMaxNameBytes, 'x'))).ok());
  EXPECT_TRUE(Skeleton::build(named("\xc3\xa0 \xe6\x89\x8b:#2")).ok());
}

TEST(SkeletonBuild, RefusesNumbersOutOfRange) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    RawSkeleton raw = threeJoints();
    raw.joints[1].offset.y() = bad;
    expectRefusal(raw, ErrorCode::NonFinite, 1);
    raw = threeJoints();
    raw.joints[2].rotation.z() = bad;
    expectRefusal(raw, ErrorCode::NonFinite, 2);
  }
  RawSkeleton raw = threeJoints();
  raw.joints[1].offset.x() = -kMaxCoordinate;
  EXPECT_TRUE(Skeleton::build(raw).ok());
  raw.joints[1].offset.x() = std::nextafter(-kMaxCoordinate, -HUGE_VAL);
  expectRefusal(raw, ErrorCode::OutOfRange, 1);
  for (const double norm : {0.0, 0.99, 1.01, 1e200}) {
    raw = threeJoints();
    raw.joints[1].rotation.w() = norm;
    expectRefusal(raw, ErrorCode::OutOfRange, 1);
  }
}

TEST(SkeletonBuild, BoundsJointsAndDepth) {
  RawSkeleton chain;
  for (JointId j = 0; j < kMaxChainDepth; ++j)
    chain.joints.push_back(joint("j" + std::to_string(j), j - 1));
  EXPECT_TRUE(Skeleton::build(chain).ok());
  chain.joints.push_back(joint("last", kMaxChainDepth - 1));
  expectRefusal(chain, ErrorCode::LimitExceeded, kMaxChainDepth);

  RawSkeleton wide;
  for (JointId j = 0; j < kMaxJoints; ++j)
    wide.joints.push_back(joint("j" + std::to_string(j), j == 0 ? -1 : 0));
  EXPECT_TRUE(Skeleton::build(wide).ok());
  wide.joints.push_back(joint("last", 0));
  expectRefusal(wide, ErrorCode::LimitExceeded, kMaxJoints);
}

TEST(SkeletonBuild, MakesRotationsUnit) {
  RawSkeleton raw = threeJoints();
  raw.joints[1].rotation = Quaternion(0.7071, 0.7071, 0, 0);  // six digits are what files have
  const auto skeleton = Skeleton::build(raw);
  ASSERT_TRUE(skeleton.ok());
  EXPECT_NEAR(skeleton.value().restRotation(1).norm(), 1.0, 1e-15);
  EXPECT_NEAR(skeleton.value().restRotation(1).w(), std::sqrt(0.5), 1e-15);
}

TEST(UnitQuaternion, TwiceIsOnce) {
  int changed = 0;
  for (int seed = 0; seed < 20000; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::normal_distribution<> normal;
    Quaternion q(normal(random), normal(random), normal(random), normal(random));
    const double scale =
        (1.0 + 1e-3 * std::uniform_real_distribution<>(-0.9, 0.9)(random)) / q.norm();
    q.coeffs() *= scale;
    const auto once = unitQuaternion(q);
    ASSERT_TRUE(once);
    const auto twice = unitQuaternion(*once);
    ASSERT_TRUE(twice);
    EXPECT_EQ(once->coeffs(), twice->coeffs()) << "seed " << seed;
    EXPECT_NEAR(once->norm(), 1.0, 1e-15);
    changed += once->coeffs() != q.coeffs() ? 1 : 0;
  }
  EXPECT_GT(changed, 19000);  // the sample is not unit already
}

TEST(UnitQuaternion, RefusesWhatIsFarFromUnit) {
  EXPECT_FALSE(unitQuaternion(Quaternion(0, 0, 0, 0)));
  EXPECT_FALSE(unitQuaternion(Quaternion(1.0011, 0, 0, 0)));
  EXPECT_FALSE(unitQuaternion(Quaternion(std::nan(""), 0, 0, 1)));
  EXPECT_TRUE(unitQuaternion(Quaternion(1.0009, 0, 0, 0)));
}

}  // namespace
}  // namespace foretouch
