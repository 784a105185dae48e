// network/service/service_status.h: a service's counts as the message it publishes.
#pragma once

#include <cstdint>

#include "network/service/service_counts.h"
#include "network/wire/messages.h"

namespace foretouch {

/// `recent`: the answers of the last second.
[[nodiscard]] StatusMessage statusOf(const ServiceFacts& facts, const ServiceCounts& counts,
                                     const AnswerTimes& recent, std::int64_t utimeUs);

}  // namespace foretouch
