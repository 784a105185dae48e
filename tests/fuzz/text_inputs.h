// tests/fuzz/text_inputs.h: small texts that people write or copy: tables, maps, addresses, project
// files. A broken promise aborts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::fuzz {

/// Joint positions as CSV.
bool feedJointTable(const std::uint8_t* data, std::size_t size);
bool feedNpz(const std::uint8_t* data, std::size_t size);

/// The file of --map.
bool feedJointMap(const std::uint8_t* data, std::size_t size);

/// A URL of a stream, and an address of HTTP.
bool feedUrl(const std::uint8_t* data, std::size_t size);

/// A project file, taken by all settings of a replay.
bool feedProject(const std::uint8_t* data, std::size_t size);

}  // namespace foretouch::fuzz
