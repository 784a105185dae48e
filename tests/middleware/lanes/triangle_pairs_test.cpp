#include "middleware/lanes/triangle_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "lss/safe_step.h"
#include "lss/separation.h"
#include "lss/simd.h"
#include "lss/single.h"
#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using test::Random;
using Real = oracle::Precise;
using Vertices = std::array<Vector3d, 3>;

/// What moves in a pair, and what it is made of: two triangles, an axis and a triangle, or two
/// axes. An axis has its second point twice.
enum class PairKind { LinkMoves, BothMove, AxisAndTriangle, TwoAxes };

/// One pair as the lanes see it: everything in it is a float.
struct LanePair {
  Vertices link{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  Vertices scene = link, velocity = link;
  std::array<double, 3> acceleration{};
  double positionPad = 0.0, velocityPad = 0.0, floor = 0.0;
  // All pairs of a list are alike in that. Beyond the first kind the scene's side moves too.
  PairKind kind = PairKind::LinkMoves;
  Vertices otherVelocity = scene;
  double otherAcceleration = 0.0;
};

struct LaneAnswer {
  float lower = 0.0F, step = 0.0F;
};

/// The largest float not above a double that is at least 0.
double floatBelow(double value) {
  const double nearest = nearestFloat(value);
  return nearest <= value ? nearest : std::nextafter(static_cast<float>(nearest), 0.0F);
}

void put(const LanePair& pair, std::size_t lane, TrianglePairBlock& block, OtherMotions& others) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      block.link[i][axis][lane] = static_cast<float>(pair.link[i][axis]);
      block.scene[i][axis][lane] = static_cast<float>(pair.scene[i][axis]);
      block.velocity[i][axis][lane] = static_cast<float>(pair.velocity[i][axis]);
    }
    block.acceleration[i][lane] = static_cast<float>(pair.acceleration[i]);
    for (int axis = 0; axis < 3; ++axis) {
      others.velocity[i][axis][lane] = static_cast<float>(pair.otherVelocity[i][axis]);
    }
  }
  block.positionPad[lane] = static_cast<float>(pair.positionPad);
  block.velocityPad[lane] = static_cast<float>(pair.velocityPad);
  block.floor[lane] = static_cast<float>(pair.floor);
  others.acceleration[lane] = static_cast<float>(pair.otherAcceleration);
}

/// Of all pairs, in blocks, by the instructions in use.
std::vector<LaneAnswer> answersTo(const std::vector<LanePair>& pairs) {
  std::vector<LaneAnswer> answers(pairs.size());
  TrianglePairBlock block{};
  OtherMotions others{};
  TrianglePairSteps steps{};
  for (std::size_t first = 0; first < pairs.size(); first += kTrianglePairLanes) {
    const std::size_t count = std::min(kTrianglePairLanes, pairs.size() - first);
    for (std::size_t lane = 0; lane < count; ++lane) put(pairs[first + lane], lane, block, others);
    switch (pairs.front().kind) {
      case PairKind::LinkMoves: proveSteps(block, count, steps); break;
      case PairKind::BothMove: proveSteps(block, others, count, steps); break;
      case PairKind::AxisAndTriangle: proveSegmentSteps(block, others, count, steps); break;
      case PairKind::TwoAxes: proveAxisSteps(block, others, count, steps); break;
    }
    for (std::size_t lane = 0; lane < count; ++lane) {
      answers[first + lane] = {steps.lower[lane], steps.step[lane]};
    }
  }
  return answers;
}

/// The answers of every width that the processor has; the widest is in use again afterwards.
std::vector<std::vector<LaneAnswer>> answersOfEveryWidth(const std::vector<LanePair>& pairs) {
  std::vector<std::vector<LaneAnswer>> all;
  for (const Simd simd : supportedSimd()) {
    if (useSimd(simd)) all.push_back(answersTo(pairs));
  }
  useSimd(std::nullopt);
  return all;
}

/// The boldest of all widths: what it claims, it claims alone.
std::vector<LaneAnswer> boldestAnswers(const std::vector<LanePair>& pairs) {
  std::vector<LaneAnswer> boldest(pairs.size());
  for (const std::vector<LaneAnswer>& answers : answersOfEveryWidth(pairs)) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      boldest[i].lower = std::max(boldest[i].lower, answers[i].lower);
      boldest[i].step = std::max(boldest[i].step, answers[i].step);
    }
  }
  return boldest;
}

