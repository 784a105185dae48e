// tests/bench/extremes_test.cpp: a sample of the extremes, and the oracle that judges them:
// against the tests' own fifty digits, against a hundred, and against planted lies.
#include "bench/extremes.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "bench/extremes/case_json.h"
#include "bench/extremes/float_mode.h"
#include "tests/support/precise.h"
#include "tests/support/random_geometry.h"
#include "tests/support/widest_afterwards.h"

namespace foretouch::tools {
namespace {

using namespace extremes;
using Eigen::Vector3d;

std::array<double, 3> numbersOf(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
template <typename Real>
Vector<Real> vectorOf(const Vector3d& v) {
  return {Real(v.x()), Real(v.y()), Real(v.z())};
}
template <typename Real>
Corners<Real> cornersOf(const std::array<Vector3d, 3>& v) {
  return {vectorOf<Real>(v[0]), vectorOf<Real>(v[1]), vectorOf<Real>(v[2])};
}

/// Three points of which some coincide, lie on a line or next to one.
std::array<Vector3d, 3> hostile(Draw& draw) {
  std::array<Vector3d, 3> v{draw.inBox(1.0), draw.inBox(1.0), draw.inBox(1.0)};
  switch (draw.below(6)) {
    case 0: v[1] = v[0]; break;
    case 1: v[1] = v[2] = v[0]; break;
    case 2: v[2] = 0.5 * (v[0] + v[1]); break;
    case 3: v[2] = 0.5 * (v[0] + v[1]) + 1e-12 * draw.direction(); break;
    default: break;
  }
  return v;
}

TEST(ExtremesOracle, MeasuresDistancesAsOtherFormulasAndMoreDigitsDo) {
  Draw draw(1);
  for (int i = 0; i < 400; ++i) {
    const auto one = hostile(draw), other = hostile(draw);
    const std::array<test::Precise3, 3> tests{test::Precise3(other[0]), test::Precise3(other[1]),
                                              test::Precise3(other[2])};
    const std::array<test::Precise3, 3> ones{test::Precise3(one[0]), test::Precise3(one[1]),
                                             test::Precise3(one[2])};
    for (const int count : {2, 3}) {
      const Precise own =
          sqrt(nearestPoints(cornersOf<Precise>(one), count, cornersOf<Precise>(other)).square);
      const VeryPrecise more = sqrt(
          nearestPoints(cornersOf<VeryPrecise>(one), count, cornersOf<VeryPrecise>(other)).square);
      const Precise expected = count == 2 ? test::preciseDistance(ones[0], ones[1], tests)
                                          : test::preciseDistance(ones, tests);
      ASSERT_LT(abs(own - expected), 1e-30) << i;
      ASSERT_LT(abs(VeryPrecise(own) - more), 1e-30) << i;
    }
  }
}

TEST(ExtremesOracle, MovesAsSlerpBySineWeightsDoes) {
  Draw draw(2);
  for (int i = 0; i < 40; ++i) {
    std::vector<OracleJoint> joints;
    std::vector<test::PreciseJoint> tests;
    for (int j = 0; j < 4; ++j) {
      const Quaternion from = draw.rotation(draw.uniform(0.0, 3.0));
      const Quaternion to = from * draw.rotation(draw.pick({1.0, 3.1, 1e-12, 1e-5}));
      const Vector3d p = draw.inBox(1.0), q = draw.inBox(1.0);
      tests.push_back({j - 1, from, to, p, q});
      const double product =
          from.w() * to.w() + from.x() * to.x() + from.y() * to.y() + from.z() * to.z();
      joints.push_back({j - 1,
                        {from.w(), from.x(), from.y(), from.z()},
                        {to.w(), to.x(), to.y(), to.z()},
                        numbersOf(p),
                        numbersOf(q),
                        product < 0.0});
    }
    const double t = draw.uniform(0.0, 1.0);
    const auto expected = test::preciseFrames(tests, test::Real(t));
    std::vector<PreciseMotion<Precise>::Frame> frames;
    PreciseMotion<Precise>(joints, {}).framesAt(Precise(t), frames);
    const Vector3d p_L = draw.inBox(1.0);
    const auto x = frames.back().at(vectorOf<Precise>(p_L));
    const auto y = expected.back().at(p_L);
    EXPECT_LT(abs(x.x - y.c[0]) + abs(x.y - y.c[1]) + abs(x.z - y.c[2]), 1e-20) << i;
  }
}

/// A ball of radius 1/4 falls from 1 to 0 above the floor: it touches at 3/4.
OracleWorld fallingBall() {
  OracleWorld world;
  OracleJoint joint;
  joint.fromTranslation = {0.0, 1.0, 0.0};
  world.joints = {joint};
  world.hulls = {{0, 2, {}, 0.25}};
  const Triangle floor = floorAt(0.0);
  world.triangles = {
      {numbersOf(floor.vertices[0]), numbersOf(floor.vertices[1]), numbersOf(floor.vertices[2])}};
  return world;
}

TEST(ExtremesOracle, CatchesPlantedLies) {
  const Oracle oracle(fallingBall());
  EXPECT_LT(abs(oracle.separationAt(0, 0.0) - Precise(0.75)), 1e-45);
  EXPECT_LT(abs(oracle.separationAt(0, 0.75)), 1e-45);
  const double before = 0.75 - 1e-9, after = std::nextafter(0.75, 1.0);
  EXPECT_EQ(oracle.proveFree({before}).front().freedom, Freedom::Proven);
  EXPECT_LT(oracle.proveFree({before}).front().least, 0.1);
  for (const double lie : {0.75 + 1e-9, 0.9, 1.0}) {
    const FreedomProof proof = oracle.proveFree({lie}).front();
    EXPECT_EQ(proof.freedom, Freedom::Touches) << lie;
    EXPECT_LT(proof.touchesAt, lie);
    EXPECT_GE(proof.touchesAt, 0.75);
  }
  EXPECT_NE(oracle.proveFree({after}).front().freedom, Freedom::Proven);
}

TEST(ExtremesOracle, SeesWhatIsCrossedWithinOneStep) {
  OracleWorld world = fallingBall();
  world.joints[0].fromTranslation = {0.0, 1e5, 0.0};
  world.joints[0].toTranslation = {0.0, -1e5, 0.0};
  const FreedomProof proof = Oracle(world).proveFree({1.0}).front();
  EXPECT_EQ(proof.freedom, Freedom::Touches);
  world.triangles[0][0][0] = world.triangles[0][1][0] = world.triangles[0][2][0] = 1.0;
  EXPECT_EQ(Oracle(world).proveFree({1.0}).front().freedom, Freedom::Proven);
}

TEST(ExtremesOracle, ComparesFallsWithoutRounding) {
  EXPECT_FALSE(isAfterFall(0.75, 1.0, 0.0, 0.25));
  EXPECT_TRUE(isAfterFall(std::nextafter(0.75, 1.0), 1.0, 0.0, 0.25));
  EXPECT_FALSE(isAfterFall(1.0, 1.0, 0.0, 0.0));
  EXPECT_TRUE(isAfterFall(1.0, 1.0, 0.0, 5e-324));
  EXPECT_FALSE(isAfterFall(std::nextafter(1.0, 0.0), 1.0, 0.0, 5e-324));
}

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
