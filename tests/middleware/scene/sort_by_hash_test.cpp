#include "middleware/scene/sort_by_hash.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace foretouch::internal {
namespace {

/// Hashes with as many different leading bits as `mask` lets through.
std::vector<HashedTriangle> drawn(std::size_t count, std::uint64_t mask, std::mt19937_64& random) {
  std::vector<HashedTriangle> hashed;
  for (std::size_t i = 0; i < count; ++i) {
    hashed.emplace_back(random() & mask, static_cast<TriangleId>(random() % (count + 1)));
  }
  return hashed;
}

TEST(SortByHash, SortsAsTheStandardDoesWhateverTheSize) {
  std::mt19937_64 random(1);
  std::vector<std::size_t> counts;
  for (std::size_t count = 0; count < 70; ++count) counts.push_back(count);
  for (const std::size_t more : {255U, 256U, 257U, 1000U, 65536U, 65537U, 200000U}) {
    counts.push_back(more);
  }
  // All bits; the last ones alone, so that all begin alike; the first alone; none.
  for (const std::uint64_t mask :
       {~std::uint64_t{0}, std::uint64_t{0xff}, std::uint64_t{0xff} << 56, std::uint64_t{0}}) {
    for (const std::size_t count : counts) {
      std::vector<HashedTriangle> sorted = drawn(count, mask, random), expected = sorted;
      std::sort(expected.begin(), expected.end());
      sortByHash(sorted, std::less<>());
      ASSERT_EQ(sorted, expected) << count << " hashes, mask " << mask;
    }
  }
}

}  // namespace
}  // namespace foretouch::internal
