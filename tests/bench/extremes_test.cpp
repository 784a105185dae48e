// tests/bench/extremes_test.cpp: a sample of the extremes. What judges them has tests of its own
// (tests/judge/hull_oracle_test.cpp).
#include "bench/extremes.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "bench/extremes/case_json.h"
#include "bench/extremes/float_mode.h"
#include "tests/support/widest_afterwards.h"

namespace foretouch::tools {
namespace {

using namespace extremes;
using Eigen::Vector3d;

TEST(ExtremesFloatMode, FlushesAndRestores) {
  if (!canFlushDenormals()) GTEST_SKIP() << "this processor's mode is not known";
  volatile double least = std::numeric_limits<double>::min();
  {
    const FloatMode mode(true);
    EXPECT_EQ(least * 0.5, 0.0);
  }
  EXPECT_NE(least * 0.5, 0.0);
}

TEST(Extremes, OfEveryFamilyAreAnsweredSoundly) {
  const test::WidestAfterwards widest;
  ExtremesRequest request;
  request.cases = 13;  // every member of the family that has most
  request.sizes = {300, 20};
  const auto bench = measureExtremes(request);
  ASSERT_TRUE(bench.ok());
  for (const Finding& finding : bench.value().findings) ADD_FAILURE() << finding.what;
  EXPECT_TRUE(bench.value().isSound);
  ASSERT_EQ(bench.value().tallies.size(), families().size());
  for (std::size_t i = 0; i < families().size(); ++i) {
    const Tally& tally = bench.value().tallies[i];
    const std::string& name = families()[i].name;
    EXPECT_GT(tally.queries, 0) << name;
    EXPECT_GT(tally.contacts + tally.starts, 0) << name;
    // A family that meets nothing but starts, or never any contact, tries nothing.
    if (name != "refused") {
      EXPECT_GT(tally.contacts, 0) << name;
    }
    EXPECT_EQ(tally.refused > 0, name == "refused" || name == "tolerance") << name;
    EXPECT_GE(-tally.lateness.value, 0.2) << name;
    EXPECT_LE(tally.startShare.value, 1.0) << name;
  }
}

// The longest chain of the longest limbs, each of which makes half a turn: no box of floats may be
// without end (docs/guarantees.md 7).
TEST(Extremes, OfTheLongestChainStayWithinFloats) {
  const test::WidestAfterwards widest;
  Draw draw(3);
  RigShape shape;
  shape.joints = kMaxChainDepth;
  ExtremeCase extreme = rigged(draw, shape);
  const Vector3d limb = Vector3d::Constant(kMaxCoordinate);
  for (std::size_t j = 0; j < extreme.lss.size(); ++j) {
    extreme.from.rotations[j] = Quaternion::Identity();
    extreme.to.rotations[j] = aboutAxis(draw.direction(), 3.14);
    extreme.from.translations[j] = limb;
    extreme.to.translations[j] = -limb;
    if (j + 1 < extreme.lss.size()) extreme.lss[j].clear();
  }
  extreme.lss.back() = {{Vector3d::Zero(), limb, kMaxCoordinate}};
  extreme.add({{limb, -limb, Vector3d(kMaxCoordinate, -kMaxCoordinate, 0)}});
  extreme.tolerance = kMaxTolerance;
  const Asked asked = ask(extreme);
  ASSERT_FALSE(asked.refusal);
  for (const Answer& answer : asked.answers) {
    for (const LinkContact& contact : answer.step.links) {
      ASSERT_TRUE(std::isfinite(contact.separation)) << answer.way;
      ASSERT_TRUE(contact.p_WLink.allFinite()) << answer.way;
    }
  }
}

TEST(Extremes, JudgeNamesWhatIsRefusedOrAcceptedWrongly) {
  const test::WidestAfterwards widest;
  const Family& family = families().front();
  Tally tally;
  ExtremeCase extreme = makeCase(family, 1, {});
  extreme.isLegal = false;
  auto findings = judge(extreme, tally);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings.front().fault, Fault::Accepted);
  extreme.isLegal = true;
  extreme.tolerance = std::nan("");
  findings = judge(extreme, tally);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings.front().fault, Fault::Malformed);
  EXPECT_EQ(tally.refused, 1);
}

TEST(Extremes, CasesAreTheirFamilyAndSeed) {
  for (const Family& family : families()) {
    const ExtremeSizes sizes{10, 5};
    const std::string once = casesJson({makeCase(family, 7, sizes)});
    EXPECT_EQ(once, casesJson({makeCase(family, 7, sizes)})) << family.name;
    EXPECT_NE(once, casesJson({makeCase(family, 7 + family.members.size(), sizes)})) << family.name;
  }
}

}  // namespace
}  // namespace foretouch::tools
