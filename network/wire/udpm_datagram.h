// network/wire/udpm_datagram.h: one datagram of LCM's UDP multicast protocol ("UDPM"), as bytes.
// Integers are big-endian. Source: lcm-proj/lcm, docs/content/udp-multicast-protocol.md. Short:
// "LC02", u32 sequence, channel, NUL, payload. Fragment: "LC03", u32 sequence, u32 message bytes,
// u32 offset, u16 number, u16 fragments; then, in fragment 0 only, channel and NUL; then the
// payload's part from offset on. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "network/wire/codec.h"

namespace foretouch {

/// Channel, NUL and payload of the largest short datagram, and of a fragment: where liblcm cuts.
/// Received messages may be cut smaller (1423 bytes on macOS).
inline constexpr std::size_t kMaxShortBytes = 65499;
inline constexpr std::size_t kMaxFragmentBytes = 65487;
/// Fragments of one message: more than kMaxMessageBytes needs in the smallest cuts in use.
inline constexpr std::size_t kMaxFragments = 4096;
inline constexpr std::size_t kMaxDatagramBytes = 65507;  ///< The limit of UDP over IPv4.

/// Why a datagram is not valid. Counted, never fatal.
enum class DatagramFault : std::uint8_t {
  None,
  Short,       ///< Shorter than its header, or without the channel's end.
  Magic,       ///< Neither short nor fragment.
  Channel,     ///< Empty, too long, or with bytes that are not printable ASCII.
  TooLarge,    ///< Announces a message beyond kMaxMessageBytes.
  Fragment,    ///< Number, offset or size that cannot be part of the message it announces.
  Conflict,    ///< Disagrees with other fragments of the same message.
  Repeated,    ///< A fragment that came before.
  Incomplete,  ///< A message dropped before its missing fragments came.
  Osc,         ///< At a VMC port: not a whole OSC packet.
};
inline constexpr std::size_t kNumDatagramFaults =
    static_cast<std::size_t>(DatagramFault::Osc) + 1;
[[nodiscard]] const char* toString(DatagramFault fault);

/// The content of a datagram; views into it.
struct UdpmDatagram {
  std::uint32_t sequence = 0;
  std::string_view channel;  ///< Empty in fragments other than the first.
  ByteView payload;
  bool isFragment = false;
  std::uint32_t messageBytes = 0, offset = 0;  ///< Only in fragments.
  std::uint16_t fragment = 0, fragments = 0;
};

/// 1 to kMaxChannelBytes bytes of printable ASCII.
[[nodiscard]] bool isLegalChannel(std::string_view channel);

/// Reads any bytes. Pure and bounded; allocates nothing.
[[nodiscard]] DatagramFault parseDatagram(ByteView bytes, UdpmDatagram& datagram);

/// The datagrams of one message, in order: one, or its fragments. Precondition: a legal channel and
/// at most kMaxMessageBytes.
[[nodiscard]] std::vector<Bytes> datagramsOf(std::string_view channel, ByteView payload,
                                             std::uint32_t sequence);

}  // namespace foretouch
