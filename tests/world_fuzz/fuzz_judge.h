// tests/world_fuzz/fuzz_judge.h: what was told of a random world, held against the judge's own at
// sampled instants: each change of motion from both sides, between them, and each event's own.
//
// Not judged finer than `guard`: 1e-12 m and 64 last places of the largest coordinate, as far as
// doubles may be off in places that the file leaves to the program.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "middleware/events/world_event.h"
#include "middleware/triggers/triggers.h"
#include "tests/world_fuzz/fuzz_world.h"

namespace foretouch::test {

struct FuzzTold {
  std::int64_t beginUs = 0, endUs = 0;
  std::vector<WorldEvent> events;
  std::vector<TriggerEvent> triggerEvents;
  std::vector<WorldContacts> windows;  ///< Of `cuts`, one after the other, without triggers.
  std::vector<std::int64_t> cuts;
};

enum class FuzzFault {
  Missed,   ///< Two touch, and are told to be free.
  Late,     ///< The same, in front of an enter between the same two poses.
  Early,    ///< A contact begins at more than the tolerance.
  Open,     ///< A contact goes on, or ends, at more than twice the tolerance.
  Loose,    ///< An end without a begin, a second begin, an end while they are in contact.
  Order,    ///< Events are not in their order, or out of the time that was asked.
  Refused,  ///< A legal world is refused.
  Differs,  ///< Other tables' order, or another interface, tells otherwise.
};
inline constexpr std::array<const char*, 8> kFuzzFaults{"missed", "late",  "early",   "open",
                                                        "loose",  "order", "refused", "differs"};

struct FuzzTally {
  std::uint64_t worlds = 0, pairInstants = 0, contacts = 0, triggerEvents = 0, unresolved = 0;
  std::array<std::uint64_t, kFuzzFaults.size()> faults{};
  std::string first;  ///< What the first fault was; empty: there is none.

  void say(FuzzFault fault, const std::string& what);
  void add(const FuzzTally& more);
  [[nodiscard]] std::uint64_t wrong() const;
};

void judgeFuzzWorld(const FuzzWorld& world, const FuzzTold& told, FuzzTally& tally);

}  // namespace foretouch::test
