// The least change that keeps rows, held against what must be true of any least one.
#include "tools/repair/least_change.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace foretouch::tools {
namespace {

using Eigen::MatrixXd;

/// Of two knobs that move much the same.
MatrixXd coupled() {
  MatrixXd metric(2, 2);
  metric << 1.0, 0.2, 0.2, 0.1;
  return metric;
}

double valueOf(const Row& row, const Changes& changes) {
  double value = 0.0;
  for (const RowTerm& term : row.terms) value += term.by * changes(term.knob, term.pose);
  return value;
}

/// The cost as the header says it, by its definition.
double costOf(const MatrixXd& metric, const Changes& changes, double reach) {
  const auto at = [&](Eigen::Index pose) -> Eigen::VectorXd {
    if (pose < 0 || pose >= changes.cols()) return Eigen::VectorXd::Zero(changes.rows());
    return changes.col(pose);
  };
  const auto square = [&](const Eigen::VectorXd& x) { return x.dot(metric * x); };
  const double r2 = reach * reach;
  double cost = 0.0;
  for (Eigen::Index p = -3; p < changes.cols(); ++p) {
    cost += square(at(p)) + 3 * r2 * square(at(p + 1) - at(p)) +
            3 * r2 * r2 * square(at(p + 2) - 2 * at(p + 1) + at(p)) +
            r2 * r2 * r2 * square(at(p + 3) - 3 * at(p + 2) + 3 * at(p + 1) - at(p));
  }
  return cost;
}

LeastChangeOptions heldAtEnds() {
  LeastChangeOptions options;
  options.isFreeBefore = options.isFreeAfter = false;
  options.margin = 1000;
  return options;
}

/// No change near the answer that keeps the rows as well costs less.
TEST(LeastChange, IsLeastAmongItsNeighbours) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const MatrixXd knobs = coupled();
    constexpr int kPoses = 40;
    std::vector<Row> rows;
    for (int i = 0; i < 6; ++i) {
      Row row;
      row.terms = {
          {i * 6 + 2, 0, unit(random)}, {i * 6 + 2, 1, unit(random)}, {i * 6 + 3, 1, unit(random)}};
      row.lower = 0.01 * unit(random);
      if (i % 2 == 0) row.upper = row.lower + 0.002;
      rows.push_back(row);
    }
    const LeastChangeOptions options = heldAtEnds();
    const LeastChange least = leastChange(knobs, kPoses, rows, options);
    ASSERT_TRUE(least.isSolved);
    for (const Row& row : rows) {
      EXPECT_GT(valueOf(row, least.changes), row.lower - 1e-6);
      EXPECT_LT(valueOf(row, least.changes), row.upper + 1e-6);
    }
    const double cost = costOf(knobs, least.changes, options.reach);
    for (int i = 0; i < 200; ++i) {
      // A neighbour that keeps what pushes: its share across those rows is taken out.
      Changes way = Changes::NullaryExpr(2, kPoses, [&] { return 1e-4 * unit(random); });
      for (int round = 0; round < 50; ++round) {
        for (const Row& row : rows) {
          if (row.push == 0.0) continue;
          double square = 0.0;
          for (const RowTerm& term : row.terms) square += term.by * term.by;
          const double off = valueOf(row, way) / square;
          for (const RowTerm& term : row.terms) way(term.knob, term.pose) -= off * term.by;
        }
      }
      EXPECT_GE(costOf(knobs, least.changes + way, options.reach), cost * (1.0 - 1e-6));
    }
  }
}

