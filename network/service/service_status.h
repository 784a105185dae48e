// network/service/service_status.h: a service's counts as the message it publishes.
#pragma once

#include <cstdint>

#include "network/service/service_counts.h"
#include "network/wire/messages.h"
#include "network/world_stream/world_counts.h"

namespace foretouch {

/// `recent`: the answers of the last second. `world`: null if there is none.
[[nodiscard]] StatusMessage statusOf(const ServiceFacts& facts, const ServiceCounts& counts,
                                     const AnswerTimes& recent, std::int64_t utimeUs,
                                     const WorldCounts* world = nullptr);

}  // namespace foretouch
