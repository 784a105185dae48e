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
  constexpr int kBits = 16;
  const auto bucketOf = [](const HashedTriangle& one) {
    return static_cast<std::size_t>(one.first >> (64 - kBits));
  };
  std::vector<std::size_t> ends((std::size_t{1} << kBits) + 1, 0);
  for (const HashedTriangle& one : hashed) ++ends[bucketOf(one) + 1];
  for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
  const std::vector<std::size_t> begins(ends.begin(), ends.end() - 1);
  std::vector<HashedTriangle> sorted(hashed.size());
  for (const HashedTriangle& one : hashed) sorted[ends[bucketOf(one)]++] = one;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begins[i]),
              sorted.begin() + static_cast<std::ptrdiff_t>(ends[i]), less);
  }
  hashed = std::move(sorted);
}

}  // namespace foretouch::internal
