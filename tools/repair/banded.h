// tools/repair/banded.h: symmetric positive systems whose unknowns come in blocks of one size, each
// of which is coupled only with the next few: Cholesky's factor block by block, with Eigen's own
// for each block.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace foretouch::tools {

class BandedSystem {
 public:
  /// A block is coupled with this many blocks before it.
  static constexpr std::size_t kBand = 3;

  BandedSystem(std::size_t blocks, Eigen::Index size);

  /// The rows of block `at` and the columns of block `at - back`; of block `at` itself both halves.
  [[nodiscard]] Eigen::MatrixXd& block(std::size_t at, std::size_t back) {
    return blocks_[at][back];
  }
  /// Precondition: the system was not factorized.
  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& x) const;
  /// Replaces the system by its factor. False if the system is not positive.
  [[nodiscard]] bool factorize();
  /// Precondition: factorize() was true. `x`: the right side, then the answer.
  void solve(Eigen::VectorXd& x) const;

 private:
  Eigen::Index size_;
  std::vector<std::array<Eigen::MatrixXd, kBand + 1>> blocks_;
};

}  // namespace foretouch::tools