std::array<Precise3, 3> precise(const Vertices& v) {
  return {Precise3(v[0]), Precise3(v[1]), Precise3(v[2])};
}

Real trueDistance(const LanePair& pair) {
  return oracle::preciseDistance(precise(pair.link), precise(pair.scene));
}

/// Two triangles within about `size` of `center`, a third of them degenerate, or nearly, or close.
LanePair randomTriangles(Random& random, double size, const Vector3d& center) {
  LanePair pair;
  const test::RandomPair p = test::randomPair(random, size, center);
  pair.link = {p.a, p.b, center + random.inBox(size)};
  pair.scene = p.v;
  if (random.chance(0.05)) pair.link[2] = pair.scene[1];                // a shared corner
  if (random.chance(0.05)) pair.link[2] = 0.5 * (p.a + p.b);            // no area
  if (random.chance(0.03)) pair.link[1] = pair.link[2] = p.a;           // a point
  if (random.chance(0.05)) pair.link = {p.v[0], p.v[1], pair.link[2]};  // a shared edge
  if (random.chance(0.3)) {                                             // beside each other
    const Vector3d away = random.magnitude(1e-5, 1e1) * size * random.direction();
    for (Vector3d& v : pair.link) v = center + 0.3 * (v - center) + away;
  }
  if (random.chance(0.1)) {  // parallel faces
    const Vector3d away = random.magnitude(1e-6, 1.0) * size * random.direction();
    for (std::size_t i = 0; i < 3; ++i) pair.link[i] = pair.scene[i] + away;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    pair.link[i] = nearestFloat(pair.link[i]);
    pair.scene[i] = nearestFloat(pair.scene[i]);
  }
  return pair;
}

/// What the floats' rounding may take off the distance, from triangle_pairs.md.
double provedSlack(const LanePair& pair) {
  double link = 0.0, scene = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    link = std::max(link, (pair.link[i] - pair.scene[0]).norm());
    scene = std::max(scene, (pair.scene[i] - pair.scene[0]).norm());
  }
  return 6.5 * 0x1p-24 * (link + scene);
}

TEST(TrianglePairLanes, NeverClaimMoreThanTheTrueDistance) {
  constexpr int kCases = 8000;
  std::vector<LanePair> pairs;
  for (int i = 0; i < kCases; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const double size = random.magnitude(1e-6, 1e3);
    const Vector3d center = i % 3 == 0 ? random.inBox(1e2 * size) : Vector3d(0, 0, 0);
    pairs.push_back(randomTriangles(random, size, center));
  }
  const std::vector<LaneAnswer> answers = boldestAnswers(pairs);
  double worstShare = -std::numeric_limits<double>::infinity();
  int apart = 0, close = 0, tight = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    SCOPED_TRACE(i);
    const Real distance = trueDistance(pairs[i]);
    ASSERT_LE(Real(answers[i].lower), distance);
    const double truth = static_cast<double>(distance), slack = provedSlack(pairs[i]);
    if (answers[i].lower > 0.0F) {
      worstShare = std::max(worstShare, (answers[i].lower + slack - truth) / slack);
    }
    if (!(truth > 100.0 * slack)) continue;
    ++apart;
    if (answers[i].lower >= truth * (1.0 - 1e-5)) ++tight;
    if (answers[i].lower >= truth - 3.0 * slack - 1e-6 * truth) ++close;
  }
  std::cout << "apart by 100 slacks: " << apart << ", within 1e-5 of the distance: " << tight
            << ", within 3 slacks: " << close << ", worst share of the slack: " << worstShare
            << "\n";
  EXPECT_LT(worstShare, 0.6);
  EXPECT_GT(worstShare, 0.01) << "the test no longer sees any rounding";
  EXPECT_GT(apart, kCases / 3);
  EXPECT_GT(close, apart * 95 / 100) << "a bound that is not tight proves nothing";
}

