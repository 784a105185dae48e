// network/udpm_datagram.h: one datagram of LCM's UDP multicast protocol ("UDPM"), as bytes.
// Integers are big-endian. Source: lcm-proj/lcm, docs/content/udp-multicast-protocol.md.
//   short:    "LC02" u32 sequence, channel, NUL, payload
//   fragment: "LC03" u32 sequence, u32 message bytes, u32 offset, u16 number, u16 fragments;
//             then, in fragment 0 only, channel and NUL; then the payload's part from offset on
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "network/codec.h"

namespace foretouch {

/// Largest datagram that is sent: short ones above it are cut into fragments (liblcm's limit).
inline constexpr std::size_t kMaxShortBytes = 65499;
inline constexpr std::size_t kMaxFragmentPayload = 65487;

/// Why a datagram is none of ours. Counted, never fatal.
enum class DatagramFault : std::uint8_t {
  None,
  Short,       ///< Shorter than its header, or without the channel's end.
  Magic,       ///< Neither short nor fragment.
  Channel,     ///< Empty, too long, or with bytes that are not printable ASCII.
  TooLarge,    ///< Announces a message beyond kMaxMessageBytes.
  Fragment,    ///< Number, offset or size that cannot be part of the message it announces.
  Conflict,    ///< Disagrees with what other fragments of the same message said.
  Repeated,    ///< A fragment that was there already.
  Incomplete,  ///< A message whose missing fragments did not come before it had to make way.
};
inline constexpr std::size_t kNumDatagramFaults =
    static_cast<std::size_t>(DatagramFault::Incomplete) + 1;
[[nodiscard]] const char* toString(DatagramFault fault);

/// What a datagram says; views into it.
struct UdpmDatagram {
  std::uint32_t sequence = 0;
  std::string_view channel;  ///< Empty in fragments other than the first.
  ByteView payload;
  bool isFragment = false;
  std::uint32_t messageBytes = 0, offset = 0;  ///< Of fragments.
  std::uint16_t fragment = 0, fragments = 0;
};

/// Reads any bytes. Pure and bounded; allocates nothing.
[[nodiscard]] DatagramFault parseDatagram(ByteView bytes, UdpmDatagram& datagram);

/// The datagrams of one message, in order: one, or its fragments. Precondition: a legal channel and
/// at most kMaxMessageBytes.
[[nodiscard]] std::vector<Bytes> datagramsOf(std::string_view channel, ByteView payload,
                                             std::uint32_t sequence);

}  // namespace foretouch
