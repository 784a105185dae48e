// tests/fuzz/vmc_inputs.h: invariants for any sequence of datagrams at a port of VMC. A broken one
// aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Cuts the bytes into datagrams, each behind two bytes of its length (big-endian), the last one
/// maybe shorter, and feeds them to the stream of a humanoid. What comes out can be encoded and
/// decoded, claims no order that VMC does not have, and is no more than the bytes can say. Returns
/// whether a pose came out.
bool feedVmc(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