/// Two edges about 1 m long that cross at an angle, the second `height` above the first, each the
/// edge of a triangle that leads away from the other.
LanePair crossingEdges(Random& random, double angle, double height) {
  const Eigen::Matrix3d turn = random.rotation().toRotationMatrix();
  const Vector3d one(1, 0, 0), other(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
  const double x = random.uniform(0.2, 0.8), y = random.uniform(0.2, 0.8);
  LanePair pair;
  pair.scene = {-x * one, (1.0 - x) * one, random.inBox(0.3) - 0.5 * up};
  pair.link = {height * up - y * other, height * up + (1.0 - y) * other,
               random.inBox(0.3) + 0.5 * up};
  for (std::size_t i = 0; i < 3; ++i) {
    pair.scene[i] = nearestFloat(Vector3d(turn * pair.scene[i]));
    pair.link[i] = nearestFloat(Vector3d(turn * pair.link[i]));
  }
  return pair;
}

/// The same with a corner above an edge.
LanePair cornerAboveEdge(Random& random, double height) {
  LanePair pair = crossingEdges(random, 1.0, height);
  const Vector3d foot = pair.scene[0] + 0.4 * (pair.scene[1] - pair.scene[0]);
  const Vector3d away = foot - pair.scene[2];
  pair.link[0] = nearestFloat(Vector3d(foot + height * away.normalized()));
  for (std::size_t i = 1; i < 3; ++i) {
    pair.link[i] = nearestFloat(Vector3d(pair.link[0] + away + random.inBox(0.2)));
  }
  return pair;
}

TEST(TrianglePairLanes, StayTightWhereEdgesAreTenMicrometresApart) {
  std::vector<LanePair> pairs;
  for (int i = 0; i < 1000; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const double height = random.magnitude(1e-5, 1e-2);
    pairs.push_back(crossingEdges(random, random.magnitude(0.03, 1.5), height));
    pairs.push_back(cornerAboveEdge(random, height));
  }
  for (const std::vector<LaneAnswer>& answers : answersOfEveryWidth(pairs)) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const double above = separation({pairs[i].link, 3}, {pairs[i].scene, 3}).upper;
      EXPECT_GE(answers[i].lower, above - 4.0 * provedSlack(pairs[i])) << i;
    }
  }
}

/// A pair in motion, as it truly is: within the pads of what the lanes are told.
struct TrueMotion {
  using Points = std::array<Precise3, 3>;
  Points link, velocity, acceleration, scene, otherVelocity, otherAcceleration;

  [[nodiscard]] Real distanceAfter(const Real& s) const {
    const auto moved = [&s](const Points& from, const Points& v, const Points& a) {
      Points to;
      for (std::size_t i = 0; i < 3; ++i) to[i] = from[i] + s * v[i] + Real(s * s / 2) * a[i];
      return to;
    };
    return oracle::preciseDistance(moved(link, velocity, acceleration),
                                   moved(scene, otherVelocity, otherAcceleration));
  }
};

/// What nobody knows of a pair: its directions, each half the time straight across the gap; in a
/// quarter of the pairs all of them, against the pair.
class Unknown {
 public:
  explicit Unknown(Random& random) : random_(random), isWorst_(random.chance(0.25)) {}
  Vector3d operator()(const Vector3d& across) {
    const Vector3d direction =
        isWorst_ || random_.chance(0.5) ? across : Vector3d(random_.direction());
    return (1.0 - 1e-12) * direction;
  }

 private:
  Random& random_;
  bool isWorst_;
};

void makeAxis(Vertices& points, Vertices& velocity) {
  points[2] = points[1];
  velocity[2] = velocity[1];
}

LanePair randomMotion(Random& random, PairKind kind) {
  const double size = random.magnitude(1e-4, 1e1);
  LanePair pair = randomTriangles(random, size, random.inBox(size));
  const Vector3d drift = random.magnitude(1e-3, 1e2) * size * random.direction();
  const double strongest = random.magnitude(1e-4, 1e3) * size;
  for (std::size_t i = 0; i < 3; ++i) {
    pair.velocity[i] = nearestFloat(Vector3d(drift + random.inBox(0.3 * drift.norm())));
    pair.acceleration[i] =
        random.chance(0.1) ? 0.0 : nearestFloat(random.uniform(0, 1) * strongest);
  }
  if (random.chance(0.1)) pair.velocity.fill(Vector3d::Zero());
  pair.kind = kind;
  if (kind != PairKind::LinkMoves) {
    // Half of them ride along.
    const Vector3d other = random.chance(0.5) ? drift : Vector3d(drift.norm() * random.direction());
    for (Vector3d& v : pair.otherVelocity) {
      v = nearestFloat(Vector3d(other + random.inBox(0.3 * drift.norm())));
    }
    pair.otherAcceleration = nearestFloat(random.uniform(0, 1) * strongest);
    if (random.chance(0.5)) {  // neither turns: every vertex moves like the one that is nearest
      pair.velocity.fill(pair.velocity[0]);
      pair.otherVelocity.fill(pair.otherVelocity[0]);
    }
  }
  if (kind == PairKind::AxisAndTriangle || kind == PairKind::TwoAxes) {
    makeAxis(pair.link, pair.velocity);
    pair.acceleration[2] = pair.acceleration[1];
  }
  if (kind == PairKind::TwoAxes) makeAxis(pair.scene, pair.otherVelocity);
  pair.positionPad = random.chance(0.3) ? 0.0 : nearestFloat(random.magnitude(1e-8, 1e-2) * size);
  pair.velocityPad = random.chance(0.3) ? 0.0 : nearestFloat(random.magnitude(1e-8, 1e-1) * size);
  pair.floor = random.chance(0.3) ? 0.0 : nearestFloat(random.magnitude(1e-6, 1e-1) * size);
  return pair;
}

