// tests/fuzz/message_inputs.h: invariants for any bytes as a message. A broken one aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Each decodes the bytes. An accepted message encodes to the same bytes (a pose whose joints are
/// not all valid, and a solid_t: to a message that decodes to the same), and meets the rules of
/// messages.h. Returns whether it was accepted.
bool feedSkeletonMessage(const std::uint8_t* data, std::size_t size);
bool feedPoseMessage(const std::uint8_t* data, std::size_t size);
bool feedContactsMessage(const std::uint8_t* data, std::size_t size);
bool feedSolidMessage(const std::uint8_t* data, std::size_t size);
bool feedPersonMessage(const std::uint8_t* data, std::size_t size);
bool feedSpeakerMessage(const std::uint8_t* data, std::size_t size);
bool feedStatusMessage(const std::uint8_t* data, std::size_t size);
// Of network/wire/world_messages.h.
bool feedBodyMessage(const std::uint8_t* data, std::size_t size);
bool feedRigidPoseMessage(const std::uint8_t* data, std::size_t size);
bool feedEventsMessage(const std::uint8_t* data, std::size_t size);
bool feedPushesMessage(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
