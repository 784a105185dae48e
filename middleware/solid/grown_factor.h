// middleware/solid/grown_factor.h: equations of some rows of one symmetric matrix, where rows join
// and leave from solution to solution: what has been factored of those that stay is kept. Not
// installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace foretouch::internal {

/// Cholesky's L L^T of the chosen rows and columns, row by row, in the order in which they joined.
/// For one thread; keeps its memory.
class GrownFactor {
 public:
  static constexpr std::size_t kMost = 64;

  /// Another matrix from now on: nothing is factored.
  void begin();
  /// Chooses the rows whose flag is set, of `count`, at most kMost. What is factored stays as far
  /// as the rows before the first that leaves. `matrix`: row by row, kMost to a row, symmetric,
  /// positive definite; between two begin() it may only grow by rows. O(n^2) per row that joins or
  /// has to join again.
  void choose(const std::vector<std::uint8_t>& isChosen, std::size_t count, const double* matrix);
  /// Solves for the chosen rows: x[row] becomes what gives `right[row]`. O(n^2). Others stay.
  void solve(const std::vector<double>& right, std::vector<double>& x);

  /// The chosen rows, in the factor's order.
  [[nodiscard]] const std::vector<std::size_t>& rows() const { return rows_; }

 private:
  void factorRow(std::size_t place, const double* matrix);
  [[nodiscard]] double* lower(std::size_t place) { return &factor_[place * kMost]; }
  [[nodiscard]] const double* lower(std::size_t place) const { return &factor_[place * kMost]; }

  std::vector<std::size_t> rows_;
  std::array<std::uint8_t, kMost> isIn_{};  // per row of the matrix
  std::vector<double> factor_;              // L, kMost to a row
  std::vector<double> between_;             // of a solution
};

}  // namespace foretouch::internal
