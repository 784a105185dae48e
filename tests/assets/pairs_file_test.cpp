#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/avatar_file.h"
#include "tests/assets/bvh_samples.h"
#include "tests/support/temp_folder.h"

namespace foretouch {
namespace {

using test::edited;

/// A trunk, two arms that overlap a scarf at rest, two hands, and a joint without LSS.
Avatar figure() {
  return parseAvatar(R"({"format": "foretouch-avatar", "version": 1, "links": [
{"name": "Trunk", "parent": null, "offset": [0, 0, 0],
 "lss": [{"a": [0, 0, 0], "b": [0, 0, 0], "radius": 0.1}]},
{"name": "LeftArm", "parent": "Trunk", "offset": [0.2, 0, 0],
 "lss": [{"a": [0, 0, 0], "b": [0.15, 0, 0], "radius": 0.05}]},
{"name": "LeftHand", "parent": "LeftArm", "offset": [0.3, 0, 0],
 "lss": [{"a": [0, 0, 0], "b": [0.1, 0, 0], "radius": 0.04}]},
{"name": "RightArm", "parent": "Trunk", "offset": [-0.2, 0, 0],
 "lss": [{"a": [0, 0, 0], "b": [-0.15, 0, 0], "radius": 0.05}]},
{"name": "RightHand", "parent": "RightArm", "offset": [-0.3, 0, 0],
 "lss": [{"a": [0, 0, 0], "b": [-0.1, 0, 0], "radius": 0.04}]},
{"name": "Neck", "parent": "Trunk", "offset": [0, 0.2, 0], "lss": []},
{"name": "Scarf", "parent": "Neck", "offset": [0, 0.1, 0],
 "lss": [{"a": [0, 0, 0], "b": [0.25, -0.25, 0], "radius": 0.03}]}]})",
                     "figure.json")
      .value();
}

std::string plainPairs() {
  return "{\"format\": \"foretouch-pairs\", \"version\": 1,\n"
         " \"left_out\": [\n"
         "  {\"a\": \"Trunk\", \"b\": \"LeftArm\", \"reason\": \"adjacent\"},\n"
         "  {\"a\": \"LeftArm\", \"b\": \"Scarf\", \"reason\": \"rest-overlap\"},\n"
         "  {\"a\": \"LeftHand\", \"b\": \"RightHand\", \"reason\": \"always\"}\n"
         " ],\n"
         " \"radii\": [\n"
         "  {\"a\": \"LeftHand\", \"lss_a\": 0, \"b\": \"Scarf\", \"lss_b\": 0, \"radius\": 0.05}\n"
         " ]}\n";
}

void expectRefusal(const std::string& text, ErrorCode code, std::int64_t line,
                   const std::string& about) {
  const auto rules = parsePairs(text, "bad.json", figure());
  ASSERT_FALSE(rules.ok()) << about;
  const Error& error = rules.error();
  EXPECT_STREQ(toString(error.code), toString(code)) << describe(error);
  EXPECT_EQ(error.line, line) << describe(error);
  EXPECT_EQ(error.file, "bad.json");
  EXPECT_NE(error.message.find(about), std::string::npos) << describe(error);
}

void expectRefusal(const std::string& from, const std::string& to, ErrorCode code,
                   std::int64_t line, const std::string& about) {
  expectRefusal(edited(plainPairs(), from, to), code, line, about);
}

TEST(ParsePairs, ReadsEveryField) {
  const Avatar avatar = figure();
  const auto rules = parsePairs(plainPairs(), "good.json", avatar);
  ASSERT_TRUE(rules.ok()) << describe(rules.error());
  EXPECT_EQ(rules.value().avatarIdentity(), avatar.identity());
  ASSERT_EQ(rules.value().leftOut().size(), 3u);
  EXPECT_EQ(rules.value().reasonOf(0, 1), PairReason::Adjacent);
  EXPECT_EQ(rules.value().reasonOf(1, 6), PairReason::RestOverlap);
  EXPECT_EQ(rules.value().reasonOf(2, 4), PairReason::Always);
  EXPECT_EQ(rules.value().numAsked(), 12);
  ASSERT_EQ(rules.value().radii().size(), 1u);
  EXPECT_EQ(rules.value().radii()[0].b, 6);
  EXPECT_EQ(rules.value().radii()[0].radius, 0.05);
}

