// tests/fuzz/fuzz_inputs.h: what must hold of any input, whatever it is. Broken promises abort.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Reads the bytes as a BVH file. A clip that comes out must keep every promise of clip.h, and its
/// avatar, if it has bones, those of avatar.h. Returns whether it was accepted.
bool feedBvh(const std::uint8_t* data, std::size_t size);

/// Reads the bytes as an avatar file. What is accepted must survive being written and read again.
bool feedAvatar(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
