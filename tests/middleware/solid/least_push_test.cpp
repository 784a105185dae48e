// The least change under rows: the conditions of its optimum, and what a projection promises.
#include "middleware/solid/least_push.h"

#include <gtest/gtest.h>

#include "tests/middleware/mechanics/random_tree.h"

namespace foretouch {
namespace {

using internal::ContactRow;
using internal::LeastPush;
using internal::TreeInertia;
using internal::TreePull;
using internal::TreeStep;
using internal::Vector6d;
using internal::wrench;

class LeastPushOf : public testing::TestWithParam<int> {
 protected:
  LeastPushOf() : random_(static_cast<std::uint64_t>(GetParam()) + 5000), tree_(random_, 12) {
    for (JointId j = 0; j < tree_.size(); ++j) {
      tree_.points.push_back({j, tree_.origins[slotOf(j)] + random_.inBox(0.2), 0.3});
    }
    inertia_ = tree_.inertia();
    M_ = tree_.matrix();
  }

  /// Pulled in random directions.
  TreePull pull() {
    const auto n = static_cast<std::size_t>(tree_.size());
    TreePull pull;
    pull.forces.assign(n, Vector6d::Zero());
    pull.torques.assign(n, Eigen::Vector3d::Zero());
    pull.drifts.assign(n, Eigen::Vector3d::Zero());
    for (const auto& point : tree_.points) {
      pull.forces[slotOf(point.link)] += point.weight * wrench(point.x, random_.inBox(0.05));
    }
    return pull;
  }
  std::vector<ContactRow> rows(int count) {
    std::vector<ContactRow> rows;
    for (int i = 0; i < count; ++i) {
      ContactRow row;
      row.link = random_.below(static_cast<int>(tree_.size()));
      row.lss = i;
      row.x = tree_.origins[slotOf(row.link)] + random_.inBox(0.3);
      row.n = random_.direction();
      row.bound = random_.uniform(-0.02, 0.002);
      rows.push_back(row);
    }
    return rows;
  }
  TreeStep free(const TreePull& pull) {
    TreeStep step;
    inertia_.solve(pull.forces, pull.torques, step.turns, step.shifts, step.twists);
    return step;
  }
  Eigen::VectorXd asVector(const TreeStep& step) const {
    Eigen::VectorXd all(6 * tree_.size());
    for (Eigen::Index j = 0; j < tree_.size(); ++j) {
      all.segment<3>(3 * j) = step.turns[static_cast<std::size_t>(j)];
      all.segment<3>(3 * (tree_.size() + j)) = step.shifts[static_cast<std::size_t>(j)];
    }
    return all;
  }
  double normOf(const Eigen::VectorXd& x) const { return std::sqrt(x.dot(M_ * x)); }

  test::Random random_;
  test::RandomTree tree_;
  TreeInertia inertia_;
  Eigen::MatrixXd M_;
};

TEST_P(LeastPushOf, MeetsTheConditionsOfItsOptimum) {
  TreePull pulled = pull();
  for (Eigen::Vector3d& drift : pulled.drifts) drift = random_.inBox(0.02);
  const TreeStep freely = free(pulled);
  std::vector<ContactRow> all = rows(1 + random_.below(20));
  TreeStep step = freely;
  LeastPush push;
  push.begin();
  (void)push.solve(inertia_, pulled, Eigen::Vector3d::Zero(), all, step);
  Eigen::VectorXd held = M_ * (asVector(step) - asVector(freely));
  double largest = 0.0;
  for (const ContactRow& row : all) {
    const Eigen::VectorXd J = tree_.jacobian(row.link, row.x).transpose() * row.n;
    const double slack =
        J.dot(asVector(step)) + row.n.dot(pulled.drifts[slotOf(row.link)]) - row.bound;
    // A row gives way by its compliance, a ten thousandth of what it pushes.
    const double given = 1e-4 * row.push * J.dot(M_.ldlt().solve(J));
    EXPECT_GE(row.push, 0.0);
    EXPECT_GE(slack + given, -2e-8);
    if (row.push > 0.0) {
      EXPECT_NEAR(slack + given, 0.0, 2e-8);
    }
    held -= row.push * J;
    largest = std::max(largest, row.push);
  }
  EXPECT_LT(held.norm(), 1e-8 * (1.0 + largest));
}

TEST_P(LeastPushOf, NeverMovesTwoTargetsFartherApart) {
  const std::vector<ContactRow> all = rows(1 + random_.below(12));
  Eigen::VectorXd free0, held0;
  for (int i = 0; i < 4; ++i) {
    const TreePull pulled = pull();
    TreeStep step = free(pulled);
    const Eigen::VectorXd freely = asVector(step);
    std::vector<ContactRow> own = all;
    LeastPush push;
    push.begin();
    (void)push.solve(inertia_, pulled, Eigen::Vector3d::Zero(), own, step);
    const Eigen::VectorXd held = asVector(step);
    if (i > 0) {
      EXPECT_LE(normOf(held - held0), normOf(freely - free0) * (1.0 + 1e-6) + 1e-7);
    }
    free0 = freely;
    held0 = held;
  }
}

TEST_P(LeastPushOf, GoesOnWithOtherBounds) {
  const TreePull pulled = pull();
  const TreeStep freely = free(pulled);
  std::vector<ContactRow> all = rows(8);
  LeastPush push;
  push.begin();
  TreeStep step = freely;
  (void)push.solve(inertia_, pulled, Eigen::Vector3d::Zero(), all, step);
  for (ContactRow& row : all) row.bias = random_.uniform(0.0, 0.005);
  step = freely;
  (void)push.solve(inertia_, pulled, Eigen::Vector3d::Zero(), all, step);
  LeastPush anew;
  anew.begin();
  TreeStep expected = freely;
  (void)anew.solve(inertia_, pulled, Eigen::Vector3d::Zero(), all, expected);
  EXPECT_LT(normOf(asVector(step) - asVector(expected)), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(RandomTrees, LeastPushOf, testing::Range(0, 40));

TEST(LeastPush, LeavesTheFreeStepWithoutRows) {
  test::Random random(1);
  const test::RandomTree tree(random, 5);
  TreeInertia inertia = tree.inertia();
  TreePull pull;
  pull.forces.assign(5, Vector6d::Ones());
  pull.torques.assign(5, Eigen::Vector3d::Zero());
  pull.drifts.assign(5, Eigen::Vector3d::Zero());
  TreeStep freely;
  inertia.solve(pull.forces, pull.torques, freely.turns, freely.shifts, freely.twists);
  TreeStep step = freely;
  std::vector<ContactRow> none;
  LeastPush push;
  push.begin();
  EXPECT_EQ(push.solve(inertia, pull, Eigen::Vector3d::Zero(), none, step), 0U);
  for (std::size_t j = 0; j < 5; ++j) EXPECT_EQ(step.turns[j], freely.turns[j]);
}

}  // namespace
}  // namespace foretouch