TEST(ParsePairs, TakesAnEmptyListAndKeysInAnyOrder) {
  const auto rules = parsePairs(
      R"({"left_out":[{"reason":"user","b":"Trunk","a":"LeftHand"}],"version":1.0,
"format":"foretouch-pairs"})",
      "t", figure());
  ASSERT_TRUE(rules.ok()) << describe(rules.error());
  EXPECT_EQ(rules.value().reasonOf(0, 2), PairReason::User);
  const auto all =
      parsePairs(R"({"format":"foretouch-pairs","version":1,"left_out":[]})", "t", figure());
  ASSERT_TRUE(all.ok()) << describe(all.error());
  EXPECT_EQ(all.value().numAsked(), all.value().numPairs());
}

TEST(ParsePairs, RefusesWhatDoesNotFitTheAvatar) {
  expectRefusal("\"Trunk\"", "\"Trnk\"", ErrorCode::UnknownName, 3, "did you mean 'Trunk'");
  expectRefusal("\"Trunk\"", "\"Trnk\"", ErrorCode::UnknownName, 3, "left_out[0]: ");
  expectRefusal("\"b\": \"Scarf\", \"reason\"", "\"b\": \"Neck\", \"reason\"", ErrorCode::Mismatch,
                4, "has none");
  expectRefusal("\"b\": \"LeftArm\"", "\"b\": \"RightHand\"", ErrorCode::Mismatch, 3,
                "'Trunk' and 'RightHand' are not adjacent in this avatar");
  expectRefusal("\"b\": \"Scarf\", \"reason\"", "\"b\": \"RightArm\", \"reason\"",
                ErrorCode::Mismatch, 4, "do not overlap at rest");
  expectRefusal("\"lss_b\": 0", "\"lss_b\": 1", ErrorCode::OutOfRange, 8,
                "radii[0]: expected LSS that the two links have");
  expectRefusal("0.05", "0.5", ErrorCode::OutOfRange, 8, "below the sum");
  expectRefusal("\"lss_a\": 0, \"b\": \"Scarf\"", "\"lss_a\": 0, \"b\": \"RightHand\"",
                ErrorCode::OutOfRange, 8, "a pair of links that is asked");
}

TEST(ParsePairs, RefusesRulesThatAskNothing) {
  const Avatar avatar = figure();
  std::string pairs;
  for (LinkId a = 0; a < avatar.numLinks(); ++a) {
    for (LinkId b = a + 1; b < avatar.numLinks(); ++b) {
      if (avatar.lss(a).empty() || avatar.lss(b).empty()) continue;
      pairs += (pairs.empty() ? "" : ",") + std::string("{\"a\":\"") + avatar.skeleton().name(a) +
               "\",\"b\":\"" + avatar.skeleton().name(b) + "\",\"reason\":\"user\"}";
    }
  }
  expectRefusal("{\"format\":\"foretouch-pairs\",\"version\":1,\"left_out\":[" + pairs + "]}",
                ErrorCode::Empty, -1, "found all 15 left out");
}

TEST(ParsePairs, RefusesUnknownRepeatedAndMissingKeys) {
  expectRefusal("\"version\": 1", "\"version\": 1, \"avatar\": \"x\"", ErrorCode::UnknownName, 1,
                "'avatar'; expected one of format, version, left_out, radii");
  expectRefusal("\"reason\": \"adjacent\"", "\"why\": \"adjacent\"", ErrorCode::UnknownName, 3,
                "a, b, reason");
  expectRefusal("\"a\": \"Trunk\"", "\"a\": \"Trunk\", \"a\": \"Trunk\"", ErrorCode::DuplicateName,
                3, "'a' appears twice");
  expectRefusal(", \"reason\": \"adjacent\"", "", ErrorCode::Syntax, 3, "'reason' is missing");
  expectRefusal(", \"radius\": 0.05", "", ErrorCode::Syntax, 8, "'radius' is missing");
  expectRefusal("\"version\": 1,", "", ErrorCode::Syntax, 9, "'version' is missing");
  expectRefusal(" \"radii\":", " \"left_out\":", ErrorCode::DuplicateName, 7, "'left_out'");
  expectRefusal("{\"format\":\"foretouch-pairs\",\"version\":1}", ErrorCode::Syntax, 1,
                "'left_out' is missing");
}

