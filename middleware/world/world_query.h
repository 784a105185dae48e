// middleware/world/world_query.h: the question a world answers: who meets whom first, between two
// instants? Metres in W, world time in microseconds. The promise: docs/guarantees.md 15.
#pragma once

#include <cstdint>
#include <memory>

#include "articulated/result.h"
#include "middleware/world/world.h"
#include "middleware/world/world_contacts.h"

namespace foretouch {

namespace internal {
struct WorldScratchParts;
}

/// Memory that questions about worlds reuse, and what is best kept from one window to the next; one
/// per thread.
class WorldScratch {
 public:
  WorldScratch();
  ~WorldScratch();
  WorldScratch(WorldScratch&&) noexcept;
  WorldScratch& operator=(WorldScratch&&) noexcept;

  /// For the query's own sources.
  [[nodiscard]] internal::WorldScratchParts& parts() { return *parts_; }

 private:
  std::unique_ptr<internal::WorldScratchParts> parts_;
};

/// The first contact, in the window from `fromUs` to `toUs`, of every two links of different bodies
/// that are asked, of every link and the static scene, and of own links where a body asks for
/// these. Depends on the poses alone, not on the order in which they came. Allocates nothing once
/// the scratch and the answer have grown, as long as nobody is added or carried in another way.
/// Errors, which name who or what: a window without length, that begins before what was forgotten,
/// or ends after knownUntilUs(); carriers whose chains are too deep together.
Result<Done> worldContacts(const World& world, std::int64_t fromUs, std::int64_t toUs,
                           WorldScratch& scratch, WorldContacts& answer);

}  // namespace foretouch
