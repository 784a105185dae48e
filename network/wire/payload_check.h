// network/wire/payload_check.h: does a payload have the layout of its type? Decoders made by
// lcm-gen trust counts and lengths; this checks them first, in one walk that allocates nothing.
#pragma once

#include <cstddef>
#include <cstdint>

#include "network/wire/codec.h"
#include "network/wire/messages.h"

namespace foretouch {

enum class PayloadType : std::uint8_t {
  Skeleton,
  Pose,
  Contacts,
  Solid,
  Status,
  Speaker,
  Body,
  RigidPose,
  Events,
  Pushes,
  Person
};

/// Longest list in a message: joints, links, contacts, words of a status.
inline constexpr std::int32_t kMaxListed = kMaxJoints;

/// None if all of `payload` is one message of this type and version: its fingerprint is right,
/// every count is in [0, kMaxListed], every text is within its limit with its one NUL at its very
/// end, and nothing comes after the last field. Else Limit, Length, Fingerprint or Version. Does
/// not check what the numbers mean. Linear in the payload's size, which is at most
/// kMaxMessageBytes.
[[nodiscard]] Reject checkPayload(PayloadType type, ByteView payload);

}  // namespace foretouch
