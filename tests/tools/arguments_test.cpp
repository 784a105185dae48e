#include "tools/arguments.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace foretouch::tools {
namespace {

TEST(ParseNumber, TakesDecimalNumbersOfAnySign) {
  EXPECT_EQ(parseNumber("--x", "0.25").value(), 0.25);
  EXPECT_EQ(parseNumber("--x", "-3").value(), -3.0);
  EXPECT_EQ(parseNumber("--x", "1e-3").value(), 0.001);
}

TEST(ParseNumber, RefusesWhatIsNotOneFiniteNumberNamingTheOption) {
  for (const char* text : {"", " ", "nan", "inf", "-inf", "1e999", "0x10", "1,5", "1 ", " 1", "1m",
                           "--", "+1", "1e"}) {
    const auto parsed = parseNumber("--scale", text);
    ASSERT_FALSE(parsed.ok()) << text;
    EXPECT_EQ(parsed.error().file, "--scale");
    EXPECT_NE(parsed.error().message.find("expected a finite number"), std::string::npos);
  }
}

TEST(ParsePositive, RefusesZeroAndLess) {
  EXPECT_EQ(parsePositive("--rate", "29.97").value(), 29.97);
  EXPECT_EQ(parsePositive("--rate", "5e-324").value(), std::numeric_limits<double>::denorm_min());
  for (const char* text : {"0", "-0", "-1", "nan", "1e-999"}) {
    EXPECT_FALSE(parsePositive("--rate", text).ok()) << text;
  }
}

TEST(ParseTolerance, GoesFromTheLeastToTheLargestToleranceOfTheQuery) {
  EXPECT_EQ(parseTolerance("--tolerance", "1e7").value(), kMaxTolerance);
  EXPECT_EQ(parseTolerance("--tolerance", "1e-9").value(), kMinTolerance);
  for (const char* text : {"0", "-0.001", "nan", "inf", "9.9e-10", "1.1e7", "1e300", "thin"}) {
    EXPECT_FALSE(parseTolerance("--tolerance", text).ok()) << text;
  }
}

TEST(ParseThreads, TakesOneToTheLimit) {
  EXPECT_EQ(parseThreads("--threads", "1").value(), 1);
  EXPECT_EQ(parseThreads("--threads", std::to_string(kMaxThreads)).value(), kMaxThreads);
  for (const std::string& text :
       {std::string("0"), std::string("-1"), std::string("two"), std::string("1.5"),
        std::to_string(kMaxThreads + 1), std::string("99999999999999999999")}) {
    EXPECT_FALSE(parseThreads("--threads", text).ok()) << text;
  }
}

TEST(ParsePlacement, TakesPlaceAndOptionalYaw) {
  const Placement place = parsePlacement("--place", "1.5,-2,0.25,-90").value();
  EXPECT_EQ(place.origin, Eigen::Vector3d(1.5, -2.0, 0.25));
  EXPECT_EQ(place.yawDeg, -90.0);
  EXPECT_FALSE(place.motionUpZ);
  EXPECT_EQ(parsePlacement("--place", "1,2,3").value().yawDeg, 0.0);
}

TEST(ParsePlacement, RefusesWrongCountsAndUnusableNumbers) {
  for (const char* text : {"", "1", "1,2", "1,2,3,4,5", "1,2,x", "1,,3", "1,2,3,", "nan,0,0",
                           "0,0,0,inf", "1 2 3", "2e7,0,0"}) {
    EXPECT_FALSE(parsePlacement("--place", text).ok()) << text;
  }
}

TEST(ParseUpAxis, KnowsTwoAxes) {
  EXPECT_EQ(parseUpAxis("--up", "y").value(), UpAxis::Y);
  EXPECT_EQ(parseUpAxis("--up", "z").value(), UpAxis::Z);
  for (const char* text : {"x", "Y", "", "yz"}) EXPECT_FALSE(parseUpAxis("--up", text).ok());
}

TEST(ParseFidelity, TakesEachByName) {
  EXPECT_EQ(parseFidelity("--fidelity", "link").value(), Fidelity::Link);
  EXPECT_EQ(parseFidelity("--fidelity", "exact").value(), Fidelity::Exact);
  EXPECT_EQ(parseFidelity("--fidelity", "skinned").value(), Fidelity::Skinned);
  const auto unknown = parseFidelity("--fidelity", "best");
  ASSERT_FALSE(unknown.ok());
  EXPECT_NE(unknown.error().message.find("link, exact or skinned"), std::string::npos);
}

TEST(CheckIsNoInput, SeesTheSameFileUnderAnotherName) {
  const test::TempFolder folder;
  const std::string input = folder.write("clip.bvh", "x");
  EXPECT_FALSE(checkIsNoInput(folder / "./clip.bvh", {"", input}).ok());
  EXPECT_TRUE(checkIsNoInput(folder / "out.jsonl", {"", input, folder / "absent"}).ok());
}

}  // namespace
}  // namespace foretouch::tools
