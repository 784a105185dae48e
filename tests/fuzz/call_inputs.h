// tests/fuzz/call_inputs.h: calls of the C library, with what a careless or hostile caller may pass
// as long as its pointers are valid. A broken promise aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// The bytes choose calls and fill their structs and arrays. Returns whether a query was answered.
bool feedCalls(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
