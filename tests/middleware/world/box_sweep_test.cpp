#include "middleware/world/box_sweep.h"

#include <vector>

#include <gtest/gtest.h>

#include "lss/simd.h"
#include "tests/support/random_geometry.h"
#include "tests/support/widest_afterwards.h"

namespace foretouch::internal {
namespace {

using test::Random;

std::vector<BodyBox> randomBoxes(Random& random, int count) {
  std::vector<BodyBox> boxes(countOf(count));
  for (BodyBox& box : boxes) {
    if (random.chance(0.1)) continue;  // not there
    for (int k = 0; k < 3; ++k) {
      // On a lattice, so that many touch exactly or begin alike.
      box.lower[k] = static_cast<float>(random.below(12));
      box.upper[k] = box.lower[k] + static_cast<float>(random.below(4));
    }
  }
  return boxes;
}

TEST(BoxSweep, FindsEveryPairAtEveryWidthWhateverCameBefore) {
  const test::WidestAfterwards widest;
  for (const Simd simd : supportedSimd()) {
    ASSERT_TRUE(useSimd(simd));
    BoxSweep sweep;
    std::vector<MeetingBodies> meeting;
    std::size_t found = 0;
    for (int i = 0; i < 300; ++i) {
      Random random(static_cast<std::uint64_t>(i));
      const std::vector<BodyBox> boxes =
          randomBoxes(random, i % 3 == 0 ? 1 + random.below(70) : 40);
      sweep.collect(boxes, meeting);
      std::size_t next = 0;
      for (std::int32_t a = 0; a < static_cast<std::int32_t>(boxes.size()); ++a) {
        for (std::int32_t b = a + 1; b < static_cast<std::int32_t>(boxes.size()); ++b) {
          if (!boxes[slotOf(a)].meets(boxes[slotOf(b)])) continue;
          ASSERT_LT(next, meeting.size());
          ASSERT_EQ(meeting[next].a, a);
          ASSERT_EQ(meeting[next].b, b);
          ++next;
        }
      }
      ASSERT_EQ(next, meeting.size());
      found += next;
    }
    EXPECT_GT(found, 1000u);
  }
}

// A crowd that moves a little hardly changes its order.
}  // namespace
}  // namespace foretouch::internal
