#include "tools/report/base64.h"

#include <cstdint>

namespace foretouch::tools {
namespace {

constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

char letter(std::uint32_t bits, int place) {
  constexpr std::uint32_t kSixBits = 0x3f;
  return kAlphabet[(bits >> (6 * place)) & kSixBits];
}

}  // namespace

void appendBase64(const unsigned char* bytes, std::size_t size, std::string& text) {
  std::size_t at = 0;
  for (; at + 3 <= size; at += 3) {
    const std::uint32_t bits = std::uint32_t{bytes[at]} << 16 | std::uint32_t{bytes[at + 1]} << 8 |
                               std::uint32_t{bytes[at + 2]};
    const char four[] = {letter(bits, 3), letter(bits, 2), letter(bits, 1), letter(bits, 0)};
    text.append(four, sizeof four);
  }
  if (at == size) return;
  const bool isTwo = at + 2 == size;
  const std::uint32_t bits =
      std::uint32_t{bytes[at]} << 16 | (isTwo ? std::uint32_t{bytes[at + 1]} << 8 : 0u);
  const char four[] = {letter(bits, 3), letter(bits, 2), isTwo ? letter(bits, 1) : '=', '='};
  text.append(four, sizeof four);
}

}  // namespace foretouch::tools
