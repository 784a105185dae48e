// middleware/world/box_sweep.h: which of many boxes meet: sorted along x and swept, sixteen at
// once. From one call to the next most boxes stay where they are in the order, so that the sort
// hardly moves anything. The sweep and prune of [Cohen95], on one axis. Not installed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {

/// Empty: meets nothing.
struct BodyBox {
  float lower[3] = {kNowhere, kNowhere, kNowhere};
  float upper[3] = {-kNowhere, -kNowhere, -kNowhere};

  [[nodiscard]] bool isEmpty() const { return !(lower[0] <= upper[0]); }
  [[nodiscard]] bool meets(const BodyBox& other) const {
    for (int k = 0; k < 3; ++k) {
      if (!(lower[k] <= other.upper[k] && other.lower[k] <= upper[k])) return false;
    }
    return true;
  }
  void add(const BodyBox& other);
  /// Rounded outward. `shift` may be off by a few units in the last place.
  [[nodiscard]] BodyBox movedBy(const Eigen::Vector3d& shift) const;

  static constexpr float kNowhere = 3.0e38F;
};

/// As BodyBox::movedBy(), for one axis.
struct MovedBounds {
  float lower, upper;
};
[[nodiscard]] inline MovedBounds movedBounds(float lower, float upper, double shift) {
  // Covers the shift, which is a difference of two places, and the sum with it.
  constexpr double kRoundingOfMove = 8.0 * kUnitRoundoff;
  const double low = static_cast<double>(lower), high = static_cast<double>(upper);
  const double slack =
      kRoundingOfMove * std::max(std::abs(low), std::abs(high)) + kRoundingOfMove * std::abs(shift);
  return {-floatPaddedAbove(slack - (low + shift)), floatPaddedAbove(high + shift + slack)};
}

struct MeetingBodies {
  std::int32_t a, b;  ///< a < b.
};

/// For one thread; keeps its memory and the order.
class BoxSweep {
 public:
  /// All pairs of boxes that meet, by a, then by b: the same whatever came before. Typically O(n +
  /// pairs along x) divided by 16; O(n^2) at worst.
  void collect(const std::vector<BodyBox>& boxes, std::vector<MeetingBodies>& meeting);

 private:
  void sort(const std::vector<BodyBox>& boxes);
  void arrange(const std::vector<BodyBox>& boxes);
  void sortMeeting(std::size_t numBodies, std::vector<MeetingBodies>& meeting);

  std::vector<std::int32_t> order_;
  // Bounds of the boxes in that order, with room for a vector beyond: lower and upper along y and
  // z, and lower along x.
  std::vector<float> rows_[5];
  std::size_t count_ = 0;           // not empty
  std::vector<std::int32_t> ends_;  // per a: the end of its pairs so far
  std::vector<MeetingBodies> sorted_;
};

}  // namespace foretouch::internal
