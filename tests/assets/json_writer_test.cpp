#include "assets/json_writer.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using nlohmann::json;

std::string dumped(const std::string& text) {
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Bytes that are often the beginning of a character, or of a damaged one.
std::string randomText(test::Random& random) {
  static const std::string kLeads =
      "\xc0\xc1\xc2\xdf\xe0\xe1\xec\xed\xee\xef\xf0\xf1\xf3\xf4\xf5\xff";
  static const std::string kFollowers = "\x80\x8f\x90\x9f\xa0\xbf";
  std::string text;
  const int length = random.below(12);
  for (int i = 0; i < length; ++i) {
    const int kind = random.below(5);
    const std::string& bytes = kind < 2 ? kFollowers : kLeads;
    const auto any = static_cast<char>(random.below(kind == 4 ? 256 : 128));
    text += kind < 3 ? bytes[static_cast<std::size_t>(random.below(static_cast<int>(bytes.size())))]
                     : any;
  }
  return text;
}

// Oracle: another library, which shares no code with ours.
TEST(JsonString, IsWhatAnotherLibraryWritesOfAnyBytes) {
  int damaged = 0, whole = 0;
  for (int i = 0; i < 20000; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    const std::string text = randomText(random);
    const std::string written = jsonString(text);
    ASSERT_EQ(written, dumped(text)) << i;
    (written.find("\xef\xbf\xbd") == std::string::npos ? whole : damaged) += 1;
  }
  EXPECT_GT(damaged, 5000);
  EXPECT_GT(whole, 1000);
  for (int c = 0; c < 256; ++c) {
    const std::string one(1, static_cast<char>(c));
    EXPECT_EQ(jsonString(one), dumped(one)) << c;
  }
  for (const char* text :
       {"\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82", "\xf0\x9f\x98\x80", "€"}) {
    EXPECT_EQ(jsonString(text), dumped(text));
  }
}

TEST(JsonString, HasNothingInAPageThatCouldEndAnElement) {
  const std::string text = "</script><b>&\"\n<";
  const std::string written = jsonString(text, JsonPlace::Page);
  EXPECT_EQ(written.find('<'), std::string::npos);
  EXPECT_EQ(json::parse(written), text);
  EXPECT_EQ(jsonString("a<", JsonPlace::Page), "\"a\\u003c\"");
}

TEST(NumberText, ReadsBackAsTheSameDouble) {
  EXPECT_EQ(numberText(0.1), "0.1");
  EXPECT_EQ(numberText(1.0), "1");
  EXPECT_EQ(numberText(-0.0), "-0");
  EXPECT_EQ(numberText(1e-17), "1e-17");
  EXPECT_EQ(numberText(1e20), "1e+20");
  for (int i = 0; i < 2000; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    const double value = random.magnitude(1e-300, 1e300);
    EXPECT_EQ(std::stod(numberText(value)), value);
  }
}

TEST(JsonWriter, PutsTheCommas) {
  std::string text = "> ";
  JsonWriter out(text);
  out.beginObject();
  out.field("empty", std::vector<std::string>{});
  out.field("a", 1);
  out.field("b", true);
  out.key("nested");
  out.beginArray();
  out.value(0.5);
  out.beginObject();
  out.endObject();
  out.beginArray();
  out.endArray();
  out.null();
  out.endArray();
  out.field("c", "x\"y");
  out.field("d", std::numeric_limits<std::uint64_t>::max());
  out.field("e", std::numeric_limits<std::int64_t>::min());
  out.field("f", static_cast<std::uint8_t>(65));
  out.field("v", Eigen::Vector3d(1, -2, 0.25));
  out.key("latency");
  out.fixed(2.25, 1);
  out.list("list", std::vector<int>{1, 2}, [&](int item) { out.value(item); });
  out.endObject();
  EXPECT_EQ(text, R"(> {"empty":[],"a":1,"b":true,"nested":[0.5,{},[],null],"c":"x\"y",)"
                  R"("d":18446744073709551615,"e":-9223372036854775808,"f":65,"v":[1,-2,0.25],)"
                  R"("latency":2.2,"list":[1,2]})");
}

TEST(JsonWriter, PutsTogetherWhatWasWrittenApart) {
  std::string fields, items, text;
  JsonWriter first(fields), second(items), out(text);
  first.field("a", 1);
  first.field("b", 2);
  second.value("x");
  second.value("y");
  out.beginObject();
  out.rawItems("");
  out.rawItems(fields);
  out.rawField("c", "3");
  out.key("d");
  out.beginArray();
  out.rawItems("");
  out.rawItems(items);
  out.rawItems(items);
  out.endArray();
  out.endObject();
  EXPECT_EQ(text, R"({"a":1,"b":2,"c":3,"d":["x","y","x","y"]})");
}

TEST(JsonWriter, GoesOnWhereItsTextWasTakenAway) {
  std::string text, taken;
  JsonWriter out(text, JsonPlace::Page);
  out.beginArray();
  for (const char* word : {"<a", "b"}) {
    out.value(word);
    taken += text;
    text.clear();
  }
  out.endArray();
  EXPECT_EQ(taken + text, R"(["\u003ca","b"])");
}

}  // namespace
}  // namespace foretouch
