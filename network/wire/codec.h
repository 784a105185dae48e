// network/wire/codec.h: messages to bytes and back. Decoding trusts nothing: a bounded check of
// every count and length comes before anything is allocated; then lcm-gen's own decoder reads what
// has been found sound, and values are checked (finite, unit, in range). Pure: no clock, no socket.
//
// encode() writes what any lcm-gen type of network/lcm decodes; decode accepts what any lcm-gen
// sender encodes, and nothing after it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "network/wire/messages.h"
#include "network/wire/reject.h"

namespace foretouch {

using Bytes = std::vector<std::uint8_t>;

/// Unowned bytes.
struct ByteView {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;

  ByteView() = default;
  ByteView(const std::uint8_t* bytes, std::size_t count) : data(bytes), size(count) {}
  ByteView(const Bytes& bytes) : data(bytes.data()), size(bytes.size()) {}  // NOLINT: implicit
};

/// Each fills `message` and returns Reject::None, or says why not; `message` then means nothing.
/// Memory of `message` is reused.
[[nodiscard]] Reject decode(ByteView payload, SkeletonMessage& message);
[[nodiscard]] Reject decode(ByteView payload, PoseMessage& message);
[[nodiscard]] Reject decode(ByteView payload, ContactsMessage& message);
[[nodiscard]] Reject decode(ByteView payload, StatusMessage& message);

/// Replaces `payload`. Precondition (asserted): counts and texts within the limits.
void encode(const SkeletonMessage& message, Bytes& payload);
void encode(const PoseMessage& message, Bytes& payload);
void encode(const ContactsMessage& message, Bytes& payload);
void encode(const StatusMessage& message, Bytes& payload);

/// The part of an encoded contacts_t that poses, scene and options decide: all but the two stamps
/// and the query's time at its end (24 bytes). What a replay repeats, byte for byte.
[[nodiscard]] ByteView verdictBytes(ByteView contactsPayload);

}  // namespace foretouch
