#include "tools/inputs/joint_map.h"

#include <gtest/gtest.h>

#include "articulated/result.h"

namespace foretouch::tools {
namespace {

TEST(ParseJointMap, ReadsAFlatObjectOfNames) {
  const auto map = parseJointMap(R"({"LeftHand": "hand.L", "Köpf": "head"})", "map.json");
  ASSERT_TRUE(map.ok());
  EXPECT_EQ(map.value(), (JointNameMap{{"LeftHand", "hand.L"}, {"Köpf", "head"}}));
  EXPECT_TRUE(parseJointMap("{}", "map.json").value().empty());
}

TEST(ParseJointMap, RefusesAnythingElseNamingTheFile) {
  for (const char* text : {"", "[]", "\"a\"", "null", "3", "{\"a\": 1}", "{\"a\": null}",
                           "{\"a\": [\"b\"]}", "{\"a\": {\"b\": \"c\"}}", "{\"a\": \"b\"",
                           "{\"a\" \"b\"}", "{\"a\": \"b\"} x", "{\"a\": 1e999}", "\xff\xfe"}) {
    const auto map = parseJointMap(text, "map.json");
    ASSERT_FALSE(map.ok()) << text;
    EXPECT_EQ(map.error().file, "map.json");
    EXPECT_NE(map.error().message.find("expected one object of texts"), std::string::npos);
  }
}

TEST(ParseJointMap, RefusesRepeatedKeys) {
  const auto map = parseJointMap(R"({"a": "b", "a": "c"})", "map.json");
  ASSERT_FALSE(map.ok());
  EXPECT_EQ(map.error().message, "the joint 'a' appears twice");
}

TEST(ParseJointMap, SaysTheLineOfBrokenText) {
  const auto map = parseJointMap("{\n\"a\": \"b\",\n\"c\" \"d\"\n}", "map.json");
  ASSERT_FALSE(map.ok());
  EXPECT_EQ(map.error().line, 3);
}

TEST(ParseJointMap, EndsAtHostileNestingAtOnce) {
  const std::string deep(1'000'000, '[');
  EXPECT_FALSE(parseJointMap(deep, "map.json").ok());
  std::string objects;
  for (int i = 0; i < 200'000; ++i) objects += R"({"a":)";
  EXPECT_FALSE(parseJointMap(objects, "map.json").ok());
}

}  // namespace
}  // namespace foretouch::tools
