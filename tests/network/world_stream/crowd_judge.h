// tests/network/world_stream/crowd_judge.h: what a live world told of a crowd, held against the
// truth by the judge's own world: every event is true or marked; what is neither in contact nor
// listed as unknown is proven free; nothing in contact is farther apart than twice the tolerance.
//
// A state that comes after its instant was answered cannot be taken back: that time is left out
// ("late") where the world had a right to claim something else: it was told that another body holds
// the prop fast, or got poses in a frame that it had not been told of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/network/world_stream/crowd_told.h"

namespace foretouch::test {

struct CrowdTally {
  std::uint64_t seeds = 0;
  std::uint64_t events = 0, marked = 0;  ///< Events of two sides.
  std::uint64_t ofAvatars = 0;           ///< Unmarked ones: of two avatars.
  std::uint64_t ofAvatarAndProp = 0, ofProps = 0, ofOwnLinks = 0, ofScene = 0;
  std::uint64_t ofCarried = 0;  ///< Of these: of a prop while it is carried.
  std::uint64_t touching = 0;   ///< Instants in contact that were judged.
  std::uint64_t freeSpans = 0, unproved = 0;
  double freeSeconds = 0.0, unknownSeconds = 0.0, lateSeconds = 0.0;  ///< Of two links each.
  std::uint64_t refused = 0, silences = 0, gaps = 0, lateChanges = 0, failures = 0;

  void add(const CrowdTally& more);
};

/// Adds to both.
void judgeCrowd(const Crowd& crowd, const CrowdTold& told, CrowdTally& tally,
                std::vector<std::string>& violations);

}  // namespace foretouch::test
