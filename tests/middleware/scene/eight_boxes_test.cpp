// Eight boxes and triangles at once, bit for bit as one after the other.
#include "middleware/scene/eight_boxes.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using internal::BvhLeaf;
using internal::kBvhWidth;
using internal::kFloatInfinity;
using internal::LocalBox;
using test::Random;

BvhLeaf randomLeaf(Random& random) {
  BvhLeaf leaf{};
  for (auto& corner : leaf.vertex) {
    for (auto& axis : corner) {
      for (float& x : axis) x = static_cast<float>(random.uniform(-1.0, 1.0));
    }
  }
  return leaf;
}

float plainSquare(const float (&low)[3], const float (&high)[3], const LocalBox& box) {
  float sum = 0.0F;
  for (int axis = 0; axis < 3; ++axis) {
    const float gap = std::max({low[axis] - box.upper[axis], box.lower[axis] - high[axis], 0.0F});
    sum += gap * gap;
  }
  return sum;
}

TEST(EightBoxes, AreThoseOfOneAfterTheOther) {
  int left = 0, apart = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const BvhLeaf leaf = randomLeaf(random);
    LocalBox box{};
    float nhat[3];
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = static_cast<float>(random.uniform(-2.0, 1.0));
      box.upper[axis] = box.lower[axis] + static_cast<float>(random.uniform(0.0, 1.0));
      nhat[axis] = static_cast<float>(random.uniform(-1.0, 1.0));
    }
    const auto cut = static_cast<float>(random.uniform(-0.5, 1.0));
    float lower[3][kBvhWidth], upper[3][kBvhWidth], squares[kBvhWidth], kept[kBvhWidth];
    internal::boxesOf(leaf, lower, upper);
    internal::squaredGaps(lower, upper, box, squares);
    std::copy_n(squares, kBvhWidth, kept);
    internal::leaveOutBelow(leaf.vertex, nhat, cut, kept);
    for (int i = 0; i < kBvhWidth; ++i) {
      float low[3], high[3], top = -kFloatInfinity;
      for (int axis = 0; axis < 3; ++axis) {
        const auto of = [&](int corner) { return leaf.vertex[corner][axis][i]; };
        low[axis] = std::min({of(0), of(1), of(2)});
        high[axis] = std::max({of(0), of(1), of(2)});
        ASSERT_EQ(lower[axis][i], low[axis]);
        ASSERT_EQ(upper[axis][i], high[axis]);
      }
      for (const auto& v : leaf.vertex) {
        top = std::max(top, nhat[0] * v[0][i] + nhat[1] * v[1][i] + nhat[2] * v[2][i]);
      }
      ASSERT_EQ(squares[i], plainSquare(low, high, box));
      ASSERT_EQ(kept[i], top < cut ? kFloatInfinity : squares[i]);
      left += top < cut ? 1 : 0;
      apart += squares[i] > 0.0F ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GT(left, all / 4);
  EXPECT_LT(left, all - all / 4);
  EXPECT_GT(apart, all / 4);
  EXPECT_LT(apart, all);
}

}  // namespace
}  // namespace foretouch
