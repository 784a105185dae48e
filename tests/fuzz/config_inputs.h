// tests/fuzz/config_inputs.h: what must hold of any text that comes as a service's configuration.
// Broken promises abort.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Errors name the file and a line of it; what is accepted is within the limits of serve_config.h.
/// Returns whether it was accepted.
bool feedConfig(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
