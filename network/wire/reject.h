// network/wire/reject.h: why a message was not accepted. Every refusal counts under one of these
// words; none is fatal, and none gets an answer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace foretouch {

enum class Reject : std::uint8_t {
  None,
  // About the bytes.
  Length,        ///< Shorter or longer than its own counts say, or a text without its end.
  Fingerprint,   ///< Of another type, or of another version of it.
  Version,       ///< The `version` field is not kMessageVersion.
  Limit,         ///< A count beyond its limit.
  NonFinite,     ///< NaN or infinity in a joint that is marked valid, or in another message.
  NonUnit,       ///< A quaternion whose norm is off by more than kMaxQuaternionNormError.
  OutOfRange,    ///< A finite number outside its range: a coordinate, a time, a flag.
  BadName,       ///< Not a legal joint name, or one that a skeleton has twice.
  BadIndex,      ///< A joint or link that cannot exist, or one that is listed twice.
  BadHierarchy,  ///< A parent after its child.
  BadHash,       ///< A skeleton whose hash is not that of its content.
  // About the content.
  UnknownAvatar,     ///< The service does not have this avatar.
  NoMatch,           ///< A skeleton without any joint name of the avatar's.
  OldGeneration,     ///< A skeleton older than the one in use.
  UnknownSkeleton,   ///< A pose before any skeleton.
  SkeletonMismatch,  ///< A pose of another skeleton than the one in use.
  // About its place in the stream.
  Duplicate,      ///< The same session, sequence and capture time again.
  OutOfOrder,     ///< Older than a pose that has been answered.
  StaleStamp,     ///< A later sequence with a capture time that is not later.
  FutureStamp,    ///< Captured longer than StreamPolicy::maxStepUs after the last pose.
  OldSession,     ///< From a sender that has been restarted since.
  FutureSession,  ///< Of a sender that says it starts more than a day after the message arrived.
  Late,           ///< Of an instant that the world has answered already.
  // About a moving world.
  UnknownBody,   ///< A pose of a body that nobody has told of; a carrier or link that is not there.
  HeldFast,      ///< A pose of a body that another one holds fast.
  UnknownShape,  ///< A body whose shape is not in the world file.
  CarrierLoop,   ///< A body that would carry itself.
  SolidCarrier,  ///< A body that a solid one would carry.
  // About who says it.
  OtherSender,      ///< Not from the address and port that speak for the avatar.
  Unauthenticated,  ///< Without the code that the key makes, or with another one.
  Replayed,         ///< With a right code, and old, or of a time that is not now.
  // About the service.
  Overrun,  ///< The oldest waiting pose when the queue was full.
};
inline constexpr std::size_t kNumRejects = static_cast<std::size_t>(Reject::Overrun) + 1;

/// A stable word, as it appears in status_t and in metrics: "out-of-order"; "none".
[[nodiscard]] const char* toString(Reject reject);

/// The number of refusals for each reason.
using RejectCounts = std::array<std::uint64_t, kNumRejects>;

}  // namespace foretouch
