// Where the standard library reads doubles itself, it is the oracle of how we do without.
#include "assets/decimal.h"

#include <cmath>
#include <cstring>
#include <string>
#include <system_error>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

#if defined(__cpp_lib_to_chars)

void expectSame(const std::string& text) {
  SCOPED_TRACE(text);
  double expected = 7.0, found = 7.0;
  const char* const end = text.data() + text.size();
  const auto ours = internal::readDecimalByStrtod(text.data(), end, found);
  const auto theirs = std::from_chars(text.data(), end, expected);
  EXPECT_EQ(ours.ec, theirs.ec);
  EXPECT_EQ(ours.ptr - text.data(), theirs.ptr - text.data());
  EXPECT_TRUE((std::isnan(found) && std::isnan(expected)) ||
              std::memcmp(&found, &expected, sizeof found) == 0);
}

TEST(ReadDecimal, ByStrtodIsAsTheStandardLibrarysOwn) {
  for (const char* const text :
       {"",       "-",        "+1",      "1",    "-1.5",     "1.",     ".5",    ".",
        "-.",     "1e",       "1e+",     "1e5x", "1e-5",     "1E+05",  "0x10",  "inf",
        "-inf",   "Infinity", "infin",   "nan",  "-NaN",     "nan(7)", "nan(",  "1e400",
        "-1e400", "1e-400",   "0e999",   "-0",   "4.9e-324", "2e-324", " 1",    "1 ",
        "1.#INF", "1,5",      "0.1e1e1", "--1",  "1.5.5",    "1e5.5",  "00012", "1e0000005"}) {
    expectSame(text);
  }
}

TEST(ReadDecimal, ByStrtodIsTheSameOfAnyText) {
  const std::string letters = "0123456789+-.eEinfa()x ";
  int numbers = 0;
  for (int i = 0; i < 50000; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    std::string text;
    const int length = random.below(12);
    for (int k = 0; k < length; ++k) {
      // Digits half the time, so that most texts begin with a number.
      text += letters[static_cast<std::size_t>(
          random.chance(0.5) ? random.below(10) : random.below(static_cast<int>(letters.size())))];
    }
    expectSame(text);
    double value = 0.0;
    numbers += std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc{};
    if (HasFailure()) return;
  }
  EXPECT_GT(numbers, 10000);
}

#endif

TEST(ReadDecimal, ReadsNumbersToTheLastBit) {
  const std::string text = "0.1 ";
  double value = 0.0;
  const auto read = internal::readDecimal(text.data(), text.data() + text.size(), value);
  EXPECT_EQ(read.ptr - text.data(), 3);
  EXPECT_EQ(value, 0.1);
}

}  // namespace
}  // namespace foretouch
