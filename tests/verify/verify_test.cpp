// The verifier: its arithmetic against more digits, its motion against the judge's fifty digits,
// what its readers refuse, and certificates of random edges with lies about them.
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "assets/certificate/certificate_texts.h"
#include "tests/support/holds.h"
#include "tests/support/random_motion.h"
#include "tests/verify/certificate_trial.h"
#include "verify/certificate.h"
#include "verify/interval.h"
#include "verify/json.h"
#include "verify/motion.h"
#include "verify/proof.h"
#include "verify/statement.h"

namespace foretouch::test {
namespace {

using verify::Interval;

/// On x86 it has eleven bits more than a double.
bool holdsValue(const Interval& interval, long double value) {
  return static_cast<long double>(interval.lo) <= value &&
         value <= static_cast<long double>(interval.hi);
}

TEST(VerifyInterval, NextDoublesAreBeyond) {
  Random random(1);
  for (int i = 0; i < 100'000; ++i) {
    double x = random.magnitude(1e-300, 1e300) * (random.chance(0.5) ? 1.0 : -1.0);
    if (i % 100 == 0) x = std::ldexp(1.0, random.below(2000) - 1000);
    if (i == 1) x = 0.0;
    EXPECT_GE(verify::up(x), std::nextafter(x, INFINITY)) << x;
    EXPECT_LE(verify::down(x), std::nextafter(x, -INFINITY)) << x;
    EXPECT_LE(verify::up(x) - x, 4e-16 * std::abs(x) + 1e-320) << x;
  }
}

TEST(VerifyInterval, OperationsHoldTheTrueResult) {
  for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
    Random random(seed);
    const auto draw = [&] {
      const double a = random.magnitude(1e-6, 1e6) * (random.chance(0.5) ? 1.0 : -1.0);
      const double width = random.chance(0.3) ? 0.0 : random.magnitude(1e-18, 10.0);
      return Interval(a, a + width);
    };
    const Interval x = draw(), y = draw();
    for (const double s : {0.0, 0.25, 1.0}) {
      for (const double t : {0.0, 0.75, 1.0}) {
        const long double a = std::min(x.hi, x.lo + s * (x.hi - x.lo));
        const long double b = std::min(y.hi, y.lo + t * (y.hi - y.lo));
        EXPECT_TRUE(holdsValue(x + y, a + b)) << seed;
        EXPECT_TRUE(holdsValue(x - y, a - b)) << seed;
        EXPECT_TRUE(holdsValue(x * y, a * b)) << seed;
        EXPECT_TRUE(holdsValue(verify::square(x), a * a)) << seed;
        EXPECT_TRUE(!(y.lo > 0.0) || holdsValue(x / y, a / b)) << seed;
        EXPECT_TRUE(!(x.lo > 0.0) || holdsValue(verify::root(x), sqrtl(a))) << seed;
      }
    }
  }
  const Interval unknown = Interval(1.0) / Interval(-1.0, 1.0);
  EXPECT_TRUE(std::isinf(unknown.lo) && std::isinf(unknown.hi));
}

/// The motion as the verifier reads it.
struct ReadMotion {
  std::vector<verify::Link> links;
  std::vector<verify::Step> steps;
};

ReadMotion readMotion(const RandomMotion& m) {
  ReadMotion read;
  for (JointId j = 0; j < m.skeleton.numJoints(); ++j) {
    verify::Link link;
    link.name = m.skeleton.name(j);
    link.parent = m.skeleton.parent(j) == kNoParent ? -1 : m.skeleton.parent(j);
    read.links.push_back(link);
  }
  EXPECT_EQ(verify::readSteps("foretouch-steps 1\n" + stepText(0, m.from, m.to), read.links.size(),
                              read.steps)
                .what,
            "");
  return read;
}

TEST(VerifyMotion, HoldsTheTruePlacesOfTheJudgesDigits) {
  int tight = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    RandomMotion m = randomMotion(random, 1 + random.below(8));
    m.from = validatedPose(m.skeleton, m.from).value();
    m.to = validatedPose(m.skeleton, m.to).value();
    const ReadMotion read = readMotion(m);
    verify::Motion motion(read.links, read.steps.front());
    if (!motion.fault().empty()) continue;
    const int level = random.below(6);
    const std::int64_t index = random.below((1 << level) + 1);
    const auto truth =
        oracle::preciseFrames(plainJoints(m.skeleton, m.from, m.to),
                              oracle::Precise(std::ldexp(static_cast<double>(index), -level)));
    for (JointId link = 0; link < m.skeleton.numJoints(); ++link) {
      const auto& place = motion.at(level, index, static_cast<std::size_t>(link));
      const oracle::Precise3& origin = truth[slotOf(link)].origin;
      const oracle::Precise parts[] = {origin.x, origin.y, origin.z};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_LE(oracle::Precise(place.origin[axis].lo), parts[axis]);
        EXPECT_GE(oracle::Precise(place.origin[axis].hi), parts[axis]);
        ++all;
        tight += place.origin[axis].hi - place.origin[axis].lo < 1e-9;
      }
    }
  }
  EXPECT_GT(all, 2000);
  EXPECT_GT(tight, 0.95 * all) << "or it holds anything";
}

