// Articulated bodies against the same as dense matrices.
#include <algorithm>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "lss/index.h"
#include "middleware/mechanics/mass.h"
#include "tests/support/random_motion.h"

namespace foretouch {
namespace {

/// A random body in a random pose of its motion, its masses, and the same as a matrix. Unknowns:
/// the root's velocity, then a turn in W per joint.
struct Ragdoll {
  Skeleton skeleton;
  std::vector<Mass> masses;
  std::vector<LinkState> states;
  AvatarMass body;

  static Ragdoll random(test::Random& random) {
    test::RandomMotion motion = test::randomMotion(random, 1 + random.below(24));
    // Far origins cost digits of the states themselves.
    motion.to.translations[0] -= motion.from.translations[0];
    motion.from.translations[0].setZero();
    const auto n = countOf(motion.skeleton.numJoints());
    std::vector<Mass> masses(n);
    for (std::size_t j = 0; j < n; ++j) {
      if (j > 0 && random.chance(0.2)) continue;  // weighs nothing
      masses[j] =
          massOf({random.inBox(0.2), random.inBox(0.2), random.uniform(0.02, 0.15)}, 1000.0);
    }
    std::vector<LinkState> states;
    ChainMotion(motion.skeleton, motion.from, motion.to).statesAt(0.3, states);
    auto body = AvatarMass::build(motion.skeleton, masses).value();
    body.place(states);
    return {motion.skeleton, std::move(masses), std::move(states), std::move(body)};
  }

  [[nodiscard]] Eigen::Index size() const { return 3 + 3 * skeleton.numJoints(); }
  /// Of the link's point x, and of its turn.
  [[nodiscard]] Eigen::MatrixXd jacobian(LinkId link, const Eigen::Vector3d& x) const {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, size());
    J.topLeftCorner<3, 3>().setIdentity();
    for (JointId j = link; j != kNoParent; j = skeleton.parents()[slotOf(j)]) {
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
        J.block<3, 1>(0, 3 + 3 * j + axis) = unit.cross(x - states[slotOf(j)].p_WL);
        J.block<3, 1>(3, 3 + 3 * j + axis) = unit;
      }
    }
    return J;
  }
  [[nodiscard]] Eigen::Vector3d centre(LinkId link) const {
    return states[slotOf(link)].pointAt(masses[slotOf(link)].center_B);
  }
  [[nodiscard]] Eigen::Matrix3d inertia(LinkId link) const {
    const Eigen::Matrix3d& R = states[slotOf(link)].R_WL;
    return R * masses[slotOf(link)].inertia_B * R.transpose();
  }
  [[nodiscard]] Eigen::MatrixXd matrix() const {
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(size(), size());
    for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
      double carried = 0.0;
      for (JointId j = 0; j < skeleton.numJoints(); ++j) {
        JointId above = j;
        while (above > link) above = skeleton.parents()[slotOf(above)];
        if (above == link) carried += masses[slotOf(j)].kg;
      }
      const bool isNone = masses[slotOf(link)].kg == 0.0;
      M.diagonal().segment<3>(3 + 3 * link).array() += isNone ? 1e-12 + 1e-8 * carried : 1e-12;
      const Eigen::MatrixXd J = jacobian(link, centre(link));
      M += masses[slotOf(link)].kg * J.topRows<3>().transpose() * J.topRows<3>();
      M += J.bottomRows<3>().transpose() * inertia(link) * J.bottomRows<3>();
    }
    return M;
  }
  /// One that weighs something.
  [[nodiscard]] LinkId someLink(test::Random& random) const {
    for (;;) {
      const auto link = static_cast<LinkId>(random.below(skeleton.numJoints()));
      if (masses[slotOf(link)].kg > 0.0) return link;
    }
  }
  [[nodiscard]] Eigen::Vector3d pointNear(LinkId link, test::Random& random) const {
    return states[slotOf(link)].p_WL + random.inBox(0.3);
  }
};

class AvatarMassOf : public testing::TestWithParam<int> {};

TEST_P(AvatarMassOf, AnswersImpulsesAsTheMatrixDoes) {
  test::Random random(static_cast<std::uint64_t>(GetParam()));
  const Ragdoll ragdoll = Ragdoll::random(random);
  const LinkId link = ragdoll.someLink(random);
  const LinkId other = ragdoll.someLink(random);
  const Eigen::Vector3d p = ragdoll.pointNear(link, random), q = ragdoll.pointNear(other, random);
  const Eigen::LDLT<Eigen::MatrixXd> solver(ragdoll.matrix());
  const Eigen::MatrixXd J = ragdoll.jacobian(link, p).topRows<3>();
  const Eigen::Matrix3d expected = J * solver.solve(J.transpose());
  const Eigen::Matrix3d found = ragdoll.body.inverseMassAt(link, p);
  EXPECT_LT((found - expected).norm(), 1e-5 * expected.norm());
  EXPECT_EQ(found, found.transpose());
  const Eigen::MatrixXd between = J - ragdoll.jacobian(other, q).topRows<3>();
  const Eigen::Matrix3d expectedBetween = between * solver.solve(between.transpose());
  EXPECT_LT((ragdoll.body.inverseMassBetween(link, p, other, q) - expectedBetween).norm(),
            1e-5 * (expected.norm() + expectedBetween.norm()));
}

