// bindings/snake_case.h: the library's names of options as other languages write them.
#pragma once

#include <cctype>
#include <string>

namespace foretouch {

/// "catchUp" is "catch_up"; ASCII.
[[nodiscard]] inline std::string snakeCase(const std::string& name) {
  std::string words;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isupper(letter) != 0) words += '_';
    words += static_cast<char>(std::tolower(letter));
  }
  return words;
}

}  // namespace foretouch
