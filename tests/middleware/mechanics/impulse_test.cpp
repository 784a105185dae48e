// Impulses: the textbook's cases, and the laws on a million draws.
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "middleware/mechanics/mass.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

Mass ball(double kg, double radius) {
  Mass mass;
  mass.kg = kg;
  mass.inertia_B = 0.4 * kg * radius * radius * Eigen::Matrix3d::Identity();
  return mass;
}

TEST(Impulse, OfTwoBallsIsNewtons) {
  // 2 kg at 3 m/s into 1 kg at rest, head on.
  CollisionPoint point;
  point.nhat_BA_W = -Eigen::Vector3d::UnitX();
  point.velocity_W = 3.0 * Eigen::Vector3d::UnitX();
  point.inverseMass_W = (0.5 + 1.0) * Eigen::Matrix3d::Identity();
  EXPECT_DOUBLE_EQ(effectiveMass(point), 2.0 / 3.0);
  EXPECT_NEAR(collisionImpulse(point, {0.0, 0.0}).onA_W.x(), -2.0, 1e-12);
  const CollisionImpulse elastic = collisionImpulse(point, {1.0, 0.0});
  EXPECT_NEAR(elastic.onA_W.x(), -4.0, 1e-12);
  EXPECT_NEAR(elastic.applied.restitution, 1.0, 1e-12);
  // Velocities afterwards: 1 and 4.
  EXPECT_NEAR(3.0 + elastic.onA_W.x() / 2.0, 1.0, 1e-12);
  EXPECT_NEAR(-elastic.onA_W.x() / 1.0, 4.0, 1e-12);
}

TEST(Impulse, OfABallOnTheFloorRollsOrSlides) {
  // A ball that falls at 2 m/s and flies at 1 m/s: K across is 1/m + r^2/I = 3.5/m.
  constexpr double kRadius = 0.1;
  CollisionPoint point;
  point.velocity_W = {1.0, -2.0, 0.0};
  point.inverseMass_W = inverseMassAt(ball(1.0, kRadius), {}, {0.0, -kRadius, 0.0});
  const CollisionImpulse sticks = collisionImpulse(point, {0.0, 0.5});
  EXPECT_TRUE(sticks.sticks);
  EXPECT_NEAR(sticks.onA_W.y(), 2.0, 1e-12);
  EXPECT_NEAR(sticks.onA_W.x(), -1.0 / 3.5, 1e-12);
  const CollisionImpulse slides = collisionImpulse(point, {0.0, 0.1});
  EXPECT_FALSE(slides.sticks);
  EXPECT_NEAR(slides.onA_W.y(), 2.0, 1e-12);
  EXPECT_NEAR(slides.onA_W.x(), -0.2, 1e-12);
}

