// tests/fuzz/gltf_inputs.h: invariants of the reader of glTF for any file. A broken one aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Reads the bytes as a glTF file, as a scene and as a model. What comes out must keep the promises
/// of both. Returns whether it was accepted.
bool feedGltf(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
