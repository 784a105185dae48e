// tests/oracle/leaf_families.h: linear leaf queries by families, each with its own kind of
// difficulty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "judge/rational_linear.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

struct LinearFamily {
  std::string name;
  oracle::LinearQuery (*draw)(Random& random);
  double leastHits, mostHits;  ///< The intended share of true hits.
};

/// uniform, gaps, grazing, slivers, parallel, lattice, plane, far, scaled.
const std::vector<LinearFamily>& linearFamilies();

/// The query of a family: depends only on seed and index.
oracle::LinearQuery drawLinear(std::size_t family, std::uint64_t seed, std::uint64_t index);

/// 8 rows of hexadecimal doubles, as C reads them: the points at t = 0, then at t = 1.
std::string inHex(const oracle::LinearQuery& query);

}  // namespace foretouch::test
