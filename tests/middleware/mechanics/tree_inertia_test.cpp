// The inertia of a tree against the same as a dense matrix.
#include "middleware/mechanics/tree_inertia.h"

#include <gtest/gtest.h>

#include "tests/middleware/mechanics/random_tree.h"

namespace foretouch {
namespace {

using internal::Twist;
using internal::Vector6d;
using internal::WayPart;
using internal::wrench;

class TreeInertiaOf : public testing::TestWithParam<int> {};

TEST_P(TreeInertiaOf, SolvesAsTheMatrixDoes) {
  test::Random random(static_cast<std::uint64_t>(GetParam()));
  const test::RandomTree tree(random, 1 + random.below(30));
  const auto n = static_cast<std::size_t>(tree.size());
  std::vector<Vector6d> forces(n, Vector6d::Zero());
  std::vector<Eigen::Vector3d> torques(n);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(6 * tree.size());
  for (std::size_t j = 0; j < n; ++j) {
    torques[j] = random.inBox(0.1);
    g.segment<3>(3 * static_cast<Eigen::Index>(j)) += torques[j];
    const Eigen::Vector3d x = random.inBox(1.0), f = random.inBox(1.0);
    forces[j] = wrench(x, f);
    g += tree.jacobian(static_cast<JointId>(j), x).transpose() * f;
  }
  // Of what only the 1e-9 of an empty tree holds, nothing is compared.
  const Eigen::VectorXd expected = tree.matrix().ldlt().solve(g);
  std::vector<Eigen::Vector3d> turns, shifts;
  std::vector<Twist> twists;
  tree.inertia().solve(forces, torques, turns, shifts, twists);
  for (std::size_t j = 0; j < n; ++j) {
    const auto at = 3 * static_cast<Eigen::Index>(j);
    JointId root = static_cast<JointId>(j);
    while (tree.parents[slotOf(root)] != kNoParent) root = tree.parents[slotOf(root)];
    const bool isHeavy = std::any_of(tree.points.begin(), tree.points.end(),
                                     [&](const auto& p) { return tree.isAbove(root, p.link); });
    if (!isHeavy) continue;
    const double scale = 1e-7 * (1.0 + expected.norm());
    EXPECT_LT((turns[j] - expected.segment<3>(at)).norm(), scale);
    EXPECT_LT((shifts[j] - expected.segment<3>(3 * tree.size() + at)).norm(), scale);
    const Eigen::Vector3d x = random.inBox(1.0);
    EXPECT_LT((twists[j].at(x) - tree.jacobian(static_cast<JointId>(j), x) * expected).norm(),
              10.0 * scale);
  }
}

TEST_P(TreeInertiaOf, MultipliesWaysAsTheMatrixDoes) {
  test::Random random(static_cast<std::uint64_t>(GetParam()) + 1000);
  test::RandomTree tree(random, 1 + random.below(30));
  for (JointId j = 0; j < tree.size(); ++j) tree.points.push_back({j, random.inBox(1.0), 0.2});
  const Eigen::MatrixXd inverse = tree.matrix().inverse();
  const internal::TreeInertia inertia = tree.inertia();
  struct Row {
    std::vector<WayPart> way;
    Eigen::VectorXd J;
  };
  std::vector<Row> rows(6);
  for (Row& row : rows) {
    const int n = static_cast<int>(tree.size());
    const JointId link = random.below(n), other = random.chance(0.5) ? random.below(n) : kNoParent;
    const Eigen::Vector3d x = random.inBox(1.0), y = random.inBox(1.0), normal = random.direction();
    row.J = tree.jacobian(link, x).transpose() * normal;
    Vector6d onOther = Vector6d::Zero();
    if (other != kNoParent) {
      row.J -= tree.jacobian(other, y).transpose() * normal;
      onOther = -wrench(y, normal);
    }
    inertia.appendWay(link, wrench(x, normal), other, onOther, row.way);
  }
  for (const Row& one : rows) {
    for (const Row& other : rows) {
      const double found =
          internal::TreeInertia::product(one.way.data(), one.way.data() + one.way.size(),
                                         other.way.data(), other.way.data() + other.way.size());
      const double expected = one.J.dot(inverse * other.J);
      EXPECT_NEAR(found, expected, 1e-7 * (1.0 + std::abs(expected)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(RandomTrees, TreeInertiaOf, testing::Range(0, 60));

}  // namespace
}  // namespace foretouch
