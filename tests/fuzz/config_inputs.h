// tests/fuzz/config_inputs.h: invariants for any text as a service's configuration. A broken one
// aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Errors name the file and one of its lines; an accepted configuration is within the limits of
/// serve_config.h. Returns whether it was accepted.
bool feedConfig(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
