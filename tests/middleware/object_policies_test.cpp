// Settings per link and object, resolved: what they come to, and what is refused.
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "middleware/query_options.h"

namespace foretouch {
namespace {

constexpr std::int32_t kLinks = 3, kObjects = 2;
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

ObjectPolicy policyOf(std::vector<LinkId> links, std::vector<ObjectId> objects) {
  ObjectPolicy policy;
  policy.links = std::move(links);
  policy.objects = std::move(objects);
  return policy;
}
ObjectPolicy within(double tolerance, std::vector<LinkId> links = {},
                    std::vector<ObjectId> objects = {}) {
  ObjectPolicy policy = policyOf(std::move(links), std::move(objects));
  policy.tolerance = tolerance;
  return policy;
}
ObjectPolicy ignoring(bool ignore, std::vector<LinkId> links = {},
                      std::vector<ObjectId> objects = {}) {
  ObjectPolicy policy = policyOf(std::move(links), std::move(objects));
  policy.ignore = ignore;
  return policy;
}
ObjectPolicy asking(Fidelity fidelity, std::vector<LinkId> links = {},
                    std::vector<ObjectId> objects = {}) {
  ObjectPolicy policy = policyOf(std::move(links), std::move(objects));
  policy.fidelity = fidelity;
  return policy;
}

QueryOptions applied(const std::vector<ObjectPolicy>& policies, QueryOptions options = {}) {
  const auto done = applyObjectPolicies(policies, kLinks, kObjects, options);
  EXPECT_TRUE(done.ok()) << done.error().message;
  return options;
}

std::string pairsOf(const QueryOptions& options) {
  std::string text;
  for (const IgnoredPair& pair : options.ignored) {
    text += std::to_string(pair.link) + ":" + std::to_string(pair.object) + " ";
  }
  return text;
}

TEST(ObjectPolicies, TakeTheLeastToleranceOfTheObjectsThatALinkDoesNotIgnore) {
  const QueryOptions options = applied(
      {within(1e-2), within(1e-5, {1}, {0}), within(1e-6, {2}, {1}), ignoring(true, {2}, {1})});
  ASSERT_EQ(options.linkPolicies.size(), 3u);
  EXPECT_EQ(options.linkPolicies[0].tolerance, 1e-2);
  EXPECT_EQ(options.linkPolicies[1].tolerance, 1e-5);
  EXPECT_EQ(options.linkPolicies[2].tolerance, 1e-2) << "what it ignores has no say";
  EXPECT_EQ(options.tolerance, 1e-2);
  EXPECT_EQ(pairsOf(options), "2:1 ");
}

TEST(ObjectPolicies, LaterOnesWinOverEarlierOnesAndOverTheOptions) {
  QueryOptions base;
  base.tolerance = 1e-4;
  base.ignored = {{0, IgnoredPair::kEveryObject}, {1, 0}};
  const QueryOptions options =
      applied({ignoring(false, {0}, {1}), within(1e-3, {1}), within(1e-5, {1}), ignoring(true, {2}),
               asking(Fidelity::Exact, {1}), asking(Fidelity::Link, {1})},
              base);
  EXPECT_EQ(pairsOf(options), "0:0 1:0 2:-1 ");
  ASSERT_EQ(options.linkPolicies.size(), 3u);
  EXPECT_EQ(options.linkPolicies[0].tolerance, 1e-4);
  EXPECT_EQ(options.linkPolicies[1].tolerance, 1e-5);
  EXPECT_EQ(options.linkPolicies[1].fidelity, Fidelity::Link);
  EXPECT_EQ(options.fidelity, Fidelity::Link);
}

TEST(ObjectPolicies, OfLinksThatAreAlikeMakeNoLinkPolicies) {
  const QueryOptions options = applied({within(1e-5), asking(Fidelity::Exact)});
  EXPECT_TRUE(options.linkPolicies.empty());
  EXPECT_EQ(options.tolerance, 1e-5);
  EXPECT_EQ(options.fidelity, Fidelity::Exact);
}

TEST(ObjectPolicies, MayIgnoreAtAnyFidelityAndBesideLinkPolicies) {
  QueryOptions base;
  base.fidelity = Fidelity::Skinned;
  EXPECT_EQ(pairsOf(applied({ignoring(true, {1}, {1})}, base)), "1:1 ");
  base.fidelity = Fidelity::Link;
  base.linkPolicies.assign(kLinks, LinkPolicy{});
  EXPECT_EQ(pairsOf(applied({ignoring(true, {}, {0})}, base)), "0:0 1:0 2:0 ");
}

/// Name and index of what is refused, and the text.
std::string refusalOf(const ObjectPolicy& policy, QueryOptions options = {}) {
  const auto done = applyObjectPolicies({ignoring(true, {0}), policy}, kLinks, kObjects, options);
  if (done.ok()) return "accepted";
  return done.error().file + " " + std::to_string(done.error().index) + " " + done.error().message;
}

TEST(ObjectPolicies, RefuseWhatTheyCannotMean) {
  const auto begins = [](const std::string& text, const std::string& with) {
    return text.rfind(with, 0) == 0;
  };
  for (const ObjectPolicy& bad : {ignoring(true, {-1}), ignoring(true, {3}),
                                  ignoring(true, {}, {2}), ignoring(true, {}, {-1})}) {
    EXPECT_TRUE(begins(refusalOf(bad), "policies 1 expected links")) << refusalOf(bad);
  }
  for (const double bad : {0.0, 1e-10, 2e7, kNotANumber}) {
    EXPECT_TRUE(begins(refusalOf(within(bad)), "policies 1 tolerance: ")) << bad;
  }
  EXPECT_TRUE(begins(refusalOf(asking(Fidelity::Skinned)), "policies 1 fidelity: expected link"));
  EXPECT_TRUE(begins(refusalOf(asking(Fidelity::Exact, {}, {0})),
                     "policies 1 fidelity: expected no objects"));
  QueryOptions base;
  base.fidelity = Fidelity::Skinned;
  EXPECT_TRUE(begins(refusalOf(within(1e-3), base),
                     "policies 1 expected neither tolerance nor fidelity beside the fidelity "
                     "skinned"));
  base.fidelity = Fidelity::Link;
  base.linkPolicies.assign(kLinks, LinkPolicy{});
  EXPECT_TRUE(begins(refusalOf(within(1e-3), base),
                     "policies 1 expected neither tolerance nor fidelity beside link policies"));
}

// What the resolver reads, it has checked: callers pass options that no query has seen yet.
TEST(ObjectPolicies, RefuseOptionsThatAreOutOfRange) {
  QueryOptions base;
  for (const double bad : {kNotANumber, 0.0, 1e8}) {
    base.tolerance = bad;
    EXPECT_EQ(refusalOf(within(1e-3), base).rfind("tolerance -1 ", 0), 0u) << bad;
  }
  base.tolerance = 1e-3;
  for (const IgnoredPair bad :
       {IgnoredPair{3, 0}, IgnoredPair{-1, 0}, IgnoredPair{0, 2}, IgnoredPair{0, -2}}) {
    base.ignored = {bad};
    EXPECT_EQ(refusalOf(within(1e-3), base).rfind("ignored ", 0), 0u) << bad.object;
  }
}

}  // namespace
}  // namespace foretouch
