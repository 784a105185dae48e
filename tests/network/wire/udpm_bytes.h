// tests/network/wire/udpm_bytes.h: hand-made datagrams, right and wrong ones; shares no code with
// network/.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace foretouch::test {

using RawBytes = std::vector<std::uint8_t>;

inline void append(RawBytes& bytes, std::uint64_t value, int size) {
  for (int i = size - 1; i >= 0; --i) {
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
}

inline void append(RawBytes& bytes, const std::string& text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

/// `channelAndNul`: as it should be in the datagram, with the NUL if there should be one.
inline RawBytes shortOf(std::uint32_t sequence, const std::string& channelAndNul,
                        const std::string& payload = "") {
  RawBytes bytes;
  append(bytes, "LC02");
  append(bytes, sequence, 4);
  append(bytes, channelAndNul);
  append(bytes, payload);
  return bytes;
}

struct FragmentHeader {
  std::uint32_t sequence = 7, messageBytes = 0, offset = 0;
  std::uint16_t fragment = 0, fragments = 1;
};

inline RawBytes fragmentOf(const FragmentHeader& header, const std::string& rest) {
  RawBytes bytes;
  append(bytes, "LC03");
  append(bytes, header.sequence, 4);
  append(bytes, header.messageBytes, 4);
  append(bytes, header.offset, 4);
  append(bytes, header.fragment, 2);
  append(bytes, header.fragments, 2);
  append(bytes, rest);
  return bytes;
}

inline std::string withNul(const std::string& channel) {
  return channel + std::string(1, '\0');
}

/// The fragments of a message, cut at these sizes (the last one is the rest).
inline std::vector<RawBytes> cut(const std::string& channel, const RawBytes& payload,
                                 std::uint32_t sequence, const std::vector<std::size_t>& sizes) {
  std::vector<RawBytes> fragments;
  std::size_t offset = 0;
  for (std::size_t i = 0; i <= sizes.size(); ++i) {
    const std::size_t size = i < sizes.size() ? sizes[i] : payload.size() - offset;
    const auto from = payload.begin() + static_cast<std::ptrdiff_t>(offset);
    const std::string part(from, from + static_cast<std::ptrdiff_t>(size));
    const FragmentHeader header{sequence, static_cast<std::uint32_t>(payload.size()),
                                static_cast<std::uint32_t>(offset), static_cast<std::uint16_t>(i),
                                static_cast<std::uint16_t>(sizes.size() + 1)};
    fragments.push_back(fragmentOf(header, (i == 0 ? withNul(channel) : "") + part));
    offset += size;
  }
  return fragments;
}

}  // namespace foretouch::test
