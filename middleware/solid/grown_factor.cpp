#include "middleware/solid/grown_factor.h"

#include <algorithm>
#include <cmath>

namespace foretouch::internal {
namespace {

/// A share of a row's own entry: no pivot is below it, however rounding falls.
constexpr double kLeastPivot = 1e-14;

/// Adds in four sums, for vectors; their order is fixed, and so are the bits.
double dot(const double* x, const double* y, std::size_t n) {
  double sum[4] = {};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    for (std::size_t k = 0; k < 4; ++k) sum[k] += x[i + k] * y[i + k];
  }
  for (; i < n; ++i) sum[0] += x[i] * y[i];
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

}  // namespace

void GrownFactor::begin() {
  rows_.clear();
  isIn_.fill(0);
}

void GrownFactor::choose(const std::vector<std::uint8_t>& isChosen, std::size_t count,
                         const double* matrix) {
  factor_.resize(kMost * kMost);
  between_.resize(kMost);
  const auto leaves = [&](std::size_t row) { return isChosen[row] == 0; };
  const auto stays = std::find_if(rows_.begin(), rows_.end(), leaves);
  auto factored = static_cast<std::size_t>(stays - rows_.begin());
  rows_.erase(std::remove_if(stays, rows_.end(), leaves), rows_.end());
  for (std::size_t row = 0; row < count; ++row) {
    if (isChosen[row] != 0 && isIn_[row] == 0) rows_.push_back(row);
    isIn_[row] = isChosen[row];
  }
  for (; factored < rows_.size(); ++factored) factorRow(factored, matrix);
}

void GrownFactor::factorRow(std::size_t place, const double* matrix) {
  const double* const of = matrix + rows_[place] * kMost;
  double* const row = lower(place);
  for (std::size_t k = 0; k < place; ++k) {
    const double* const above = lower(k);
    row[k] = (of[rows_[k]] - dot(row, above, k)) * above[k];
  }
  const double own = of[rows_[place]];
  const double pivot = std::max(own - dot(row, row, place), kLeastPivot * own);
  row[place] = 1.0 / std::sqrt(pivot);  // its inverse: rows are divided by it
}

void GrownFactor::solve(const std::vector<double>& right, std::vector<double>& x) {
  const std::size_t n = rows_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double* const row = lower(i);
    between_[i] = (right[rows_[i]] - dot(row, between_.data(), i)) * row[i];
  }
  for (std::size_t i = n; i-- > 0;) {
    const double* const row = lower(i);
    const double value = between_[i] * row[i];
    x[rows_[i]] = value;
    for (std::size_t k = 0; k < i; ++k) between_[k] -= row[k] * value;
  }
}

}  // namespace foretouch::internal
