// tests/network/world_stream/crowd_told.h: a crowd's messages handed to a live world, as the
// service does it, and what that tells. One rule of it can be broken on purpose.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "network/world_stream/world_solver.h"
#include "tests/network/world_stream/crowd.h"

namespace foretouch::test {

/// What a broken world would do: messages or answers are changed so that a correct one acts so.
enum class CrowdMutation {
  None,
  OtherLinkCarries,  ///< A prop hangs on another link than its state says.
  CarriersStay,      ///< Who is let go of is carried on.
  BadJointsAreGood,  ///< A joint that is not known counts as tracked.
  EntersAreLate,     ///< By a fifth of a millisecond.
  LeavesAreEarly,
  EntersAreLost,
  UnknownIsSilent,  ///< Lists of what is not known are empty, and nothing is marked.
};
inline constexpr std::array kCrowdMutations{
    CrowdMutation::OtherLinkCarries, CrowdMutation::CarriersStay,   CrowdMutation::BadJointsAreGood,
    CrowdMutation::EntersAreLate,    CrowdMutation::LeavesAreEarly, CrowdMutation::EntersAreLost,
    CrowdMutation::UnknownIsSilent};
[[nodiscard]] const char* toString(CrowdMutation mutation);

/// A body_t that was accepted when all until `answeredUs` was answered (-1: nothing).
struct HeardState {
  CrowdState state;
  std::int64_t answeredUs = -1;
};

struct CrowdTold {
  std::vector<EventsMessage> answers;
  std::vector<CrowdArrival> accepted;          ///< All that a replay has, with its receipts.
  std::vector<std::vector<HeardState>> heard;  ///< Per body.
  std::vector<std::optional<std::int64_t>> presentUs;  ///< Per body: it is there from here on.
  WorldCounts counts;
};

[[nodiscard]] CrowdTold tellCrowd(const WorldSetup& setup, std::size_t bodies,
                                  const std::vector<CrowdArrival>& arrivals,
                                  const WorldPolicy& policy,
                                  CrowdMutation mutation = CrowdMutation::None);

}  // namespace foretouch::test
