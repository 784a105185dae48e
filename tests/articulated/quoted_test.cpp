// Texts and numbers in messages.
#include "articulated/quoted.h"

#include <limits>

#include <gtest/gtest.h>

namespace foretouch {
namespace {

TEST(InDigits, AreThoseAskedForWithoutTrailingZeros) {
  EXPECT_EQ(inDigits(0.5), "0.5");
  EXPECT_EQ(inDigits(1.0 / 3.0), "0.333333");
  EXPECT_EQ(inDigits(1.0 / 3.0, 3), "0.333");
  EXPECT_EQ(inDigits(-12345678.0), "-1.23457e+07");
  EXPECT_EQ(inDigits(-std::numeric_limits<double>::denorm_min(), 17), "-4.9406564584124654e-324");
}

TEST(InQuotes, ShowsLettersOfEveryLanguageAndNoControlCharacters) {
  EXPECT_EQ(inQuotes("a\xc2\xa0\xc3\xa9"), "'a\xc2\xa0\xc3\xa9'");
  EXPECT_EQ(inQuotes("\xc2\x85"), R"('\xc2\x85')");
  EXPECT_EQ(inQuotes("\xc3\xa9\xc2\x9f"), "'\xc3\xa9\\xc2\\x9f'");
}

TEST(InQuotes, ShowsWhatCannotBePrintedAndCutsWhatIsLong) {
  EXPECT_EQ(inQuotes("Hand"), "'Hand'");
  EXPECT_EQ(inQuotes("a\nb"), R"('a\x0ab')");
  EXPECT_EQ(inQuotes(std::string(10'000, 'x')).substr(0, 3), "'xx");
  EXPECT_LT(inQuotes(std::string(10'000, 'x')).size(), 300u);
}

}  // namespace
}  // namespace foretouch
