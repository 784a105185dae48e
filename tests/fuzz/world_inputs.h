// tests/fuzz/world_inputs.h: world files, and tables of a prop's poses. A broken promise aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Errors name the file and one of its lines; an accepted world is within the limits of
/// tools/world/world_file.h.
bool feedWorldFile(const std::uint8_t* data, std::size_t size);

/// Errors name the file; accepted poses are legal, and later ones are behind earlier ones.
bool feedRigidPoses(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
