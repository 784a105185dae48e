#include "tools/inputs/policy_rules.h"

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"
#include "tools/inputs/name_pattern.h"

namespace foretouch::tools {
namespace {

const std::vector<std::string> kLinks{"Hips", "Spine", "LeftFoot", "LeftHand", "LeftHandIndex1"};
const std::vector<std::string> kRoomObjects{"floor", "table", "chair_1", "chair_2"};

Skeleton skeleton() {
  RawSkeleton raw;
  for (const std::string& name : kLinks) {
    RawJoint joint;
    joint.name = name;
    raw.joints.push_back(joint);
  }
  return Skeleton::build(raw).value();
}

Result<QueryOptions> resolved(const std::string& text, QueryOptions options = {}) {
  const auto rules = parsePolicyFile(text, "etc/policy.toml");
  if (!rules.ok()) return rules.error();
  const auto done = applyPolicies(rules.value(), skeleton(), kRoomObjects, options);
  if (!done.ok()) return done.error();
  return options;
}

std::string errorOf(const std::string& text, const QueryOptions& options = {}) {
  const auto result = resolved(text, options);
  return result.ok() ? "accepted" : describe(result.error());
}

/// "0.001 link" of each link, and the ignored pairs.
std::string shown(const std::string& text, const QueryOptions& base = {}) {
  const auto options = resolved(text, base);
  if (!options.ok()) return describe(options.error());
  std::ostringstream out;
  for (const LinkPolicy& policy : options.value().linkPolicies) {
    out << policy.tolerance << " " << toString(policy.fidelity) << ", ";
  }
  out << "all " << options.value().tolerance << " " << toString(options.value().fidelity);
  for (const IgnoredPair& pair : options.value().ignored) {
    out << " " << pair.link << ":" << pair.object;
  }
  return out.str();
}

testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "no \"" << part << "\" in: " << text;
}

TEST(NamePattern, StarsStandForBeginningsAndEndings) {
  EXPECT_TRUE(matches("Hand", "Hand"));
  EXPECT_FALSE(matches("Hand", "LeftHand"));
  EXPECT_TRUE(matches("Hand*", "HandIndex"));
  EXPECT_FALSE(matches("Hand*", "LeftHand"));
  EXPECT_TRUE(matches("*Hand", "LeftHand"));
  EXPECT_FALSE(matches("*Hand", "LeftHandIndex"));
  EXPECT_TRUE(matches("*Hand*", "LeftHandIndex"));
  EXPECT_TRUE(matches("*Hand*", "Hand"));
  EXPECT_FALSE(matches("*Hand*", "Han"));
  EXPECT_TRUE(matches("*", "") && matches("*", "x") && matches("**", "x") && matches("", ""));
  EXPECT_FALSE(matches("", "x"));
  EXPECT_FALSE(matches("*aa", "a"));
}

TEST(Policies, GiveLinksTheirOwnToleranceAndFidelity) {
  EXPECT_EQ(shown("[[policy]]\nlinks = [\"*Hand*\"]\ntolerance = 0.0001\nfidelity = \"exact\"\n"
                  "[[policy]]\nlinks = [\"Spine\", \"Hips\"]\ntolerance = 0.005\n"),
            "0.005 link, 0.005 link, 0.001 link, 0.0001 exact, 0.0001 exact, all 0.005 exact");
}

TEST(Policies, LaterRulesWin) {
  EXPECT_EQ(shown("[[policy]]\ntolerance = 0.005\nfidelity = \"exact\"\n"
                  "[[policy]]\nlinks = [\"Left*\"]\nfidelity = \"link\"\n"
                  "[[policy]]\nlinks = [\"LeftFoot\"]\ntolerance = 0.02\n"),
            "0.005 exact, 0.005 exact, 0.02 link, 0.005 link, 0.005 link, all 0.02 exact");
  EXPECT_EQ(
      shown("[[policy]]\nlinks = [\"Left*\"]\nobjects = [\"floor\", \"chair*\"]\nignore = true\n"
            "[[policy]]\nlinks = [\"LeftHand*\"]\nobjects = [\"chair_2\", \"floor\"]\n"
            "ignore = false\n"),
      "all 0.001 link 2:0 2:2 2:3 3:2 4:2");
}

TEST(Policies, OfLinksThatAreAlikeAreTheOptionsOwn) {
  EXPECT_EQ(shown("[[policy]]\ntolerance = 0.005\nfidelity = \"exact\"\n"), "all 0.005 exact");
  QueryOptions exact;
  exact.fidelity = Fidelity::Exact;
  EXPECT_EQ(shown("[[policy]]\nfidelity = \"link\"\n", exact), "all 0.001 link");
}

TEST(Policies, AddToWhatIsIgnored) {
  QueryOptions base;
  base.ignored = {{1, 1}, {2, IgnoredPair::kEveryObject}, {3, IgnoredPair::kEveryObject}};
  EXPECT_EQ(shown("[[policy]]\nlinks = [\"Hips\"]\nignore = true\n"
                  "[[policy]]\nlinks = [\"LeftHand\"]\nobjects = [\"table\"]\nignore = false\n",
                  base),
            "all 0.001 link 0:-1 1:1 2:-1 3:0 3:2 3:3");
}

// With an object that is ignored there is no contact to be tight about.
TEST(Policies, TakeTheLeastToleranceOfTheObjectsThatCount) {
  const std::string byObject =
      "[[policy]]\ntolerance = 0.01\n"
      "[[policy]]\nlinks = [\"Left*\"]\nobjects = [\"table\"]\ntolerance = 1e-5\n";
  EXPECT_EQ(shown(byObject),
            "0.01 link, 0.01 link, 1e-05 link, 1e-05 link, 1e-05 link, all 0.01 link");
  EXPECT_EQ(
      shown(byObject + "[[policy]]\nlinks = [\"LeftFoot\"]\nobjects = [\"t*\"]\nignore = true\n"),
      "0.01 link, 0.01 link, 0.01 link, 1e-05 link, 1e-05 link, all 0.01 link 2:1");
}

// Nor do they ask for a mesh, or for steps that only they would need.
TEST(Policies, OfLinksThatIgnoreEverythingCostNothing) {
  EXPECT_EQ(shown("[[policy]]\nlinks = [\"*Hand*\"]\ntolerance = 1e-9\nfidelity = \"exact\"\n"
                  "ignore = true\n"),
            "all 0.001 link 3:-1 4:-1");
  EXPECT_EQ(shown("[[policy]]\ntolerance = 1e-9\nignore = true\n"),
            "all 0.001 link 0:-1 1:-1 2:-1 3:-1 4:-1");
}

TEST(Policies, NamesThatAreNotThereAreRefusedWithTheNearest) {
  EXPECT_TRUE(has(errorOf("[[policy]]\nignore = true\n[[policy]]\nlinks = [\"LeftHnad\"]\n"
                          "ignore = true\n"),
                  "etc/policy.toml:3: [[policy]] links: 'LeftHnad' is no link of the avatar; did "
                  "you mean 'LeftHand'"));
  EXPECT_TRUE(has(errorOf("[[policy]]\nobjects = [\"tabel\"]\nignore = true\n"),
                  "etc/policy.toml:1: [[policy]] objects: 'tabel' is no object of the scene; did "
                  "you mean 'table'"));
  EXPECT_TRUE(has(errorOf("[[policy]]\nlinks = [\"Hips\", \"Tail*\"]\nignore = true\n"),
                  "'Tail*' is no link"));
}

TEST(Policies, AreOfLinksAlone) {
  QueryOptions base;
  base.fidelity = Fidelity::Skinned;
  EXPECT_TRUE(has(errorOf("[[policy]]\nignore = true\n[[policy]]\ntolerance = 1\n", base),
                  "policy.toml:3: [[policy]] expected neither tolerance nor fidelity beside the "
                  "fidelity skinned"));
  EXPECT_EQ(shown("[[policy]]\nlinks = [\"Hips\"]\nignore = true\n", base),
            "all 0.001 skinned 0:-1");
}

TEST(PolicyFile, BadOnesAreRefusedWithTheirLine) {
  const auto rule = [](const std::string& line) { return errorOf("[[policy]]\n" + line + "\n"); };
  EXPECT_TRUE(has(rule("tolerence = 1"),
                  "etc/policy.toml:2: unknown key 'tolerence' in "
                  "[[policy]]; did you mean 'tolerance'?"));
  EXPECT_TRUE(has(rule("tolerance = 1\ntolerance = 2"), "etc/policy.toml:3: broken TOML"));
  for (const char* const bad : {"0", "-1", "0.9e-9", "1.1e7", "nan", "inf"}) {
    EXPECT_TRUE(has(rule(std::string("tolerance = ") + bad),
                    ":2: [[policy]] tolerance: expected a finite number of metres from 1e-9"))
        << bad;
  }
  EXPECT_TRUE(has(rule("tolerance = \"1\""), "found a text"));
  EXPECT_TRUE(has(rule("fidelity = \"skinned\""), ":2: [[policy]] fidelity: expected \"link\" or"));
  EXPECT_TRUE(has(rule("ignore = 1"), "ignore: expected true or false, found a whole number"));
  EXPECT_TRUE(has(rule("ignore = true\nlinks = \"Hips\""), ":3: [[policy]] links: expected an ar"));
  EXPECT_TRUE(
      has(rule("ignore = true\nlinks = []"), ":3: [[policy]] links: expected at least one"));
  EXPECT_TRUE(has(rule("ignore = true\nobjects = [\"\"]"), "a text that is not empty"));
  EXPECT_TRUE(has(rule("ignore = true\nlinks = [\"a\\u001b[2J\"]"), "without control characters"));
  EXPECT_TRUE(has(rule("links = [\"Hips\"]"), ":1: [[policy]]: expected tolerance, fidelity or"));
  EXPECT_TRUE(has(rule("objects = [\"table\"]\nfidelity = \"exact\""),
                  ":1: [[policy]] fidelity: expected no objects beside it"));
  EXPECT_TRUE(has(errorOf(""), "etc/policy.toml: expected at least one [[policy]]"));
  EXPECT_TRUE(has(errorOf("policy = []"), "expected at least one [[policy]]"));
  EXPECT_TRUE(has(errorOf("policy = 3"), ":1: policy: expected tables"));
  EXPECT_TRUE(has(errorOf("[policy]\nignore = true\n"), ":1: policy: expected tables"));
  EXPECT_TRUE(
      has(errorOf("[[polcy]]\n"), ":1: unknown key 'polcy' in the file; did you mean 'poli"));
  std::string many;
  for (std::size_t i = 0; i <= kMaxPolicyRules; ++i) many += "[[policy]]\nignore = true\n";
  EXPECT_TRUE(has(errorOf(many), "expected at most 256 policies"));
  EXPECT_TRUE(has(errorOf("#" + std::string(std::size_t{1} << 20, 'a')), "is larger than 1 MiB"));
}

TEST(PolicyFile, IsReadFromDisk) {
  const test::TempFolder folder;
  const std::string path = folder.write("policy.toml", "[[policy]]\nignore = true\n");
  EXPECT_EQ(readPolicyFile(path).value().size(), 1u);
  EXPECT_FALSE(readPolicyFile(folder / "none.toml").ok());
}

}  // namespace
}  // namespace foretouch::tools
