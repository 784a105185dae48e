// tests/fuzz/shown_inputs.h: files of shown poses (docs/formats.md). A broken promise aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// True if it was read to its end without an error.
bool feedShownPoses(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
