// tests/fuzz/datagram_inputs.h: invariants for any sequence of datagrams. A broken one aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Cuts the bytes into datagrams and feeds them to a reassembler for the channels "P" and "POSE".
/// Each is a byte whose low two bits number the sender and whose third marks a pause before it, two
/// bytes of length (big-endian), and the datagram; the last one may be shorter. Memory stays
/// bounded, and delivered messages consist of bytes that their sender sent for them, at their
/// places. Returns whether a message was delivered.
bool feedDatagrams(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