TEST_P(AvatarMassOf, KeepsMomentum) {
  test::Random random(static_cast<std::uint64_t>(GetParam()) + 1000);
  const Ragdoll ragdoll = Ragdoll::random(random);
  const LinkId link = ragdoll.someLink(random);
  const Eigen::Vector3d p = ragdoll.pointNear(link, random), J = random.inBox(5.0);
  std::vector<VelocityChange> changes;
  ragdoll.body.respond(link, p, J, changes);
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  double size = J.norm();
  for (LinkId l = 0; l < ragdoll.skeleton.numJoints(); ++l) {
    const VelocityChange& change = changes[slotOf(l)];
    const Eigen::Vector3d c = ragdoll.centre(l) - ragdoll.states[slotOf(l)].p_WL;
    const Eigen::Vector3d v = change.v_WL + change.w_WL.cross(c);
    const double kg = ragdoll.masses[slotOf(l)].kg;
    linear += kg * v;
    angular += kg * (ragdoll.centre(l) - p).cross(v) + ragdoll.inertia(l) * change.w_WL;
    size += kg * v.norm() + (ragdoll.inertia(l) * change.w_WL).norm();
  }
  const bool areAllHeavy = std::all_of(ragdoll.masses.begin(), ragdoll.masses.end(),
                                       [](const Mass& mass) { return mass.kg > 0.0; });
  EXPECT_LT((linear - J).norm(), (areAllHeavy ? 1e-12 : 1e-4) * size);
  // About the point itself the impulse has no moment; 1e-12 kg m2 of each root's turn are none of
  // the body's.
  EXPECT_LT(angular.norm(), (areAllHeavy ? 1e-9 : 1e-4) * size);
  // The point moves as inverseMassAt() says.
  const VelocityChange& at = changes[slotOf(link)];
  const Eigen::Vector3d moved = at.v_WL + at.w_WL.cross(p - ragdoll.states[slotOf(link)].p_WL);
  EXPECT_LT((moved - ragdoll.body.inverseMassAt(link, p) * J).norm(), 1e-4 * moved.norm());
}

TEST_P(AvatarMassOf, LosesEnergyInACollision) {
  test::Random random(static_cast<std::uint64_t>(GetParam()) + 2000);
  const Ragdoll ragdoll = Ragdoll::random(random);
  const LinkId link = ragdoll.someLink(random);
  const Eigen::Vector3d p = ragdoll.pointNear(link, random);
  Eigen::VectorXd rates(ragdoll.size());
  for (Eigen::Index i = 0; i < rates.size(); ++i) rates[i] = random.uniform(-3.0, 3.0);
  const Eigen::MatrixXd M = ragdoll.matrix(), J = ragdoll.jacobian(link, p).topRows<3>();
  CollisionPoint point;
  point.velocity_W = J * rates;
  point.nhat_BA_W = random.direction();
  if (point.nhat_BA_W.dot(point.velocity_W) > 0.0) point.nhat_BA_W *= -1.0;
  point.inverseMass_W = ragdoll.body.inverseMassAt(link, p);
  const ContactMaterial material{random.uniform(0.0, 1.0), random.uniform(0.0, 1.5)};
  const CollisionImpulse impulse = collisionImpulse(point, material);
  const Eigen::VectorXd after = rates + M.ldlt().solve(J.transpose() * impulse.onA_W);
  const double before = rates.dot(M * rates);
  EXPECT_LE(after.dot(M * after), before * (1 + 1e-9));
}

INSTANTIATE_TEST_SUITE_P(Random, AvatarMassOf, testing::Range(0, 200));

TEST(AvatarMass, RefusesWhatCannotBe) {
  test::Random random(9);
  const Skeleton skeleton = test::randomMotion(random, 3).skeleton;
  const Mass ball = massOf({Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.1}, 1000.0);
  EXPECT_TRUE(AvatarMass::build(skeleton, {{}, {}, ball}).ok());
  EXPECT_EQ(AvatarMass::build(skeleton, {ball, ball}).error().code, ErrorCode::Mismatch);
  EXPECT_EQ(AvatarMass::build(skeleton, {{}, {}, {}}).error().code, ErrorCode::Empty);
  Mass bad = ball;
  bad.kg = -1.0;
  const Error error = AvatarMass::build(skeleton, {ball, bad, ball}).error();
  EXPECT_EQ(error.code, ErrorCode::OutOfRange);
  EXPECT_EQ(error.index, 1);
}

}  // namespace
}  // namespace foretouch
