// Text of untrusted files: what readableText() lets through.
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "assets/import/text.h"
#include "assets/text_file.h"

namespace foretouch::internal {
namespace {

TEST(ReadableText, KeepsWellFormedTextAsItIs) {
  EXPECT_EQ(readableText("kitchen table", 99), "kitchen table");
  EXPECT_EQ(readableText("Küche 台所 \xF0\x9F\x8D\xB3", 99), "Küche 台所 \xF0\x9F\x8D\xB3");
}

TEST(ReadableText, TurnsControlCharactersIntoSpaces) {
  EXPECT_EQ(readableText("a\x1B[31mb\nc\x7F\x64", 99), "a [31mb c d");
  EXPECT_EQ(readableText("a\xC2\x9B"
                         "31m",
                         99),
            "a 31m");  // C1: the one-byte form of ESC [
  EXPECT_EQ(readableText("\n\t a \r\n", 99), "a");
  EXPECT_EQ(readableText(std::string_view("a\0b", 3), 99), "a b");
}

TEST(ReadableText, ReplacesWhatIsNotUtf8) {
  EXPECT_EQ(readableText("a\xFF\x62", 99), "a\xEF\xBF\xBD\x62");
  EXPECT_EQ(readableText("\xE5\x8F", 99), "\xEF\xBF\xBD\xEF\xBF\xBD");  // cut short
}

TEST(ReadableText, CutsBetweenCharacters) {
  EXPECT_EQ(readableText("abcdef", 3), "abc");
  EXPECT_EQ(readableText("ab台", 4), "ab");
  EXPECT_EQ(readableText("ab台", 5), "ab台");
  EXPECT_EQ(readableText("abc", 0), "");
}

TEST(ReadableText, IsUtf8WithinItsLimitForAnyBytes) {
  std::size_t cut = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    std::mt19937 random(seed);
    std::string bytes(random() % 60, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    const std::string text = readableText(bytes, 40);
    ASSERT_LE(text.size(), 40U) << seed;
    ASSERT_TRUE(isUtf8(text)) << seed;
    for (const char c : text) ASSERT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
    cut += text.size() >= 38;
  }
  EXPECT_GT(cut, 500U);
}

}  // namespace
}  // namespace foretouch::internal
