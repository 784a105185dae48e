// tests/fuzz/fuzz_inputs.h: invariants for any input. A broken one aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Reads the bytes as a BVH file. A clip that comes out must keep every promise of clip.h, and its
/// avatar, if it has bones, those of avatar.h. Returns whether it was accepted.
bool feedBvh(const std::uint8_t* data, std::size_t size);

/// Reads the bytes as an avatar file. An accepted one must survive writing and reading.
bool feedAvatar(const std::uint8_t* data, std::size_t size);

/// Reads the bytes as pair rules of an avatar of four links. Accepted ones must ask something and
/// survive writing and reading.
bool feedPairs(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
