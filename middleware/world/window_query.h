// middleware/world/window_query.h: a question about one window, on one thread or on several: every
// body by itself, then every pair that is near. Not installed.
#pragma once

#include <cstdint>

#include "articulated/result.h"
#include "middleware/worker_pool.h"
#include "middleware/world/window_scratch.h"
#include "middleware/world/world.h"
#include "middleware/world/world_contacts.h"

namespace foretouch::internal {

void addCounters(const WorldCounters& more, WorldCounters& sum);

/// The window can be asked about. Errors: as World::contacts().
Result<Done> checkedWindow(const World& world, std::int64_t fromUs, std::int64_t toUs);

/// As World::contacts(). `pool`: null, or threads to share the work; the answer is the same.
/// `followed`: null, or what need not be reported. More errors: on several threads, memory ran out
/// (DeviceFailed).
Result<Done> askWindow(const World& world, std::int64_t fromUs, std::int64_t toUs, WorkerPool* pool,
                       WorldMemory& scratch, WorldContacts& answer,
                       const FollowedLinks* followed = nullptr);

}  // namespace foretouch::internal
