#include "middleware/ask/way_boxes.h"

#include <algorithm>
#include <cmath>

#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

/// A way that is slower than this along an axis does not move along it: over any reach it comes by
/// less than the least length that counts.
constexpr double kLeastPace = 1e-290;

}  // namespace

WayBoxes::WayBoxes(const AskedShape& shape, const Eigen::Vector3d& origin, double extent)
    : moves_(shape.moves()) {
  Eigen::Vector3d a = shape.lss.a - origin, b = shape.lss.b - origin;
  if (shape.hull != nullptr) {
    a += shape.hull->low;
    b += shape.hull->high;
  }
  // A millionth of a millionth of all lengths: thousands of roundings (ask.md 4).
  const double lengths = a.lpNorm<1>() + b.lpNorm<1>() + origin.lpNorm<1>() + extent + shape.moved +
                         shape.lss.radius + (moves_ ? shape.reach : 0.0);
  const double margin = (kInflation - 1.0) * lengths + 2.0 * shape.rounding +
                        2.0 * shape.ofWay * (moves_ ? shape.reach : 0.0) + kUnderflow;
  radius_ = shape.lss.radius + margin;
  for (int axis = 0; axis < 3; ++axis) {
    const double grown = moves_ ? radius_ : 0.0;
    low_[axis] = std::min(a[axis], b[axis]) - grown;
    high_[axis] = std::max(a[axis], b[axis]) + grown;
    const double pace = std::max(std::abs(shape.way[axis]), kLeastPace);
    inverse_[axis] = (std::signbit(shape.way[axis]) ? -1.0 : 1.0) / pace;
  }
  reach_ = shape.reach * kInflation;
  const double within = (shape.reach + radius_) * kInflation;
  squareReach_ = within * within;
}

double WayBoxes::nearest(const Aabb& box) const {
  const double *const lower[3] = {&box.min[0], &box.min[1], &box.min[2]}, *const upper[3] = {
                                                                              &box.max[0],
                                                                              &box.max[1],
                                                                              &box.max[2]};
  double bound = 0.0;
  nearest(1, lower, upper, &bound);
  return bound;
}

double WayBoxes::lengthOf(double square) const {
  return std::max(0.0, (std::sqrt(square) - radius_) / kInflation);
}

}  // namespace foretouch::internal
