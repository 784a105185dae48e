// tests/fuzz/datagram_inputs.h: what must hold of any sequence of datagrams. Broken promises abort.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Cuts the bytes into datagrams and feeds them to a reassembler for the channels "P" and "POSE".
/// Of each: a byte of whose low two bits number the sender and whose third says that a pause went
/// before, two bytes of length (big-endian), the datagram; the last one may be shorter. Memory
/// stays bounded, and what is delivered consists of bytes that its sender sent for it, at their
/// places. Returns whether a message was delivered.
bool feedDatagrams(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
