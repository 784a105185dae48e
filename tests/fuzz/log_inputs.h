// tests/fuzz/log_inputs.h: invariants for any event log. A broken one aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Reads the bytes as an event log, in every way. Returned events are in the log, in order, and the
/// counts add up. Returns whether there was an event.
bool feedLog(const std::uint8_t* data, std::size_t size);

/// Damages a log with check sums as the bytes say: per damage one byte for its kind, two for its
/// place and two for its length (big-endian). Returned events are events of that log as written, in
/// order. Returns whether all of them still are.
bool feedLogDamage(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
