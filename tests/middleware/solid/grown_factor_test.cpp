// Rows that join and leave, against Eigen's factor of the whole matrix each time.
#include "middleware/solid/grown_factor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using internal::GrownFactor;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr auto kMost = static_cast<Eigen::Index>(GrownFactor::kMost);

/// Symmetric, positive definite, with a condition of at most some thousands.
Matrix randomMatrix(test::Random& random) {
  Matrix wide(kMost, 2 * kMost);
  for (Eigen::Index i = 0; i < wide.size(); ++i) wide.data()[i] = random.uniform(-1.0, 1.0);
  return wide * wide.transpose();
}

struct GrownFactorOf : testing::TestWithParam<int> {
  GrownFactorOf() : random(static_cast<std::uint64_t>(GetParam()) + 900) {
    right.resize(GrownFactor::kMost);
    x.resize(GrownFactor::kMost);
    isChosen.resize(GrownFactor::kMost, 0);
    for (double& value : right) value = random.uniform(-1.0, 1.0);
  }

  void choose(std::size_t count, const Matrix& matrix) {
    factor.choose(isChosen, count, matrix.data());
  }
  /// Solves, and holds the chosen rows against Eigen, all others against what they were.
  void expectSolved(const Matrix& matrix) {
    constexpr double kUntouched = 7.0;
    std::fill(x.begin(), x.end(), kUntouched);
    factor.solve(right, x);
    const auto& rows = factor.rows();
    const auto n = static_cast<Eigen::Index>(rows.size());
    ASSERT_EQ(n, std::count(isChosen.begin(), isChosen.end(), 1));
    Eigen::MatrixXd part(n, n);
    Eigen::VectorXd asked(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto row = rows[static_cast<std::size_t>(i)];
      ASSERT_EQ(isChosen[row], 1);
      asked[i] = right[row];
      for (Eigen::Index k = 0; k < n; ++k) {
        part(i, k) = matrix(static_cast<Eigen::Index>(row),
                            static_cast<Eigen::Index>(rows[static_cast<std::size_t>(k)]));
      }
    }
    const Eigen::VectorXd expected = part.llt().solve(asked);
    for (Eigen::Index i = 0; i < n; ++i) {
      EXPECT_NEAR(x[rows[static_cast<std::size_t>(i)]], expected[i], 1e-9);
    }
    for (std::size_t row = 0; row < x.size(); ++row) {
      if (isChosen[row] == 0) {
        EXPECT_EQ(x[row], kUntouched);
      }
    }
  }

  test::Random random;
  GrownFactor factor;
  std::vector<double> right, x;
  std::vector<std::uint8_t> isChosen;
};

TEST_P(GrownFactorOf, RowsThatJoinAndLeaveSolveAsAllTogether) {
  const Matrix matrix = randomMatrix(random);
  factor.begin();
  for (int round = 0; round < 60; ++round) {
    // Now a few rows, now many; the matrix grows meanwhile.
    const auto count = static_cast<std::size_t>(std::min<int>(4 + 2 * round, 64));
    const int changes = 1 + random.below(round % 5 == 0 ? 20 : 3);
    for (int i = 0; i < changes; ++i) {
      std::uint8_t& flag =
          isChosen[static_cast<std::size_t>(random.below(static_cast<int>(count)))];
      flag = flag == 0 ? 1 : 0;
    }
    choose(count, matrix);
    ASSERT_NO_FATAL_FAILURE(expectSolved(matrix));
  }
}

TEST_P(GrownFactorOf, AnotherMatrixKeepsNothingOfTheFirst) {
  std::fill_n(isChosen.begin(), 10, std::uint8_t{1});
  factor.begin();
  choose(10, randomMatrix(random));
  const Matrix second = randomMatrix(random);
  factor.begin();
  choose(10, second);
  expectSolved(second);
}

TEST_P(GrownFactorOf, RowsThatStayKeepTheirOrder) {
  const Matrix matrix = randomMatrix(random);
  factor.begin();
  for (const std::size_t row : {5U, 9U, 2U}) {
    isChosen[row] = 1;
    choose(12, matrix);
  }
  EXPECT_EQ(factor.rows(), (std::vector<std::size_t>{5, 9, 2}));
  isChosen[9] = 0;
  isChosen[0] = 1;
  choose(12, matrix);
  EXPECT_EQ(factor.rows(), (std::vector<std::size_t>{5, 2, 0}));
  expectSolved(matrix);
}

// Two contacts at one place: their rows are the same, and their matrix has no inverse.
TEST_P(GrownFactorOf, RowsThatAreTheSameTwiceStillHaveASolution) {
  Matrix matrix = randomMatrix(random);
  matrix.row(1) = matrix.row(0);
  matrix.col(1) = matrix.col(0);
  isChosen[0] = isChosen[1] = 1;
  factor.begin();
  choose(2, matrix);
  right[1] = right[0];
  factor.solve(right, x);
  EXPECT_TRUE(std::isfinite(x[0]) && std::isfinite(x[1]));
  EXPECT_NEAR(matrix(0, 0) * (x[0] + x[1]), right[0], 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Seeds, GrownFactorOf, testing::Range(0, 20));

}  // namespace
}  // namespace foretouch