TrueMotion truthWithin(const LanePair& pair, Random& random) {
  const Separation now = separation({pair.link, 3}, {pair.scene, 3});
  const Vector3d across = -now.nhat;
  const double linkShare = random.uniform(0.0, 1.0);
  Unknown unknown(random);
  const Vector3d linkOff = linkShare * pair.positionPad * unknown(across);
  const Vector3d sceneOff = (1.0 - linkShare) * pair.positionPad * unknown(-across);
  const double velocityPad = linkShare * pair.velocityPad;
  const bool doBothMove = pair.kind != PairKind::LinkMoves;
  const double otherPad = doBothMove ? (1.0 - linkShare) * pair.velocityPad : 0.0;
  TrueMotion truth;
  for (std::size_t i = 0; i < 3; ++i) {
    truth.otherVelocity[i] =
        Precise3(pair.otherVelocity[i]) + Precise3(Vector3d(otherPad * unknown(-across)));
    truth.otherAcceleration[i] = Precise3(Vector3d(pair.otherAcceleration * unknown(-across)));
    truth.link[i] = Precise3(pair.link[i]) + Precise3(linkOff);
    truth.scene[i] = Precise3(pair.scene[i]) + Precise3(sceneOff);
    truth.velocity[i] =
        Precise3(pair.velocity[i]) +
        Precise3(Vector3d((doBothMove ? velocityPad : pair.velocityPad) * unknown(across)));
    truth.acceleration[i] = Precise3(Vector3d(pair.acceleration[i] * unknown(across)));
  }
  if (pair.kind == PairKind::AxisAndTriangle || pair.kind == PairKind::TwoAxes) {
    truth.velocity[2] = truth.velocity[1];
    truth.acceleration[2] = truth.acceleration[1];
  }
  if (pair.kind == PairKind::TwoAxes) {
    truth.otherVelocity[2] = truth.otherVelocity[1];
    truth.otherAcceleration[2] = truth.otherAcceleration[1];
  }
  return truth;
}

/// What movingPair() proves of the same pair, in doubles.
double stepInDoubles(const LanePair& pair) {
  const Separation now = separation({pair.link, 3}, {pair.scene, 3});
  double step = std::numeric_limits<double>::infinity();
  double otherSpeed = -std::numeric_limits<double>::infinity();
  for (const Vector3d& v : pair.otherVelocity) otherSpeed = std::max(otherSpeed, now.nhat.dot(v));
  for (std::size_t i = 0; i < 3; ++i) {
    const double clearance = now.clearance[i] - pair.positionPad - pair.floor;
    if (!(clearance > 0.0)) return 0.0;
    const double speed = now.nhat.dot(pair.velocity[i]) - otherSpeed - pair.velocityPad;
    const double acceleration = pair.acceleration[i] + pair.otherAcceleration;
    step = std::min(step, safeStep(clearance, speed, acceleration));
  }
  return step;
}

class StepsOfTrianglePairs : public testing::TestWithParam<PairKind> {};

