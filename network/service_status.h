// network/service_status.h: a service's counts as the message that it publishes.
#pragma once

#include <cstdint>

#include "network/messages.h"
#include "network/service.h"

namespace foretouch {

/// `recent`: the answers of the last second.
[[nodiscard]] StatusMessage statusOf(const ServiceFacts& facts, const ServiceCounts& counts,
                                     const AnswerTimes& recent, std::int64_t utimeUs);

}  // namespace foretouch
