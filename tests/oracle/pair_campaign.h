// tests/oracle/pair_campaign.h: two moving triangles, judged by their features: at t = 0 they meet
// if a point that walks along an edge of one meets the other at rest; later, the first contact is
// that of a vertex and a face or of two edges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/oracle/leaf_campaign.h"

namespace foretouch::test {

struct PairQuery {
  std::array<oracle::Path, 3> one, other;
};
struct PairTruth {
  bool startsInContact = false;
  oracle::LinearTruth first;
};

/// moving, still, lattice, plane.
const std::vector<std::string>& pairFamilies();
PairQuery drawPair(std::size_t family, std::uint64_t seed, std::uint64_t index);
PairTruth pairTruth(const PairQuery& query);

/// trianglePair() and, for the triangles at t = 0, trianglesMeet().
std::vector<LeafTally> judgePairs(const LeafJob& job);

}  // namespace foretouch::test
