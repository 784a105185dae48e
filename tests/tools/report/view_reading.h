// tests/tools/report/view_reading.h: reads view documents as a page does, with independent code.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tools/report/view_writer.h"

namespace foretouch::test {

/// Digit by digit, by the table of RFC 4648; independent of the encoder.
inline std::vector<unsigned char> fromBase64(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  EXPECT_EQ(text.size() % 4, 0u);
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit = alphabet.find(c);
    EXPECT_NE(digit, std::string::npos) << c;
    for (int bit = 5; bit >= 0; --bit) {
      bits = bits << 1 | (static_cast<unsigned>(digit) >> bit & 1u);
      if (++count % 8 == 0) bytes.push_back(static_cast<unsigned char>(bits & 0xffu));
    }
  }
  return bytes;
}

/// The numbers of a typed array of this type.
template <typename Number>
std::vector<Number> numbersOf(const nlohmann::json& array, const char* type) {
  EXPECT_EQ(array.size(), 1u);
  const std::vector<unsigned char> bytes = fromBase64(array.at(type).get<std::string>());
  EXPECT_EQ(bytes.size() % sizeof(Number), 0u);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

inline std::string textOf(const tools::ViewDocument& document) {
  std::string text;
  tools::writeView(document, [&text](const std::string& piece) { text += piece; });
  return text;
}

/// The text between the page's marker and the end of its element.
inline std::string documentIn(const std::string& page) {
  const std::string marker = R"(<script type="application/json" id="foretouch-view">)";
  const std::size_t begin = page.find(marker);
  EXPECT_NE(begin, std::string::npos);
  if (begin == std::string::npos) return "";
  return page.substr(begin + marker.size(), page.find("</script>", begin) - begin - marker.size());
}

}  // namespace foretouch::test