/// Second differences of true places are never above the bound, and not far below it.
TEST(VerifyMotion, TheAccelerationIsABound) {
  double nearest = 0.0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const RandomMotion m = randomMotion(random, 1 + random.below(4));
    const ReadMotion read = readMotion(m);
    const verify::Motion motion(read.links, read.steps.front());
    if (!motion.fault().empty()) continue;
    const Pose from = validatedPose(m.skeleton, m.from).value();
    const Pose to = validatedPose(m.skeleton, m.to).value();
    const ChainMotion own(m.skeleton, from, to);
    const LinkId link = random.below(m.skeleton.numJoints());
    const Eigen::Vector3d point = random.inBox(0.5);
    const double t = random.uniform(0.1, 0.9), step = 1e-3;
    const auto at = [&](double when) { return own.stateAt(link, when).pointAt(point); };
    const double second = (at(t + step) - 2.0 * at(t) + at(t - step)).norm() / (step * step);
    const double bound = motion.acceleration(static_cast<std::size_t>(link), point.norm());
    const double reach = 1.0 + at(t).norm();
    EXPECT_LE(second, bound * 1.001 + 1e-9 * reach / step);
    if (bound > 0.01 && reach < 10.0) nearest = std::max(nearest, second / bound);
  }
  EXPECT_GT(nearest, 0.5);
}

/// A point on a circle of radius r that turns by w per unit of t has the acceleration w^2 r.
TEST(VerifyMotion, TheAccelerationOfOneTurnIsThatOfACircle) {
  const std::vector<verify::Link> links(1);
  for (const double angle : {1e-3, 0.5, 1.5, 2.5, 3.1, -3.1}) {
    verify::Step step;
    step.from.push_back({{}, {1.0, 0.0, 0.0, 0.0}});
    step.to.push_back({{}, {std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle), 0.0}});
    const double truth = angle * angle * 0.7;
    const double bound = verify::Motion(links, step).acceleration(0, 0.7);
    EXPECT_GE(bound, truth * (1.0 - 1e-12)) << angle;
    EXPECT_LE(bound, truth * 1.01) << angle;
  }
}

TEST(VerifyMotion, TakesQuaternionsThatAreUnitToAThousandth) {
  using Turn = std::array<double, 4>;
  const auto whyNot = [](const Turn& from, const Turn& to) {
    verify::Step step;
    step.from.push_back({{}, from});
    step.to.push_back({{}, to});
    const std::vector<verify::Link> links(1);
    return verify::Motion(links, step).fault();
  };
  const Turn still{1.0, 0.0, 0.0, 0.0};
  for (const double norm : {1.0 - 1.1e-3, 1.0 - 0.9e-3, 1.0 + 0.9e-3, 1.0 + 1.1e-3}) {
    const Turn other{0.6 * norm, 0.0, -0.8 * norm, 0.0};
    const bool isTaken = std::abs(norm - 1.0) < 1e-3;
    for (const std::string& why : {whyNot(still, other), whyNot(other, still)}) {
      EXPECT_EQ(why.empty(), isTaken) << norm;
      EXPECT_TRUE(isTaken || holds(why, "expected unit quaternions")) << norm;
    }
  }
  // Of half a turn the sign is a matter of rounding.
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(whyNot(still, {sign * 1.1e-12, 1.0, 0.0, 0.0}), "");
    EXPECT_TRUE(holds(whyNot(still, {sign * 0.9e-12, 1.0, 0.0, 0.0}), "half a turn"));
  }
}

