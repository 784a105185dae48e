#include "tools/report/base64.h"

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"
#include "tests/tools/report/view_reading.h"

namespace foretouch::tools {
namespace {

std::string base64(const std::string& text) {
  std::string encoded;
  appendBase64(reinterpret_cast<const unsigned char*>(text.data()), text.size(), encoded);
  return encoded;
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, DecodesBackForAnyBytes) {
  for (int i = 0; i < 500; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    std::string bytes(static_cast<std::size_t>(random.uniform(0, 40)), '\0');
    for (char& byte : bytes) byte = static_cast<char>(random.uniform(0, 255.999));
    const auto back = test::fromBase64(base64(bytes));
    EXPECT_EQ(std::string(back.begin(), back.end()), bytes) << "case " << i;
  }
}

}  // namespace
}  // namespace foretouch::tools
