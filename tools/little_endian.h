// tools/little_endian.h: numbers as the bytes of a binary file. Every format here is little-endian,
// and so is every supported machine.
#pragma once

#include <cstring>
#include <string>

namespace foretouch::tools {

template <typename T>
void appendBytes(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

}  // namespace foretouch::tools