TEST(Impulse, IsNoneWhereNothingCollides) {
  CollisionPoint point;
  point.velocity_W = Eigen::Vector3d::UnitY();
  EXPECT_TRUE(collisionImpulse(point, {}).onA_W.isZero(0.0));
  point.velocity_W = Eigen::Vector3d::UnitX();
  EXPECT_TRUE(collisionImpulse(point, {}).onA_W.isZero(0.0));
  point.velocity_W = -Eigen::Vector3d::UnitY();
  EXPECT_FALSE(collisionImpulse(point, {}).onA_W.isZero(0.0));
  CollisionPoint rigid = point;
  rigid.inverseMass_W.setZero();
  EXPECT_TRUE(std::isinf(effectiveMass(rigid)));
  EXPECT_TRUE(collisionImpulse(rigid, {}).onA_W.isZero(0.0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(collisionImpulse(point, {nan, 0.5}).onA_W.isZero(0.0));
  EXPECT_TRUE(collisionImpulse(point, {0.5, nan}).onA_W.isZero(0.0));
  point.velocity_W.z() = nan;
  EXPECT_TRUE(collisionImpulse(point, {}).onA_W.isZero(0.0));
  point.velocity_W.z() = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(collisionImpulse(point, {}).onA_W.isZero(0.0));
}

/// Two bodies that collide at a point, each with its own motion.
struct Crash {
  Mass mass[2];
  RigidPose pose[2];
  Eigen::Vector3d v[2], w[2], p;  // of the centre; about it; the point
  bool isHeld;                    // b is led, nothing moves it
  CollisionPoint point;

  explicit Crash(test::Random& random) : p(random.inBox(2.0)), isHeld(random.chance(0.3)) {
    for (int i = 0; i < 2; ++i) {
      mass[i] = massOf({random.inBox(0.5), random.inBox(0.5), random.magnitude(1e-3, 0.3)},
                       random.magnitude(10.0, 5000.0));
      pose[i] = {random.rotation(), p + random.inBox(0.5)};
      v[i] = random.magnitude(1e-3, 30.0) * random.direction();
      w[i] = random.magnitude(1e-3, 30.0) * random.direction();
    }
    point.nhat_BA_W = random.direction();
    point.velocity_W = velocity(0) - velocity(1);
    point.inverseMass_W = inverseMassAt(mass[0], pose[0], p);
    if (!isHeld) point.inverseMass_W += inverseMassAt(mass[1], pose[1], p);
  }
  [[nodiscard]] Eigen::Vector3d arm(int i) const {
    return p - (pose[i].translation + pose[i].rotation * mass[i].center_B);
  }
  [[nodiscard]] Eigen::Vector3d velocity(int i) const { return v[i] + w[i].cross(arm(i)); }
  [[nodiscard]] Eigen::Matrix3d inertia(int i) const {
    const Eigen::Matrix3d R = pose[i].rotation.toRotationMatrix();
    return R * mass[i].inertia_B * R.transpose();
  }
  /// In the frame of b's point if b is led: what a does against it.
  [[nodiscard]] double energy() const {
    double sum = 0.0;
    for (int i = 0; i < (isHeld ? 1 : 2); ++i) {
      const Eigen::Vector3d seen = isHeld ? Eigen::Vector3d(v[i] - velocity(1)) : v[i];
      sum += 0.5 * mass[i].kg * seen.squaredNorm() + 0.5 * w[i].dot(inertia(i) * w[i]);
    }
    return sum;
  }
  /// Linear, and angular about the point, of both.
  [[nodiscard]] Eigen::Matrix<double, 6, 1> momentum() const {
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector3d linear = mass[i].kg * v[i];
      sum.head<3>() += linear;
      sum.tail<3>() += inertia(i) * w[i] - arm(i).cross(linear);
    }
    return sum;
  }
  void apply(const Eigen::Vector3d& onA) {
    for (int i = 0; i < (isHeld ? 1 : 2); ++i) {
      const Eigen::Vector3d J = i == 0 ? onA : Eigen::Vector3d(-onA);
      v[i] += J / mass[i].kg;
      w[i] += inertia(i).ldlt().solve(arm(i).cross(J));
    }
  }
};

TEST(Impulse, KeepsItsLawsOnAMillionDraws) {
  test::Random random(6);
  int slid = 0, stuck = 0, parted = 0, dulled = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    Crash crash(random);
    const ContactMaterial material{random.uniform(0.0, 1.0), random.magnitude(1e-3, 3.0)};
    const Eigen::Vector3d n = crash.point.nhat_BA_W;
    const double before = n.dot(crash.point.velocity_W), energy = crash.energy();
    const CollisionImpulse impulse = collisionImpulse(crash.point, material);
    const Eigen::Vector3d& J = impulse.onA_W;
    if (before >= 0.0) {
      ++parted;
      ASSERT_TRUE(J.isZero(0.0));
      continue;
    }
    ASSERT_FALSE(J.isZero(0.0)) << i;
    const double push = n.dot(J);
    ASSERT_GT(push, 0.0) << i;
    ASSERT_LE((J - push * n).norm(), material.friction * push * (1 + 1e-9)) << i;
    ASSERT_LE(impulse.applied.restitution, material.restitution);
    ASSERT_LE(impulse.applied.friction, material.friction);
    const Eigen::Matrix<double, 6, 1> momentum = crash.momentum();
    double carried = J.norm();
    for (int k = 0; k < 2; ++k) {
      carried += crash.mass[k].kg * crash.v[k].norm() + (crash.inertia(k) * crash.w[k]).norm();
    }
    crash.apply(J);
    if (!crash.isHeld) {
      ASSERT_LE((crash.momentum() - momentum).head<3>().norm(), 1e-12 * carried) << i;
      // The response of a thin body errs by its inertia's condition, up to 1e5 here.
      ASSERT_LE((crash.momentum() - momentum).tail<3>().norm(), 1e-10 * carried) << i;
    }
    const Eigen::Vector3d after = crash.velocity(0) - crash.velocity(1);
    // By how much rounding may move a point: what the impulse does there, in all.
    const double scale =
        crash.point.velocity_W.norm() + crash.point.inverseMass_W.norm() * J.norm();
    ASSERT_NEAR(n.dot(after), -impulse.applied.restitution * before, 1e-10 * scale) << i;
    if (impulse.sticks) {
      ASSERT_LT((after - n.dot(after) * n).norm(), 1e-10 * scale) << i;
    }
    ASSERT_LE(crash.energy(), energy + 1e-10 * (energy + scale * J.norm())) << i;
    (impulse.sticks ? stuck : slid) += 1;
    dulled += impulse.applied.restitution < material.restitution * (1 - 1e-6) ||
              impulse.applied.friction < material.friction * (1 - 1e-6);
  }
  // All that is said above has been tried.
  EXPECT_GT(parted, 100'000);
  EXPECT_GT(slid, 100'000);
  EXPECT_GT(stuck, 30'000);
  EXPECT_GT(dulled, 1'000);
}

TEST(Impulse, IsFoundWherePainleveHasNone) {
  // A thin rod that slides on its tip, leaning: friction turns it into the floor.
  Mass rod = massOf({{0, 0, -0.5}, {0, 0, 0.5}, 0.005}, 1000.0);
  const double lean = 0.7;
  const RigidPose pose{Quaternion(Eigen::AngleAxisd(lean, Eigen::Vector3d::UnitX())),
                       Eigen::Vector3d::Zero()};
  CollisionPoint point;
  point.nhat_BA_W = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d tip = pose.rotation * Eigen::Vector3d(0, 0, 0.5);
  int jammed = 0;
  for (const double side : {-1.0, 1.0}) {
    point.velocity_W = {0.0, -0.1, side};
    point.inverseMass_W = inverseMassAt(rod, pose, tip);
    const ContactMaterial rough{0.3, 4.0};
    const Eigen::Vector3d way = Eigen::Vector3d(0, 1, -rough.friction * side);
    jammed += point.nhat_BA_W.dot(point.inverseMass_W * way) <= 0.0;
    const CollisionImpulse impulse = collisionImpulse(point, rough);
    const Eigen::Vector3d& J = impulse.onA_W;
    EXPECT_GT(J.y(), 0.0);
    EXPECT_LE(J.dot(2.0 * point.velocity_W + point.inverseMass_W * J), 1e-12);
    EXPECT_GT((point.velocity_W + point.inverseMass_W * J).y(), -1e-12);
  }
  EXPECT_EQ(jammed, 1);
}

}  // namespace
}  // namespace foretouch
