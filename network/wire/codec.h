// network/wire/codec.h: messages to bytes and back. Decoding trusts nothing: it checks every count
// and length, in bounded time, before it allocates anything; then lcm-gen's own decoder reads the
// checked bytes, and we check the values (finite, unit, in range). Pure: no clock, no socket.
//
// Any lcm-gen type of network/lcm can decode the output of encode(); decode() accepts the output of
// any lcm-gen sender, without bytes after it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "network/wire/messages.h"

namespace foretouch {

struct BodyMessage;
struct RigidPoseMessage;
struct EventsMessage;
struct PushesMessage;

using Bytes = std::vector<std::uint8_t>;

/// Unowned bytes.
struct ByteView {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;

  ByteView() = default;
  ByteView(const std::uint8_t* bytes, std::size_t count) : data(bytes), size(count) {}
  ByteView(const Bytes& bytes) : data(bytes.data()), size(bytes.size()) {}  // NOLINT: implicit
};

/// Each fills `message` and returns Reject::None, or returns the reason why not; `message` is then
/// meaningless. Reuses the memory of `message`.
[[nodiscard]] Reject decode(ByteView payload, SkeletonMessage& message);
[[nodiscard]] Reject decode(ByteView payload, PoseMessage& message);
[[nodiscard]] Reject decode(ByteView payload, ContactsMessage& message);
[[nodiscard]] Reject decode(ByteView payload, SolidMessage& message);
[[nodiscard]] Reject decode(ByteView payload, PersonMessage& message);
[[nodiscard]] Reject decode(ByteView payload, StatusMessage& message);
[[nodiscard]] Reject decode(ByteView payload, SpeakerMessage& message);
// network/wire/world_messages.h.
[[nodiscard]] Reject decode(ByteView payload, BodyMessage& message);
[[nodiscard]] Reject decode(ByteView payload, RigidPoseMessage& message);
[[nodiscard]] Reject decode(ByteView payload, EventsMessage& message);
[[nodiscard]] Reject decode(ByteView payload, PushesMessage& message);

/// Replaces `payload`. Precondition (asserted): counts and texts within the limits.
void encode(const SkeletonMessage& message, Bytes& payload);
void encode(const PoseMessage& message, Bytes& payload);
void encode(const ContactsMessage& message, Bytes& payload);
void encode(const SolidMessage& message, Bytes& payload);
void encode(const PersonMessage& message, Bytes& payload);
void encode(const StatusMessage& message, Bytes& payload);
void encode(const SpeakerMessage& message, Bytes& payload);
void encode(const BodyMessage& message, Bytes& payload);
void encode(const RigidPoseMessage& message, Bytes& payload);
void encode(const EventsMessage& message, Bytes& payload);
void encode(const PushesMessage& message, Bytes& payload);

/// The part of an encoded contacts_t, solid_t, person_t, events_t or pushes_t that depends only on
/// poses, scene and options: all but the two stamps and the time that it took, at its end (24
/// bytes). A replay repeats it byte for byte.
[[nodiscard]] ByteView verdictBytes(ByteView payload);

}  // namespace foretouch
