// tests/network/world_stream/crowd_late.h: the time of a body that a world answered before it heard
// of a change of who carries it. What was answered cannot be taken back.
#pragma once

#include <vector>

#include "tests/network/world_stream/crowd_spans.h"
#include "tests/network/world_stream/crowd_told.h"

namespace foretouch::test {

/// Where the world had a right to claim something else: it was told that another body holds this
/// one fast, or got poses in a frame that it had not been told of, or the poses beside a change
/// that it had not been told of.
[[nodiscard]] TimeSpans lateSpans(const CrowdTruth& truth, const std::vector<HeardState>& heard,
                                  BodyNumber body, const TimeSpan& whole);

}  // namespace foretouch::test