TEST(VerifyCertificate, RandomClearEdgesAreProvenAndLiesAreNot) {
  CertificateTally tally;
  for (std::uint64_t seed = 0; tally.clear < 150; ++seed) {
    EXPECT_EQ(runCertificateTrial(seed, 8, tally), "") << "seed " << seed;
    ASSERT_LT(seed, 3000u);
  }
  EXPECT_EQ(tally.verified, tally.clear);
  EXPECT_EQ(tally.believed, 0);
  for (int kind = 0; kind < 8; ++kind) EXPECT_GT(tally.ofKind[kind], 80) << kindOfLie(kind);
  EXPECT_GT(tally.planes, tally.clear) << "boxes alone decide nothing";
}

/// A corner that single precision does not hold stands for all that readers take it for, and here a
/// plane fits between the LSS and the corner, but not between the LSS and these.
TEST(VerifyCertificate, PlanesHoldWhatReadersTakeACornerFor) {
  CertificateTally tally;
  EXPECT_EQ(runCertificateTrial(170'948, 0, tally), "");
  EXPECT_EQ(tally.verified, 1);
}

/// A sphere of radius 0.1 that runs from x = 0 to x = 1, and a wall at `wall`.
std::string whyNot(double wall, const std::string& proof) {
  std::vector<verify::Triangle> triangles{
      {{verify::Vector{wall, -5, -5}, verify::Vector{wall, 5, -5}, verify::Vector{wall, 0, 9}}}};
  std::vector<verify::Link> links(1);
  links[0].capsules.push_back({{0, 0, 0}, {0, 0, 0}, 0.1});
  std::vector<verify::Step> steps;
  std::vector<verify::StepClaim> claims;
  EXPECT_EQ(
      verify::readSteps("foretouch-steps 1\nstep 0\n0 0 0 1 0 0 0\n1 0 0 1 0 0 0\n", 1, steps).what,
      "");
  const verify::Fault fault =
      verify::readCertificate("foretouch-certificate 1\n" + proof + "end\n", claims);
  const auto said = [](const verify::Fault& of) {
    return of.what.empty() ? "" : std::to_string(of.line) + ": " + of.what;
  };
  if (!fault.what.empty()) return said(fault);
  verify::Motion motion(links, steps.front());
  verify::Tally tally;
  return said(verify::SceneProof(triangles).prove(links, claims.front(), motion, tally));
}

TEST(VerifyCertificate, ByHandAtTheVeryEdge) {
  const std::string head = "step 0\nlink 0\nlss 0\n";
  EXPECT_EQ(whyNot(1.1 + 1e-12, head + "span 0 0\n"), "");
  EXPECT_TRUE(holds(whyNot(1.1 - 1e-12, head + "span 0 0\n"),
                    "5: triangle 0 is behind none of its planes"));
  EXPECT_EQ(whyNot(1.2, head + "span 0 0\nplane -1 0 0 -1.15\n"), "");
  EXPECT_EQ(whyNot(1.2, head + "span 1 0\nspan 1 1\n"), "");
  EXPECT_TRUE(holds(whyNot(1.2, head + "span 0 0\nplane -1 0 0 -1.05\n"),
                    "5: a plane that the LSS is not surely in front"));
  EXPECT_TRUE(holds(whyNot(1.2, head + "span 1 0\n"), "4: its spans end before t = 1"));
  EXPECT_TRUE(holds(whyNot(1.2, head + "span 1 1\n"), "5: it does not begin"));
  EXPECT_TRUE(holds(whyNot(1.2, head + "span 1 0\nspan 1 0\n"), "6: it does not begin"));
  EXPECT_TRUE(holds(whyNot(1.2, "step 0\nlink 0\n"), "3: of the link's 1 LSS only 0 have spans"));
  EXPECT_TRUE(
      holds(whyNot(1.2, "step 0\nlink 1\nlss 0\nspan 0 0\n"), "3: the avatar has no such link"));
  EXPECT_TRUE(
      holds(whyNot(1.2, "step 0\nlink 0\nlss 1\nspan 0 0\n"), "4: the link has no such LSS"));
}

TEST(VerifyReaders, RefuseWhatIsNotTheFormat) {
  for (const char* const text :
       {"", "step 0\n", "foretouch-certificate 2\nend\n", "foretouch-certificate 1\nstep 0\n",
        "foretouch-certificate 1\nlink 0\nend\n", "foretouch-certificate 1\nstep -1\nend\n",
        "foretouch-certificate 1\nend\nend\n", "foretouch-certificate 1\nstep 1 2\nend\n",
        "foretouch-certificate 1\nstep 0\nlink 0\nlss 0\nspan 41 0\nend\n",
        "foretouch-certificate 1\nstep 0\nlink 0\nlss 0\nspan 2 4\nend\n",
        "foretouch-certificate 1\nstep 0\nlink 0\nlss 0\nspan 0 0\nplane 1 2 3 nan\nend\n",
        "foretouch-certificate 1\nstep 0\nlink 0\nlss 0\nspan 0 0\nplane 1 2 3 1e99\nend\n"}) {
    std::vector<verify::StepClaim> claims;
    EXPECT_NE(verify::readCertificate(text, claims).what, "") << text;
  }
  for (const char* const text :
       {"", "v 0 0\n", "v 0 0 0\nf 1 1 2\n", "f 1 2 3\n", "v 0 0 0\nf 1 1\n",
        "v 0 0 0\nf 1 1 1 1\n", "v 0 0 inf\n", "curv 1 2\n"}) {
    std::vector<verify::Triangle> triangles;
    EXPECT_NE(verify::readScene(text, triangles).what, "") << text;
  }
  for (
      const char* const text :
      {"", "{", "[]", R"({"format":"foretouch-avatar","links":[]})",
       R"({"format":"x","links":[{"name":"a","parent":null,"lss":[]}]})",
       R"({"format":"foretouch-avatar","links":[{"name":"a","parent":"b","lss":[]}]})",
       R"({"format":"foretouch-avatar","links":[{"name":"a","parent":null,"lss":[{"a":[0,0,0]}]}]})",
       R"({"format":"foretouch-avatar","links":[{"name":"a","parent":null}]})",
       R"({"format":"foretouch-avatar","links":[{"name":"a","parent":null,"lss":{}}]})",
       R"({"format":"foretouch-avatar","links":[{"name":"a","parent":null,"lss":[],"lss":[]}]})"}) {
    std::vector<verify::Link> links;
    EXPECT_NE(verify::readAvatar(text, links).what, "") << text;
  }
}

TEST(VerifyReaders, SeeNothingBehindTheText) {
  for (const std::string_view text : {"[1] ", "{} ", "[1]\n2", "true\t"}) {
    verify::Json value;
    EXPECT_TRUE(verify::parseJson(text.substr(0, text.find_first_of(" \n\t")), value)) << text;
  }
}

/// Readers of single precision take a number for that next to it, on either side, or worse.
TEST(VerifyReaders, CornersHoldTwoNumbersOfSinglePrecisionOnEachSide) {
  for (const std::string x : {"0.1", "-0.1", "123456789", "-3.3e-12", "1e-50"}) {
    std::vector<verify::Triangle> triangles;
    ASSERT_EQ(verify::readScene("v " + x + " 0.5 -2\nf 1 1 1\n", triangles).what, "");
    const verify::Vector& corner = triangles.front().corners[0];
    const auto nearest = static_cast<float>(std::stod(x));
    EXPECT_LT(corner[0].lo, std::nextafter(nearest, -INFINITY)) << x;
    EXPECT_GT(corner[0].hi, std::nextafter(nearest, INFINITY)) << x;
    EXPECT_TRUE(corner[1].lo == 0.5 && corner[1].hi == 0.5);
    EXPECT_TRUE(corner[2].lo == -2.0 && corner[2].hi == -2.0);
  }
}

}  // namespace
}  // namespace foretouch::test
