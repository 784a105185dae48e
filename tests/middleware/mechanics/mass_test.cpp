// Masses against sums over many small cubes, and what no body can have.
#include "middleware/mechanics/mass.h"

#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

Mass unitBall(double kg, double radius) {
  Mass mass;
  mass.kg = kg;
  mass.inertia_B = 0.4 * kg * radius * radius * Eigen::Matrix3d::Identity();
  return mass;
}

/// Of what lies within `radius` of the axis, cube by cube.
Mass ofCubes(const Lss& lss, double density, int cubesPerSide) {
  const Eigen::Vector3d low = lss.a.cwiseMin(lss.b).array() - lss.radius;
  const Eigen::Vector3d side =
      ((lss.a.cwiseMax(lss.b).array() + lss.radius).matrix() - low) / cubesPerSide;
  const Eigen::Vector3d axis = lss.b - lss.a;
  double kg = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int i = 0; i < cubesPerSide; ++i) {
    for (int j = 0; j < cubesPerSide; ++j) {
      for (int k = 0; k < cubesPerSide; ++k) {
        const Eigen::Vector3d x =
            low + side.cwiseProduct(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5));
        const double length2 = axis.squaredNorm();
        const double s =
            length2 > 0.0 ? std::clamp((x - lss.a).dot(axis) / length2, 0.0, 1.0) : 0.0;
        if ((x - lss.a - s * axis).norm() > lss.radius) continue;
        const double piece = density * side.prod();
        kg += piece;
        first += piece * x;
        second += piece * x * x.transpose();
      }
    }
  }
  Mass mass;
  mass.kg = kg;
  mass.center_B = first / kg;
  const Eigen::Matrix3d about = second - kg * mass.center_B * mass.center_B.transpose();
  mass.inertia_B = about.trace() * Eigen::Matrix3d::Identity() - about;
  return mass;
}

TEST(Mass, OfAnLssIsThatOfItsCubes) {
  test::Random random(3);
  for (int i = 0; i < 6; ++i) {
    Lss lss{random.inBox(0.3), random.inBox(0.3), random.uniform(0.05, 0.3)};
    if (i == 0) lss.b = lss.a;
    const Mass mass = massOf(lss, 800.0), cubes = ofCubes(lss, 800.0, 90);
    EXPECT_NEAR(mass.kg, cubes.kg, 0.01 * cubes.kg);
    EXPECT_LT((mass.center_B - cubes.center_B).norm(), 1e-3);
    EXPECT_LT((mass.inertia_B - cubes.inertia_B).norm(), 0.02 * cubes.inertia_B.norm());
    EXPECT_NEAR(mass.kg, 800.0 * volume(lss), 1e-12 * mass.kg);
  }
}

TEST(Mass, OfTwoIsThatOfAllTheirPoints) {
  // The sum about one point, by definition, against the parallel axes.
  test::Random random(4);
  for (int i = 0; i < 100; ++i) {
    Mass one = massOf({random.inBox(1.0), random.inBox(1.0), random.uniform(0.01, 0.3)}, 500.0);
    Mass other = massOf({random.inBox(1.0), random.inBox(1.0), random.uniform(0.01, 0.3)}, 900.0);
    const Mass sum = sumOf(one, other);
    const auto aboutOrigin = [](const Mass& mass) -> Eigen::Matrix3d {
      const Eigen::Vector3d& c = mass.center_B;
      return mass.inertia_B +
             mass.kg * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
    };
    EXPECT_LT((aboutOrigin(sum) - aboutOrigin(one) - aboutOrigin(other)).norm(),
              1e-12 * aboutOrigin(sum).norm());
    EXPECT_LT((sum.kg * sum.center_B - one.kg * one.center_B - other.kg * other.center_B).norm(),
              1e-12 * sum.kg);
    EXPECT_TRUE(checkedMass(sum).ok());
  }
  EXPECT_EQ(sumOf({}, {}).kg, 0.0);
}

TEST(Mass, RefusesWhatNoBodyHas) {
  const auto codeOf = [](const Mass& mass) { return checkedMass(mass).error().code; };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Mass ball = unitBall(2.0, 0.1);
  ASSERT_TRUE(checkedMass(ball).ok());
  Mass bad = ball;
  bad.kg = 0.0;
  EXPECT_EQ(codeOf(bad), ErrorCode::OutOfRange);
  bad.kg = -1.0;
  EXPECT_EQ(codeOf(bad), ErrorCode::OutOfRange);
  bad.kg = nan;
  EXPECT_EQ(codeOf(bad), ErrorCode::NonFinite);
  bad = ball;
  bad.center_B.y() = nan;
  EXPECT_EQ(codeOf(bad), ErrorCode::NonFinite);
  bad = ball;
  bad.inertia_B(0, 2) += 0.1 * ball.inertia_B(0, 0);
  EXPECT_EQ(codeOf(bad), ErrorCode::OutOfRange);
  bad = ball;
  bad.inertia_B(1, 1) *= -1.0;
  EXPECT_EQ(codeOf(bad), ErrorCode::OutOfRange);
  bad = ball;
  bad.inertia_B(1, 1) *= 2.1;
  EXPECT_EQ(codeOf(bad), ErrorCode::OutOfRange);
}

TEST(Mass, OfLinksIsAllThatTheAvatarWeighs) {
  RawSkeleton raw;
  raw.joints.push_back({"root", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()});
  raw.joints.push_back({"empty", 0, Eigen::Vector3d::UnitX(), Quaternion::Identity()});
  raw.joints.push_back({"hand", 1, Eigen::Vector3d::UnitX(), Quaternion::Identity()});
  const Lss arm{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), 0.05};
  const auto build = [&](std::vector<std::vector<Lss>> lss) {
    return Avatar::build(Skeleton::build(raw).value(), std::move(lss)).value();
  };
  const auto masses = massesOfLinks(build({{arm, arm}, {}, {arm}}), 9.0).value();
  EXPECT_NEAR(masses[0].kg, 6.0, 1e-12);
  EXPECT_EQ(masses[1].kg, 0.0);
  EXPECT_NEAR(masses[2].kg, 3.0, 1e-12);
  EXPECT_LT((masses[2].center_B - Eigen::Vector3d(0.5, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(massesOfLinks(build({{arm}, {}, {}}), 0.0).error().code, ErrorCode::OutOfRange);
  Lss line = arm;
  line.radius = 0.0;
  EXPECT_EQ(massesOfLinks(build({{line}, {}, {}}), 9.0).error().code, ErrorCode::Empty);
}

TEST(InverseMass, OfARigidBodyIsThatOfNewtonAndEuler) {
  test::Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Mass mass =
        massOf({random.inBox(1.0), random.inBox(1.0), random.uniform(0.01, 0.3)}, 700.0);
    const RigidPose pose{random.rotation(), random.inBox(5.0)};
    const Eigen::Vector3d p = pose.translation + random.inBox(1.0), J = random.inBox(3.0);
    const Eigen::Matrix3d R = pose.rotation.toRotationMatrix();
    const Eigen::Vector3d r = p - (pose.translation + R * mass.center_B);
    const Eigen::Vector3d spin = (R * mass.inertia_B * R.transpose()).fullPivLu().solve(r.cross(J));
    const Eigen::Vector3d expected = J / mass.kg + spin.cross(r);
    const Eigen::Matrix3d K = inverseMassAt(mass, pose, p);
    EXPECT_LT((K * J - expected).norm(), 1e-9 * expected.norm());
    EXPECT_EQ(K, K.transpose());
  }
}

}  // namespace
}  // namespace foretouch