TEST_P(StepsOfTrianglePairs, KeepTheTrueTrianglesAtTheFloorOrAbove) {
  constexpr int kCases = 2000;
  std::vector<LanePair> pairs;
  for (int i = 0; i < kCases; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    pairs.push_back(randomMotion(random, GetParam()));
  }
  const std::vector<LaneAnswer> answers = boldestAnswers(pairs);
  int moving = 0, asFar = 0, spent = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    SCOPED_TRACE(i);
    Random random(i + kCases);
    const TrueMotion truth = truthWithin(pairs[i], random);
    const Real step(answers[i].step), floor(pairs[i].floor);
    ASSERT_GE(step, 0);
    ASSERT_LE(Real(answers[i].lower), truth.distanceAfter(Real(0)));
    if (step == 0) continue;
    ASSERT_GT(Real(answers[i].lower), floor);
    for (const double share : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      ASSERT_GE(truth.distanceAfter(Real(share) * step), floor) << share;
    }
    // Just beyond the step the floor may be broken: it must be, now and then.
    if (truth.distanceAfter(Real(1.001) * step) < floor) ++spent;
    const double reference = stepInDoubles(pairs[i]);
    if (!(reference > 0.0)) continue;
    ++moving;
    if (answers[i].step >= 0.999 * std::min(reference, 1e6)) ++asFar;
  }
  std::cout << "moving: " << moving << ", as far as in doubles: " << asFar
            << ", the floor is broken just beyond: " << spent << "\n";
  EXPECT_GT(moving, kCases / 3);
  EXPECT_GT(asFar, moving * 9 / 10);
  EXPECT_GT(spent, kCases / 200) << "the test no longer sees a step that is used up";
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, StepsOfTrianglePairs,
                         testing::Values(PairKind::LinkMoves, PairKind::BothMove,
                                         PairKind::AxisAndTriangle, PairKind::TwoAxes));

/// Two triangles 1 m apart, closing at 1 m per t.
LanePair closingPair() {
  LanePair pair;
  pair.scene = {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)};
  pair.link = {Vector3d(0, 0, 1), Vector3d(1, 0, 1), Vector3d(0, 1, 1.5)};
  pair.velocity.fill(Vector3d(0, 0, -1));
  return pair;
}

TEST(TrianglePairLanes, ClosedFormsAreAnswered) {
  LanePair straight = closingPair();
  LanePair braked = closingPair();  // 1 + s/2 - s^2 = 1/4
  braked.velocity.fill(Vector3d(0, 0, 0.5));
  braked.acceleration.fill(2.0);
  braked.floor = 0.25;
  LanePair still = closingPair();
  still.velocity.fill(Vector3d::Zero());
  for (const auto& answers : answersOfEveryWidth({straight, braked, still})) {
    for (const LaneAnswer& answer : answers) {
      EXPECT_LE(answer.lower, 1.0F);
      EXPECT_NEAR(answer.lower, 1.0F, 2e-6F);
    }
    EXPECT_NEAR(answers[0].step, 1.0F, 4e-6F);
    EXPECT_NEAR(answers[1].step, 0.25F + std::sqrt(0.8125F), 4e-6F);
    EXPECT_GT(answers[2].step, 1e4F);
    EXPECT_TRUE(std::isfinite(answers[2].step));
  }
}

TEST(TrianglePairLanes, WhatTouchesOrIsWithinTheFloorOrThePadIsLeftOpen) {
  std::vector<LanePair> pairs(6, closingPair());
  pairs[0].link[1] = pairs[0].scene[1];  // one corner in common
  pairs[1].link = pairs[1].scene;        // the same triangle
  pairs[2].link = {Vector3d(0.2, 0.2, -1), Vector3d(0.2, 0.3, 1), Vector3d(0.3, 0.2, 1)};
  pairs[3].floor = 1.0;
  pairs[4].positionPad = 1.0;
  for (Vector3d& v : pairs[5].link) v = pairs[5].scene[1];  // two points, one a corner
  for (const auto& answers : answersOfEveryWidth(pairs)) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_EQ(answers[i].step, 0.0F) << i;
      if (i != 3) {
        EXPECT_EQ(answers[i].lower, 0.0F) << i;
      }
    }
  }
}

TEST(TrianglePairLanes, PiercingTrianglesAreNeverProvenApart) {
  std::vector<LanePair> piercing;
  for (int i = 0; piercing.size() < 400; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const LanePair pair = randomTriangles(random, 1.0, Vector3d::Zero());
    if (trueDistance(pair) == 0) piercing.push_back(pair);
  }
  for (const LaneAnswer& answer : boldestAnswers(piercing)) {
    EXPECT_EQ(answer.lower, 0.0F);
    EXPECT_EQ(answer.step, 0.0F);
  }
}

