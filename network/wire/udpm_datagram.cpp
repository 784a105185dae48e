#include "network/wire/udpm_datagram.h"

#include <algorithm>
#include <cstring>

#include "lss/assert.h"
#include "network/wire/messages.h"

namespace foretouch {
namespace {

constexpr std::uint32_t kShortMagic = 0x4c433032;     // "LC02"
constexpr std::uint32_t kFragmentMagic = 0x4c433033;  // "LC03"
constexpr std::size_t kShortHeaderBytes = 8;
constexpr std::size_t kFragmentHeaderBytes = 20;

std::uint32_t readU32(const std::uint8_t* from) {
  return std::uint32_t{from[0]} << 24 | std::uint32_t{from[1]} << 16 | std::uint32_t{from[2]} << 8 |
         from[3];
}

std::uint16_t readU16(const std::uint8_t* from) {
  return static_cast<std::uint16_t>(from[0] << 8 | from[1]);
}

void appendU16(Bytes& bytes, std::size_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
  bytes.push_back(static_cast<std::uint8_t>(value));
}

void appendU32(Bytes& bytes, std::size_t value) {
  appendU16(bytes, value >> 16);
  appendU16(bytes, value);
}

void appendChannel(Bytes& bytes, std::string_view channel) {
  bytes.insert(bytes.end(), channel.begin(), channel.end());
  bytes.push_back(0);
}

/// Splits "channel NUL payload".
DatagramFault readChannel(ByteView bytes, UdpmDatagram& datagram) {
  const std::size_t searched = std::min(bytes.size, kMaxChannelBytes + 1);
  const void* end = searched == 0 ? nullptr : std::memchr(bytes.data, 0, searched);
  if (end == nullptr) {
    return bytes.size > kMaxChannelBytes ? DatagramFault::Channel : DatagramFault::Short;
  }
  const auto length = static_cast<std::size_t>(static_cast<const std::uint8_t*>(end) - bytes.data);
  datagram.channel = {reinterpret_cast<const char*>(bytes.data), length};
  if (!isLegalChannel(datagram.channel)) return DatagramFault::Channel;
  datagram.payload = {bytes.data + length + 1, bytes.size - length - 1};
  return DatagramFault::None;
}

/// Whether this part can be one of `fragments` parts of at least a byte each that make up the
/// message in order.
bool canBePart(const UdpmDatagram& datagram) {
  const std::uint64_t end = std::uint64_t{datagram.offset} + datagram.payload.size;
  if (datagram.fragments > kMaxFragments || datagram.fragment >= datagram.fragments) return false;
  if (datagram.payload.size == 0 || end > datagram.messageBytes) return false;
  const std::uint64_t before = datagram.fragment;
  const std::uint64_t after = datagram.fragments - before - 1;
  const std::uint64_t bytesAfter = datagram.messageBytes - end;
  return datagram.offset >= before && bytesAfter >= after &&
         (datagram.offset == 0) == (before == 0) && (bytesAfter == 0) == (after == 0);
}

DatagramFault readFragment(ByteView bytes, UdpmDatagram& datagram) {
  if (bytes.size < kFragmentHeaderBytes) return DatagramFault::Short;
  datagram.isFragment = true;
  datagram.messageBytes = readU32(bytes.data + 8);
  datagram.offset = readU32(bytes.data + 12);
  datagram.fragment = readU16(bytes.data + 16);
  datagram.fragments = readU16(bytes.data + 18);
  datagram.payload = {bytes.data + kFragmentHeaderBytes, bytes.size - kFragmentHeaderBytes};
  if (datagram.messageBytes > kMaxMessageBytes) return DatagramFault::TooLarge;
  if (datagram.fragment == 0) {
    const DatagramFault fault = readChannel(datagram.payload, datagram);
    if (fault != DatagramFault::None) return fault;
  }
  return canBePart(datagram) ? DatagramFault::None : DatagramFault::Fragment;
}

Bytes shortDatagram(std::string_view channel, ByteView payload, std::uint32_t sequence) {
  Bytes bytes;
  bytes.reserve(kShortHeaderBytes + channel.size() + 1 + payload.size);
  appendU32(bytes, kShortMagic);
  appendU32(bytes, sequence);
  appendChannel(bytes, channel);
  bytes.insert(bytes.end(), payload.data, payload.data + payload.size);
  return bytes;
}

}  // namespace

const char* toString(DatagramFault fault) {
  switch (fault) {
    case DatagramFault::None: return "none";
    case DatagramFault::Short: return "short";
    case DatagramFault::Magic: return "magic";
    case DatagramFault::Channel: return "channel";
    case DatagramFault::TooLarge: return "too-large";
    case DatagramFault::Fragment: return "fragment";
    case DatagramFault::Conflict: return "conflict";
    case DatagramFault::Repeated: return "repeated";
    case DatagramFault::Incomplete: return "incomplete";
    case DatagramFault::Osc: return "osc";
  }
  return "none";
}

bool isLegalChannel(std::string_view channel) {
  const auto isPrintable = [](char c) { return c >= 0x20 && c <= 0x7e; };
  return !channel.empty() && channel.size() <= kMaxChannelBytes &&
         std::all_of(channel.begin(), channel.end(), isPrintable);
}

DatagramFault parseDatagram(ByteView bytes, UdpmDatagram& datagram) {
  datagram = {};
  if (bytes.size < kShortHeaderBytes) return DatagramFault::Short;
  const std::uint32_t magic = readU32(bytes.data);
  datagram.sequence = readU32(bytes.data + 4);
  if (magic == kFragmentMagic) return readFragment(bytes, datagram);
  if (magic != kShortMagic) return DatagramFault::Magic;
  return readChannel({bytes.data + kShortHeaderBytes, bytes.size - kShortHeaderBytes}, datagram);
}

std::vector<Bytes> datagramsOf(std::string_view channel, ByteView payload, std::uint32_t sequence) {
  FORETOUCH_ASSERT(isLegalChannel(channel) && payload.size <= kMaxMessageBytes);
  const std::size_t channelBytes = channel.size() + 1;
  const std::size_t total = channelBytes + payload.size;
  if (total <= kMaxShortBytes) return {shortDatagram(channel, payload, sequence)};

  const std::size_t fragments = (total + kMaxFragmentBytes - 1) / kMaxFragmentBytes;
  std::vector<Bytes> datagrams(fragments);
  std::size_t offset = 0;
  for (std::size_t fragment = 0; fragment < fragments; ++fragment) {
    const std::size_t room = kMaxFragmentBytes - (fragment == 0 ? channelBytes : 0);
    const std::size_t part = std::min(room, payload.size - offset);
    Bytes& bytes = datagrams[fragment];
    bytes.reserve(kFragmentHeaderBytes + kMaxFragmentBytes);
    appendU32(bytes, kFragmentMagic);
    appendU32(bytes, sequence);
    appendU32(bytes, payload.size);
    appendU32(bytes, offset);
    appendU16(bytes, fragment);
    appendU16(bytes, fragments);
    if (fragment == 0) appendChannel(bytes, channel);
    bytes.insert(bytes.end(), payload.data + offset, payload.data + offset + part);
    offset += part;
  }
  return datagrams;
}

}  // namespace foretouch
