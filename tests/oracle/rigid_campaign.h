// tests/oracle/rigid_campaign.h: a turning triangle against one at rest: families, and a judge of
// the answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "judge/rigid_prover.h"
#include "tests/oracle/leaf_campaign.h"

namespace foretouch::test {

struct RigidQuery {
  oracle::RigidPair pair;
  double band = 0.0;
};

struct RigidFamily {
  std::string name;
  RigidQuery (*draw)(Random& random);
  double leastHits, mostHits;  ///< The intended share of true hits.
};

/// uniform, gaps, turning, slivers, still, far, scaled.
const std::vector<RigidFamily>& rigidFamilies();
RigidQuery drawRigid(std::size_t family, std::uint64_t seed, std::uint64_t index);

/// Hexadecimal doubles: x0, x1; q0, q1; the moving triangle; the one at rest; the band.
std::string inHex(const RigidQuery& query);

/// A miss must be free of separations <= band; a hit must be free of them before toiLow, and be
/// within band + rigidBand() at some instant of [toiLow, toiHigh].
void judgeRigid(const RigidQuery& query, const std::string& name, LeafTally& tally);
std::vector<LeafTally> judgeRigid(const LeafJob& job);

}  // namespace foretouch::test