/// Each of the numbers that make a pair, one after the other: those of a pair of which both sides
/// move last.
constexpr std::size_t kNumbers = 33, kNumbersOfBoth = kNumbers + 10;
std::vector<float*> numbersOf(TrianglePairBlock& block, OtherMotions& others, std::size_t lane) {
  std::vector<float*> numbers;
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      for (auto* of : {&block.link, &block.velocity, &block.scene}) {
        numbers.push_back(&(*of)[i][axis][lane]);
      }
    }
    numbers.push_back(&block.acceleration[i][lane]);
  }
  for (PairFloats* of : {&block.positionPad, &block.velocityPad, &block.floor}) {
    numbers.push_back(&(*of)[lane]);
  }
  for (auto& vertex : others.velocity) {
    for (PairFloats& axis : vertex) numbers.push_back(&axis[lane]);
  }
  numbers.push_back(&others.acceleration[lane]);
  return numbers;
}

TEST(TrianglePairLanes, BrokenNumbersProveNothingAndSpoilNoOtherPair) {
  const float infinity = std::numeric_limits<float>::infinity();
  const LanePair sane = closingPair();
  for (const Simd simd : supportedSimd()) {
    if (!useSimd(simd)) continue;
    for (const float broken : {std::nanf(""), infinity, -infinity, 1e30F, 3e38F, -3e38F}) {
      for (std::size_t which = 0; which < kNumbers + kNumbersOfBoth; ++which) {
        TrianglePairBlock block{};
        OtherMotions others{};
        for (std::size_t lane = 0; lane < kTrianglePairLanes; ++lane)
          put(sane, lane, block, others);
        const std::size_t lane = which % kTrianglePairLanes;
        *numbersOf(block, others, lane)[which < kNumbers ? which : which - kNumbers] = broken;
        TrianglePairSteps steps{};
        if (which < kNumbers) {
          proveSteps(block, kTrianglePairLanes, steps);
        } else {
          proveSteps(block, others, kTrianglePairLanes, steps);
        }
        for (std::size_t other = 0; other < kTrianglePairLanes; ++other) {
          if (other == lane) {
            EXPECT_EQ(steps.step[other], 0.0F) << toString(simd) << " " << which << " " << broken;
            EXPECT_LE(steps.lower[other], 1.0F);
          } else {
            EXPECT_GT(steps.step[other], 0.9F) << toString(simd) << " " << which;
          }
        }
      }
    }
  }
  useSimd(std::nullopt);
}

TEST(TrianglePairLanes, AnswersDoNotDependOnTheSlot) {
  std::vector<LanePair> pairs;
  for (int i = 0; i < 37; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    pairs.push_back(randomMotion(random, PairKind::LinkMoves));
  }
  std::vector<LanePair> shifted(pairs.begin() + 5, pairs.end());
  const auto all = answersOfEveryWidth(pairs), allShifted = answersOfEveryWidth(shifted);
  for (std::size_t width = 0; width < all.size(); ++width) {
    for (std::size_t i = 0; i < shifted.size(); ++i) {
      EXPECT_EQ(allShifted[width][i].lower, all[width][i + 5].lower);
      EXPECT_EQ(allShifted[width][i].step, all[width][i + 5].step);
    }
  }
}

TEST(TrianglePairLanes, TinyAndHugeExtentsStayBounded) {
  std::vector<LanePair> pairs;
  for (int i = 0; i < 2000; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const double size = i % 2 == 0 ? random.magnitude(1e-44, 1e-8) : random.magnitude(1e5, 1e14);
    pairs.push_back(randomTriangles(random, size, Vector3d::Zero()));
    pairs.back().velocity.fill(nearestFloat(Vector3d(random.inBox(size))));
    pairs.back().acceleration.fill(floatBelow(size));
  }
  const std::vector<LaneAnswer> answers = boldestAnswers(pairs);
  int proven = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    SCOPED_TRACE(i);
    ASSERT_LE(Real(answers[i].lower), trueDistance(pairs[i]));
    ASSERT_TRUE(answers[i].step >= 0.0F && std::isfinite(answers[i].step));
    if (answers[i].step > 0.0F) ++proven;
  }
  EXPECT_GT(proven, 500);
}

}  // namespace
}  // namespace foretouch::internal
