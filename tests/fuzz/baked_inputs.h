// tests/fuzz/baked_inputs.h: baked scenes (docs/formats.md). A broken promise aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// With a header that says that the file is whole, whatever else it says. True if it was read: then
/// a query among its triangles has ended.
bool feedBakedScene(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
