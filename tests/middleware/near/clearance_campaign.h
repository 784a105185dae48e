// tests/middleware/near/clearance_campaign.h: how near random motions come to random scenes, each
// answer held against the judge's own motion and distances, at many instants.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "middleware/near/clearance.h"

namespace foretouch::test {

struct ClearanceTally {
  std::int64_t asked = 0, touching = 0, farther = 0, alone = 0;  ///< `farther`: than `within`.
  std::int64_t instants = 0;                                     ///< At which the judge looked.
  double widest = 0.0;                                           ///< upper - lower, in tolerances.
  std::vector<std::string> problems;

  void add(const ClearanceTally& more);
};

/// A random body and scene by its seed, and `count` motions of it. `tamper` changes an answer
/// before it is judged.
[[nodiscard]] ClearanceTally judgeClearances(std::uint64_t seed, int count,
                                             const std::function<void(Clearance&)>& tamper = {});

[[nodiscard]] std::string summaryOf(const ClearanceTally& tally);

}  // namespace foretouch::test