TEST(ParsePairs, RefusesRepeatedPairsAndPairsOfOneLink) {
  expectRefusal("\"a\": \"LeftHand\", \"b\": \"RightHand\"", "\"a\": \"LeftArm\", \"b\": \"Trunk\"",
                ErrorCode::DuplicateName, 5, "'LeftArm' and 'Trunk' again");
  expectRefusal("\"b\": \"LeftArm\"", "\"b\": \"Trunk\"", ErrorCode::OutOfRange, 3,
                "two different links, found 'Trunk' twice");
}

TEST(ParsePairs, RefusesWrongTypesAndSaysWhatWasExpected) {
  expectRefusal("\"foretouch-pairs\"", "\"foretouch-avatar\"", ErrorCode::Syntax, 1,
                "found 'foretouch-avatar'");
  expectRefusal("\"version\": 1", "\"version\": 2", ErrorCode::Syntax, 1, "the only version");
  expectRefusal("\"adjacent\"", "\"adjacnt\"", ErrorCode::Syntax, 3, "did you mean 'adjacent'");
  expectRefusal("\"adjacent\"", "\"asked\"", ErrorCode::Syntax, 3, "found 'asked'");
  expectRefusal("\"adjacent\"", "7", ErrorCode::Syntax, 3, "for \"reason\", found a number");
  expectRefusal("\"lss_a\": 0", "\"lss_a\": 0.5", ErrorCode::Syntax, 8, "the number of an LSS");
  expectRefusal("\"lss_a\": 0", "\"lss_a\": -1", ErrorCode::Syntax, 8, "found -1");
  expectRefusal("0.05", "null", ErrorCode::Syntax, 8, "a number of metres");
  expectRefusal("\"left_out\": [", "\"left_out\": [[", ErrorCode::Syntax, 2, "an object with");
  expectRefusal("[]", ErrorCode::Syntax, 1, "one object of pair rules");
  expectRefusal("{\"format\": \"foretouch-pairs\",", ErrorCode::Syntax, 1, "broken JSON");
}

TEST(ParsePairs, SurvivesCutAndChangedTexts) {
  const Avatar avatar = figure();
  const std::string text = plainPairs();
  for (std::size_t length = 0; length + 2 < text.size(); ++length) {
    EXPECT_FALSE(parsePairs(text.substr(0, length), "cut", avatar).ok()) << length;
  }
  std::mt19937 random(1);
  int refused = 0;
  constexpr int kChanged = 2000;
  for (int i = 0; i < kChanged; ++i) {
    std::string changed = text;
    changed[random() % changed.size()] = static_cast<char>(random());
    refused += parsePairs(changed, "changed", avatar).ok() ? 0 : 1;
  }
  EXPECT_GT(refused, kChanged / 2);
}

TEST(FormatPairs, ReadsBackAsTheSameRules) {
  const Avatar avatar = figure();
  for (const bool usePairRadii : {false, true}) {
    PairRuleOptions options;
    options.usePairRadii = usePairRadii;
    options.leftOut = {{4, 2}, {5, 0}};
    const PairRules rules = PairRules::derive(avatar, options).value();
    const std::string text = formatPairs(rules, avatar);
    const auto read = parsePairs(text, "own", avatar);
    ASSERT_TRUE(read.ok()) << describe(read.error()) << text;
    EXPECT_EQ(formatPairs(read.value(), avatar), text);
    EXPECT_EQ(read.value().numAsked(), rules.numAsked());
    EXPECT_EQ(read.value().reasonOf(2, 4), PairReason::User);
    EXPECT_EQ(read.value().radii().size(), rules.radii().size());
    EXPECT_EQ(rules.radii().empty(), !usePairRadii);
    for (std::size_t i = 0; i < rules.radii().size(); ++i) {
      EXPECT_EQ(read.value().radii()[i].radius, rules.radii()[i].radius);
    }
  }
}

TEST(WritePairsFile, WritesWhatIsRead) {
  const Avatar avatar = figure();
  const test::TempFolder folder;
  const std::string path = folder / "figure.pairs.json";
  const PairRules rules = PairRules::derive(avatar).value();
  ASSERT_TRUE(writePairsFile(rules, avatar, path).ok());
  const auto read = readPairsFile(path, avatar);
  ASSERT_TRUE(read.ok()) << describe(read.error());
  EXPECT_EQ(read.value().leftOut().size(), rules.leftOut().size());
  EXPECT_EQ(readPairsFile(folder / "none.json", avatar).error().code, ErrorCode::FileNotFound);
}

}  // namespace
}  // namespace foretouch
