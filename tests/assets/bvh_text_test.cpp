// The reader's words and numbers, apart from the files they come in.
#include "assets/bvh/bvh_text.h"

#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "articulated/clip.h"

namespace foretouch::internal {
namespace {

TEST(BvhScanner, CountsLinesWhateverEndsThem) {
  BvhScanner scanner("a\nb\r\nc\rd\n\r\ne");
  const std::int64_t expected[] = {1, 2, 3, 4, 6};
  for (const std::int64_t line : expected) EXPECT_EQ(scanner.next().line, line);
  EXPECT_TRUE(scanner.next().text.empty());
}

TEST(BvhScanner, SplitsBracesAlwaysAndColonsWhereAsked) {
  BvhScanner scanner("a:b{c}d : e");
  EXPECT_EQ(scanner.next().text, "a:b");
  EXPECT_EQ(scanner.next().text, "{");
  EXPECT_EQ(scanner.next().text, "c");
  EXPECT_EQ(scanner.next().text, "}");
  EXPECT_EQ(scanner.next(BvhScanner::Colon::Separate).text, "d");
  EXPECT_EQ(scanner.peek(BvhScanner::Colon::Separate).text, ":");
  EXPECT_EQ(scanner.next(BvhScanner::Colon::Separate).text, ":");
  EXPECT_EQ(scanner.next().text, "e");
}

TEST(BvhScanner, NamesRunToTheEndOfTheLineOrABrace) {
  BvhScanner scanner("  Left Arm \t\n{ Right:Arm{");
  EXPECT_EQ(scanner.nextName().text, "Left Arm");
  EXPECT_EQ(scanner.next().text, "{");
  EXPECT_EQ(scanner.nextName().text, "Right:Arm");
}

TEST(ReadBvhNumber, ReadsBackWhatPrintfWrites) {
  int large = 0;
  for (int seed = 0; seed < 2000; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const double exponent = std::uniform_real_distribution<>(-300, 300)(random);
    const double value = (seed % 2 == 0 ? 1 : -1) * std::pow(10.0, exponent);
    char text[64];
    std::snprintf(text, sizeof text, "%.17g", value);
    const BvhNumber number = readBvhNumber(text);
    ASSERT_EQ(number.problem, nullptr) << text;
    EXPECT_EQ(number.value, value) << text;
    large += std::abs(value) > 1.0 ? 1 : 0;
  }
  EXPECT_GT(large, 800);
  EXPECT_LT(large, 1200);
}

TEST(ReadBvhNumber, TellsTooLargeFromTooSmall) {
  const std::string zeros(2000, '0');
  const std::string small[] = {"1e-400",           "-1e-99999999999999",
                               "0." + zeros + "1", "1" + zeros + "e-4000",
                               "0.0000001e-320",   "0e99999"};
  for (const std::string& text : small) {
    const BvhNumber number = readBvhNumber(text);
    EXPECT_EQ(number.problem, nullptr) << text;
    EXPECT_EQ(number.value, 0.0) << text;
  }
  const std::string large[] = {"1e400", "1e99999999999999", "1" + zeros, "0." + zeros + "1e4000",
                               "123456789e303"};
  for (const std::string& text : large) {
    EXPECT_EQ(readBvhNumber(text).code, ErrorCode::NonFinite) << text;
    EXPECT_NE(readBvhNumber(text).problem, nullptr) << text;
  }
}

TEST(ClipNotes, SaysNothingOfNotesLeftOutWhereNoneWere) {
  ClipNotes notes;
  for (std::size_t i = 0; i + 1 < kMaxClipNotes; ++i) notes.add("n");
  const auto taken = notes.take();
  EXPECT_EQ(taken.size(), kMaxClipNotes - 1);
  EXPECT_EQ(taken.back(), "n");
}

}  // namespace
}  // namespace foretouch::internal
