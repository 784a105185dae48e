// tests/fuzz/http_inputs.h: bytes to a service's HTTP server, over a connection to this machine. A
// broken promise aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Sends the bytes and says that no more come. Returns whether a page came back.
bool feedHttp(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
