// tests/house/cpp_tokens.h: the words and signs of C++ text, without comments, preprocessor lines
// and quoted text.
#pragma once

#include <string>
#include <vector>

namespace foretouch::house {

struct Token {
  std::string text;
  int line = 0;  ///< Counted from 1.
};

/// A literal in quotes is the token `""`.
[[nodiscard]] std::vector<Token> cppTokens(const std::string& source);

}  // namespace foretouch::house
