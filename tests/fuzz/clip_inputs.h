// tests/fuzz/clip_inputs.h: invariants for any file of motion research. A broken one aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// The bytes up to the first zero are an ASF, those behind it an AMC. Returns whether both were
/// read.
bool feedAcclaim(const std::uint8_t* data, std::size_t size);

/// A session of WebXR.
bool feedWebXr(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
