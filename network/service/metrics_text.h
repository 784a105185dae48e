// network/service/metrics_text.h: a service's counts in Prometheus' text format 0.0.4.
// docs/streaming.md, "Metrics", lists the names, which are stable. Not installed.
#pragma once

#include <string>

#include "network/service/service.h"

namespace foretouch {

[[nodiscard]] std::string metricsText(const ServiceFacts& facts, const ServiceCounts& counts,
                                      const AnswerTimes& times, const SolidCounts& solids = {},
                                      const WorldReport* world = nullptr,
                                      const PersonCounts& persons = {});

}  // namespace foretouch
