#include "middleware/world/world_query.h"

#include "middleware/world/window_query.h"

namespace foretouch {

WorldScratch::WorldScratch() : parts_(std::make_unique<internal::WorldScratchParts>()) {}
WorldScratch::~WorldScratch() = default;
WorldScratch::WorldScratch(WorldScratch&&) noexcept = default;
WorldScratch& WorldScratch::operator=(WorldScratch&&) noexcept = default;

Result<Done> worldContacts(const World& world, std::int64_t fromUs, std::int64_t toUs,
                           WorldScratch& scratch, WorldContacts& answer) {
  return internal::askWindow(world, fromUs, toUs, nullptr, scratch.parts(), answer);
}

}  // namespace foretouch
