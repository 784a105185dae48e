// network/wire/payload_check.h: is a payload laid out as its type says? What decoders made by
// lcm-gen take on trust, counts and lengths, is made sure of here first, by one walk that allocates
// nothing.
#pragma once

#include <cstddef>
#include <cstdint>

#include "network/wire/codec.h"
#include "network/wire/messages.h"
#include "network/wire/reject.h"

namespace foretouch {

enum class PayloadType : std::uint8_t { Skeleton, Pose, Contacts, Status };

/// Longest list in a message: joints, links, contacts, words of a status.
inline constexpr std::int32_t kMaxListed = kMaxJoints;

/// None where all of `payload` is one message of this type and version: its fingerprint is right,
/// every count is in [0, kMaxListed], every text within its limit, with its one NUL at its very
/// end, and nothing comes after the last field. Else Limit, Length, Fingerprint or Version. What
/// the numbers mean is not looked at. Linear in the payload's size, which is at most
/// kMaxMessageBytes.
[[nodiscard]] Reject checkPayload(PayloadType type, ByteView payload);

}  // namespace foretouch
