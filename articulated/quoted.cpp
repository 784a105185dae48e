#include "articulated/quoted.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdio>

namespace foretouch {
namespace {

/// Length of the well-formed UTF-8 sequence at the start of `text` (not empty); 0 if there is none.
/// The ranges of second bytes are those of the Unicode Standard, table 3-7.
std::size_t utf8SequenceLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return 0;
  const unsigned char low = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
  const unsigned char high = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
  if (byte(1) < low || byte(1) > high) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if (byte(i) < 0x80 || byte(i) > 0xbf) return 0;
  }
  return length;
}

}  // namespace

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8SequenceLength(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string inQuotes(std::string_view text) {
  constexpr std::size_t kShown = 48;
  constexpr char kHex[] = "0123456789abcdef";
  std::string shown = "'";
  std::size_t at = 0;
  while (at < text.size() && at < kShown) {
    const std::size_t length = utf8SequenceLength(text.substr(at));
    const auto byte = static_cast<unsigned char>(text[at]);
    // U+0080 to U+009F (c2 80 to c2 9f) are control characters too.
    const bool isC1 =
        length == 2 && byte == 0xc2 && static_cast<unsigned char>(text[at + 1]) < 0xa0;
    if (length > 1 ? !isC1 : byte >= 0x20 && byte < 0x7f) {
      shown += text.substr(at, length);
      at += length;
    } else {
      shown += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
      at += 1;
    }
  }
  return shown + (at < text.size() ? "...'" : "'");
}

std::string inDigits(double number, int digits) {
  std::array<char, 32> text;  // 17 digits, sign, point and exponent need 24
#if defined(__cpp_lib_to_chars)
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number,
                                 std::chars_format::general, digits);
  return {text.data(), end.ptr};
#else  // the same digits, but for the point, which a locale may choose
  const int length = std::snprintf(text.data(), text.size(), "%.*g", digits, number);
  std::replace(text.begin(), text.end(), ',', '.');
  return {text.data(), static_cast<std::size_t>(length)};
#endif
}

}  // namespace foretouch
