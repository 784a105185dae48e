// tests/fuzz/log_inputs.h: what must hold of any event log. Broken promises abort.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Reads the bytes as an event log, in every way. What is given out stands in the log, in order,
/// and the counts add up. Returns whether an event was given out.
bool feedLog(const std::uint8_t* data, std::size_t size);

/// Damages a log with check sums as the bytes say: of each damage a byte that names its kind, two
/// of its place and two of its length (big-endian). What is given out are events of that log as
/// they were written, in order. Returns whether all of them still are.
bool feedLogDamage(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
