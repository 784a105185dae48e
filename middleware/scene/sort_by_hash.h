// middleware/scene/sort_by_hash.h: sorts triangles by hashes in linear time. Not installed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "middleware/scene/raw_scene.h"

namespace foretouch::internal {

using HashedTriangle = std::pair<std::uint64_t, TriangleId>;

/// As std::sort(), for a `less` that looks at the hashes first. Hashes are even: those that begin
/// alike are few, and sorted by themselves. O(n) for them; else O(n log n).
template <typename Less>
void sortByHash(std::vector<HashedTriangle>& hashed, const Less& less) {
  // About one per bucket, in tables that stay in a cache.
  constexpr int kMostBits = 16;
  int bits = 1;
  while (bits < kMostBits && (std::size_t{1} << bits) < hashed.size()) ++bits;
  const auto bucketOf = [bits](const HashedTriangle& one) {
    return static_cast<std::size_t>(one.first >> (64 - bits));
  };
  std::vector<std::size_t> ends((std::size_t{1} << bits) + 1, 0);
  for (const HashedTriangle& one : hashed) ++ends[bucketOf(one) + 1];
  for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
  std::vector<HashedTriangle> sorted(hashed.size());
  for (const HashedTriangle& one : hashed) sorted[ends[bucketOf(one)]++] = one;
  // Each bucket now ends where the next one began.
  auto begin = sorted.begin();
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(ends[i]);
    std::sort(begin, end, less);
    begin = end;
  }
  hashed = std::move(sorted);
}

}  // namespace foretouch::internal