/// Hundreds of rows that say much the same, as those of a foot's contacts do: where no row pushes
/// the cost's slope is zero, and elsewhere it is what the rows push, each on the side where it is
/// met. Nothing but the least change has that.
TEST(LeastChange, SettlesAmongManyRowsThatSayMuchTheSame) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const MatrixXd knobs = coupled();
    constexpr int kPoses = 60;
    std::vector<Row> rows;
    for (int i = 0; i < 600; ++i) {
      Row row;
      const int pose = 10 + i % 40;
      row.terms = {{pose, 0, 1.0 + 0.01 * unit(random)}, {pose + 1, 1, 0.3 + 0.01 * unit(random)}};
      row.lower = 0.005 + 0.004 * unit(random);
      if (i % 7 == 0) row.upper = row.lower + 0.02;
      rows.push_back(row);
    }
    const LeastChangeOptions options = heldAtEnds();
    const LeastChange least = leastChange(knobs, kPoses, rows, options);
    ASSERT_TRUE(least.isSolved);
    EXPECT_LT(least.worst, 1e-5);
    Changes pushes = Changes::Zero(2, kPoses);
    double most = 0.0;
    for (const Row& row : rows) {
      for (const RowTerm& term : row.terms) pushes(term.knob, term.pose) += term.by * row.push;
      const double value = valueOf(row, least.changes);
      if (value > row.lower + 1e-5) {
        EXPECT_LE(row.push, 1e-9);
      }
      if (value < row.upper - 1e-5) {
        EXPECT_GE(row.push, -1e-9);
      }
      most = std::max(most, std::abs(row.push));
    }
    ASSERT_GT(most, 0.0);
    for (int pose = 0; pose < kPoses; ++pose) {
      for (int knob = 0; knob < 2; ++knob) {
        // Half the slope of the cost, which is a square: by differences that are exact.
        Changes more = least.changes, less = least.changes;
        more(knob, pose) += 1e-3;
        less(knob, pose) -= 1e-3;
        const double slope =
            (costOf(knobs, more, options.reach) - costOf(knobs, less, options.reach)) / 4e-3;
        EXPECT_NEAR(slope, pushes(knob, pose), 1e-3 * most);
      }
    }
  }
}

/// A change fades without swinging past zero.
TEST(LeastChange, FadesWithoutOvershoot) {
  const MatrixXd knobs = MatrixXd::Identity(1, 1);
  std::vector<Row> rows(1);
  rows[0].terms = {{100, 0, 1.0}};
  rows[0].lower = 0.01;
  LeastChangeOptions options = heldAtEnds();
  const LeastChange least = leastChange(knobs, 200, rows, options);
  EXPECT_NEAR(least.changes(0, 100), 0.01, 1e-6);
  for (int pose = 0; pose + 1 <= 100; ++pose) {
    EXPECT_GE(least.changes(0, pose), -1e-6);
    EXPECT_LE(least.changes(0, pose), least.changes(0, pose + 1) + 1e-9);
  }
  EXPECT_LT(least.changes(0, 100 - 6 * 6), 0.01 * 0.1);
}

/// Poses beyond the margin, and knobs that no row names, stay as they are.
TEST(LeastChange, ChangesNothingFarAway) {
  const MatrixXd knobs = MatrixXd::Identity(2, 2);
  std::vector<Row> rows(1);
  rows[0].terms = {{50, 0, 1.0}};
  rows[0].lower = rows[0].upper = 0.02;
  LeastChangeOptions options;
  options.margin = 20;
  const LeastChange least = leastChange(knobs, 100, rows, options);
  EXPECT_NEAR(least.changes(0, 50), 0.02, 1e-6);
  for (int pose = 0; pose < 100; ++pose) {
    EXPECT_EQ(least.changes(1, pose), 0.0);
    if (std::abs(pose - 50) > 20) {
      EXPECT_EQ(least.changes(0, pose), 0.0);
    }
  }
}

/// Rows that contradict each other push against each other, and are met half way.
TEST(LeastChange, MeetsContradictionsHalfWay) {
  const MatrixXd knobs = MatrixXd::Identity(1, 1);
  std::vector<Row> rows(2);
  rows[0].terms = rows[1].terms = {{10, 0, 1.0}};
  rows[0].lower = 0.02;
  rows[1].upper = 0.0;
  const LeastChange least = leastChange(knobs, 20, rows, {});
  EXPECT_NEAR(least.changes(0, 10), 0.01, 1e-4);
  EXPECT_NEAR(least.worst, 0.01, 1e-4);
  EXPECT_GT(rows[0].push, 0.0);
  EXPECT_LT(rows[1].push, 0.0);
}

}  // namespace
}  // namespace foretouch::tools
