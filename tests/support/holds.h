// tests/support/holds.h: does a text contain another one?
#pragma once

#include <string>

namespace foretouch::test {

[[nodiscard]] inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace foretouch::test
