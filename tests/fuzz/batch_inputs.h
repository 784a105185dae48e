// tests/fuzz/batch_inputs.h: manifests of batches. A broken promise aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Errors name the file and one of its lines; an accepted manifest has jobs with all that they
/// need.
bool feedManifest(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
