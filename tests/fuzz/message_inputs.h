// tests/fuzz/message_inputs.h: what must hold of any bytes that come as a message. Broken promises
// abort.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Each decodes the bytes. What is accepted is written again as the same bytes (a pose whose joints
/// are not all valid: as a message that is read as the same), and keeps what messages.h says.
/// Returns whether it was accepted.
bool feedSkeletonMessage(const std::uint8_t* data, std::size_t size);
bool feedPoseMessage(const std::uint8_t* data, std::size_t size);
bool feedContactsMessage(const std::uint8_t* data, std::size_t size);
bool feedStatusMessage(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
