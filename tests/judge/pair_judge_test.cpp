// tests/judge/pair_judge_test.cpp: the judge of two links that both move, on motions whose first
// contact is known in closed form while the whole body turns and drifts: it accepts the answers
// that keep the promise and names every planted lie.
#include <gtest/gtest.h>

#include "judge/judge.h"
#include "judge/plain_motion.h"
#include "tests/judge/expect_finding.h"
#include "tests/support/judged.h"
#include "tests/support/random_geometry.h"

namespace foretouch::oracle {
namespace {

using test::plain;
using test::Random;

constexpr int kPairs = 150;

std::array<double, 4> turnAbout(const Vec3d& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {std::cos(angle / 2), s * axis.x, s * axis.y, s * axis.z};
}

/// Two links below one root that turns and drifts.
struct PairCase {
  std::vector<Joint> joints{Joint{}, Joint{}, Joint{}};
  std::vector<Hull> one, other;
  int piece = 0, pieceOfOther = 0;  // that touch first
  Real gap = 0;                     // separation at t = 0
  Real rate = 0;                    // of approach, metres a step; or of both arms' turning, radians
  Real arm = 0;                     // length; 0: one link falls towards the other
  Real radiusOfOther = 0;

  explicit PairCase(Random& random) {
    joints[1].parent = joints[2].parent = 0;
    const auto from = random.rotation();
    joints[0].fromRotation = plain(from);
    joints[0].toRotation = plain(from * random.turn(random.uniform(0.0, 1.5)));
    joints[0].fromTranslation = Vec3d(random.inBox(5.0));
    joints[0].toTranslation = joints[0].fromTranslation + Vec3d(random.inBox(0.5));
  }
  [[nodiscard]] Real separation(Real t) const {
    return arm > 0 ? gap - 2 * arm * std::sin(rate * t) : gap - rate * t;
  }
  /// The instant at which the separation is `s`.
  [[nodiscard]] Real when(Real s) const {
    return arm > 0 ? std::asin((gap - s) / (2 * arm)) / rate : (gap - s) / rate;
  }
  /// What a flawless product would say with its contact at t.
  [[nodiscard]] Answer contactAt(Real t) const {
    Answer a;
    a.verdict = Verdict::Contact;
    a.toi = a.freeUntil = static_cast<double>(t);
    a.separation = static_cast<double>(std::max<Real>(0, separation(a.toi)));
    a.capsule = piece;
    a.triangle = pieceOfOther;
    // In the root's frame: arms turn about +Z and meet along +X, what falls meets along +Y.
    const Real x = arm > 0 ? arm * std::sin(rate * a.toi) - joints[1].fromTranslation.x : 0;
    const Real y = arm > 0 ? arm * std::cos(rate * a.toi) : 0;
    const Vec3r n = arm > 0 ? Vec3r{1, 0, 0} : Vec3r{0, 1, 0};
    const Vec3r on = Vec3r{x, y, 0} + radiusOfOther * n;
    std::vector<MovingFrame<Real>> frames;
    Motion(joints).framesAt(a.toi, frames);
    a.onScene = frames[0].at(on).as<double>();
    a.onLink = frames[0].at(on + a.separation * n).as<double>();
    a.normal = rotate(frames[0].q, n).as<double>();
    return a;
  }
  [[nodiscard]] Judgement judged(const Answer& answer, std::vector<RadiusSum> sums = {}) const {
    const Motion motion(joints);
    return Judge(motion, one, other, std::move(sums)).judge(answer, kTolerance);
  }
};

/// Two spheres at the ends of two arms that swing towards each other.
PairCase swingingSpheres(Random& random, bool touches) {
  PairCase c(random);
  const double radius = random.magnitude(1e-3, 0.1), radiusOfOther = random.magnitude(1e-3, 0.1);
  const double arm = random.magnitude(0.2, 1.0), angle = random.uniform(0.3, 1.2);
  const double way = touches ? 2 * arm * std::sin(random.uniform(0.1, 0.8) * angle)
                             : 2 * arm * std::sin(angle) + random.magnitude(2e-3, 5e-3);
  const double half = (radius + radiusOfOther + way) / 2;
  c.one = {{1, 2, {Vec3d{0, arm, 0}, Vec3d{0, arm, 0}}, radius}};
  c.other = {{2, 2, {Vec3d{0, arm, 0}, Vec3d{0, arm, 0}}, radiusOfOther}};
  c.joints[1].fromTranslation = c.joints[1].toTranslation = {half, 0, 0};
  c.joints[2].fromTranslation = c.joints[2].toTranslation = {-half, 0, 0};
  c.joints[1].toRotation = turnAbout({0, 0, 1}, angle);
  c.joints[2].toRotation = turnAbout({0, 0, 1}, -angle);
  c.gap = 2 * static_cast<Real>(half) - radius - radiusOfOther;
  c.arm = arm;
  c.rate = 2 * std::atan2(static_cast<Real>(std::sin(angle / 2)),
                          static_cast<Real>(std::cos(angle / 2)));
  c.radiusOfOther = radiusOfOther;
  return c;
}

/// How far apart two things start, and how far one of them falls.
void fall(PairCase& c, Random& random, bool touches, double apart) {
  const double drop = random.magnitude(1e-2, 2.0);
  const double way =
      touches ? drop * random.uniform(1.2, 3.0) : drop - random.magnitude(2e-3, 5e-3);
  Joint& falling = c.joints[1];
  falling.fromTranslation = {0, apart + drop, 0};
  falling.toTranslation = falling.fromTranslation - Vec3d{0, way, 0};
  c.gap = static_cast<Real>(falling.fromTranslation.y);
  c.rate = c.gap - falling.toTranslation.y;
}

/// Two capsules that cross; one falls on the other and turns about the vertical.
PairCase crossingCapsules(Random& random, bool touches) {
  PairCase c(random);
  const double radius = random.magnitude(1e-3, 0.1), radiusOfOther = random.magnitude(1e-3, 0.1);
  const auto half = [&] { return random.uniform(0.1, 0.5); };
  c.one = {{1, 2, {Vec3d{0, 9, 0}, Vec3d{0, 10, 0}}, 0.1},
           {1, 2, {Vec3d{-half(), 0, 0}, Vec3d{half(), 0, 0}}, radius}};
  c.other = {{2, 2, {Vec3d{0, 0, -half()}, Vec3d{0, 0, half()}}, radiusOfOther}};
  c.piece = 1;
  c.joints[1].toRotation = turnAbout({0, 1, 0}, random.uniform(-0.8, 0.8));
  fall(c, random, touches, radius + radiusOfOther);
  c.gap = c.gap - radius - radiusOfOther;
  c.radiusOfOther = radiusOfOther;
  return c;
}

/// A corner falls on a large triangle; many others are above and below.
PairCase fallingCorner(Random& random, bool touches) {
  PairCase c(random);
  const auto around = [&](double low, double high) {
    return Vec3d{random.uniform(-0.3, 0.3), random.uniform(low, high), random.uniform(-0.3, 0.3)};
  };
  for (int i = 0; i < 40; ++i) {
    c.one.push_back({1, 3, {around(0.01, 0.4), around(0.01, 0.4), around(0.01, 0.4)}, 0.0});
    c.other.push_back({2, 3, {around(-9, -8), around(-9, -8), around(-9, -8)}, 0.0});
  }
  c.piece = 13;
  c.one[13].points[1] = {0, 0, 0};
  c.pieceOfOther = 25;
  c.other[25].points = {Vec3d{-50, 0, -50}, Vec3d{60, 0, -40}, Vec3d{0, 0, 70}};
  fall(c, random, touches, 0.0);
  return c;
}

template <typename Check>
void forEachPair(bool touches, Check check) {
  for (int i = 0; i < kPairs; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    const PairCase c = i % 3 == 0   ? swingingSpheres(random, touches)
                       : i % 3 == 1 ? crossingCapsules(random, touches)
                                    : fallingCorner(random, touches);
    check(c, random);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(PairJudge, AcceptsContactWithinTheTolerance) {
  forEachPair(true, [](const PairCase& c, Random& random) {
    const double share = random.magnitude(1e-6, 0.999);
    expectFinding(c.judged(c.contactAt(c.when(share * kTolerance))), Finding::Ok);
  });
}

TEST(PairJudge, AcceptsClearWhereNothingIsTouched) {
  forEachPair(false,
              [](const PairCase& c, Random&) { expectFinding(c.judged(Answer{}), Finding::Ok); });
}

TEST(PairJudge, CatchesContactThatIsLateByAMillionth) {
  forEachPair(true, [](const PairCase& c, Random&) {
    expectFinding(c.judged(c.contactAt(c.when(0) + 1e-6L)), Finding::Late);
  });
}

// The guard grows with how far the links reach in the frame they share, not in the world.
TEST(PairJudge, CatchesContactThatIsLateByAFewLastPlaces) {
  forEachPair(true, [](const PairCase& c, Random&) {
    const Real depth = 4 * kSoundGuard * 80;  // the large triangle reaches that far
    expectFinding(c.judged(c.contactAt(c.when(-depth))), Finding::Late);
  });
}

TEST(PairJudge, CatchesContactReportedBeforeTheTolerance) {
  forEachPair(true, [](const PairCase& c, Random&) {
    expectFinding(c.judged(c.contactAt(c.when((1 + 1e-6L) * kTolerance))), Finding::Early);
  });
}

TEST(PairJudge, CatchesNeverHit) {
  forEachPair(
      true, [](const PairCase& c, Random&) { expectFinding(c.judged(Answer{}), Finding::Missed); });
}

TEST(PairJudge, CatchesAlwaysHit) {
  forEachPair(true, [](const PairCase& c, Random&) {
    expectFinding(c.judged(c.contactAt(0)), Finding::Early);
    Answer start = c.contactAt(0);
    start.verdict = Verdict::StartsInContact;
    expectFinding(c.judged(start), Finding::WrongStart);
  });
}

TEST(PairJudge, CatchesUndecidedThatClaimsTooMuch) {
  forEachPair(true, [](const PairCase& c, Random&) {
    Answer a;
    a.verdict = Verdict::Undecided;
    a.freeUntil = static_cast<double>(c.when(1e-5L));
    expectFinding(c.judged(a), Finding::Ok);
    a.freeUntil = static_cast<double>(c.when(0) + 1e-6L);
    expectFinding(c.judged(a), Finding::Late);
  });
}

TEST(PairJudge, CatchesWitnessesThatDoNotBelong) {
  forEachPair(true, [](const PairCase& c, Random& random) {
    const Answer right = c.contactAt(c.when(0.5L * kTolerance));
    const auto aside = [&] {
      const Vec3r n = right.normal.as<Real>();
      const Vec3r across = cross(n, Vec3r(random.direction()));
      return ((1e-8L / norm(across)) * across).as<double>();
    };
    Answer wrong = right;
    switch (random.below(8)) {
      case 0: wrong.separation += 1e-8; break;
      case 1: wrong.onScene = wrong.onScene + 1e-8 * wrong.normal; break;
      case 2: wrong.onLink = wrong.onLink + aside(); break;
      case 3: wrong.normal = -1.0 * wrong.normal; break;
      case 4: wrong.triangle = static_cast<int>(c.other.size()); break;
      case 5: wrong.capsule = -1; break;
      case 6: wrong.normal = wrong.normal + 1e4 * aside(); break;
      default: wrong.freeUntil = 1.0; break;
    }
    expectFinding(c.judged(wrong), Finding::Inconsistent);
    wrong = right;
    wrong.toi = std::numeric_limits<double>::quiet_NaN();
    expectFinding(c.judged(wrong), Finding::Inconsistent);
  });
}

TEST(PairJudge, CatchesPiecesThatAreNotTheOnesThatTouch) {
  for (int i = 0; i < 40; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const PairCase c = fallingCorner(random, true);
    Answer wrong = c.contactAt(c.when(0.5L * kTolerance));
    (i % 2 == 0 ? wrong.capsule : wrong.triangle) = 7;
    expectFinding(c.judged(wrong), Finding::Inconsistent);
  }
}

TEST(PairJudge, CatchesStartThatIsANanometreOff) {
  for (int i = 0; i < 40; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    PairCase c = crossingCapsules(random, true);
    const double apart = c.one[1].radius + c.other[0].radius;
    for (const double gap : {1e-9, -1e-9}) {
      c.joints[1].fromTranslation.y = apart + gap;
      c.gap = static_cast<Real>(apart + gap) - c.one[1].radius - c.other[0].radius;
      Answer start = c.contactAt(0);
      start.verdict = Verdict::StartsInContact;
      if (gap < 0) {
        start.penetration = static_cast<double>(-c.gap);
        start.onLink = start.onScene - start.penetration * start.normal;
      }
      expectFinding(c.judged(start), gap > 0 ? Finding::WrongStart : Finding::Ok);
    }
  }
}

TEST(PairJudge, MeetsByTheSumOfRadiiThatIsAskedFor) {
  for (int i = 0; i < 40; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const PairCase c = crossingCapsules(random, true);
    const double full = c.one[1].radius + c.other[0].radius;
    const std::vector<RadiusSum> smaller{{1, 0, 0.7 * full}};
    // What is right by the full radii is early by the smaller ones, and a later contact is right.
    expectFinding(c.judged(c.contactAt(c.when(0.5L * kTolerance)), smaller),
                  0.3 * full > kTolerance ? Finding::Early : Finding::Inconsistent);
    PairCase thinner = c;
    thinner.one[1].radius *= 0.7;
    thinner.other[0].radius *= 0.7;
    thinner.radiusOfOther *= 0.7;
    thinner.gap += static_cast<Real>(full) - static_cast<Real>(thinner.one[1].radius) -
                   static_cast<Real>(thinner.other[0].radius);
    if (thinner.when(0) > 1) continue;
    const Answer later = thinner.contactAt(thinner.when(0.5L * kTolerance));
    expectFinding(c.judged(later, smaller), Finding::Ok);
    expectFinding(c.judged(later), 0.3 * full > kTolerance ? Finding::Late : Finding::Inconsistent);
  }
}

TEST(PairJudge, CatchesADipBetweenTwoFreePoses) {
  // A pendulum passes another link's sphere; only between the poses is it inside, by `depth`.
  for (const double depth : {1e-2, 1e-5, 1e-8, 1e-11}) {
    SCOPED_TRACE(depth);
    Random random(1);
    PairCase c(random);
    c.one = {{1, 2, {Vec3d{0, -1, 0}, Vec3d{0, -1, 0}}, 0.05}};
    c.other = {{2, 2, {Vec3d{}, Vec3d{}}, 0.05}};
    c.joints[1].fromRotation = turnAbout({0, 0, 1}, -0.6);
    c.joints[1].toRotation = turnAbout({0, 0, 1}, 0.62);
    for (const double gap : {-depth, depth}) {
      c.joints[1].fromTranslation = c.joints[1].toTranslation = {0, 1.1 + gap, 0};
      expectFinding(c.judged(Answer{}), gap < 0 ? Finding::Missed : Finding::Ok);
    }
  }
}

TEST(PairJudge, CatchesTunnelling) {
  // Millimetre spheres cross at 50 m a step, and triangles pierce each other.
  for (const int count : {2, 3}) {
    Random random(2);
    PairCase c(random);
    const double size = count == 2 ? 0.0 : 1e-3;
    const Triangle points{Vec3d{0, -size, 0}, Vec3d{0, size, 0}, Vec3d{size, 0, size}};
    c.one = {{1, count, points, count == 2 ? 5e-4 : 0.0}};
    const Triangle pierced{Vec3d{0, 0, -size}, Vec3d{0, 0, size}, Vec3d{size, size, 0}};
    c.other = {{2, count, pierced, count == 2 ? 5e-4 : 0.0}};
    c.joints[1].fromTranslation = {30, 1e-4, 1e-4};
    c.joints[1].toTranslation = {-20, 1e-4, 1e-4};
    expectFinding(c.judged(Answer{}), Finding::Missed);
    c.joints[1].fromTranslation.y = c.joints[1].toTranslation.y = 2.1e-3;
    expectFinding(c.judged(Answer{}), Finding::Ok);
  }
}

TEST(PairJudge, BracketsTheFirstContact) {
  forEachPair(true, [](const PairCase& c, Random&) {
    const Motion motion(c.joints);
    const auto first = Judge(motion, c.one, c.other).firstContact();
    ASSERT_TRUE(first.has_value());
    EXPECT_LE(first->low, c.when(0) + 1e-13L);
    EXPECT_GE(first->high, c.when(0) - 1e-13L);
    EXPECT_LE(first->high - first->low, 1e-9L);
  });
  forEachPair(false, [](const PairCase& c, Random&) {
    const Motion motion(c.joints);
    EXPECT_FALSE(Judge(motion, c.one, c.other).firstContact().has_value());
  });
}

/// A tree of joints and two links of it, each with a few hulls: of two points, of three, or both.
struct RandomLinks {
  std::vector<Joint> joints;
  std::vector<Hull> one, other;

  explicit RandomLinks(Random& random) {
    const int count = 3 + random.below(4);
    for (int j = 0; j < count; ++j) {
      const auto from = random.rotation();
      Joint joint;
      joint.parent = j == 0 ? -1 : random.below(j);
      joint.fromRotation = plain(from);
      joint.toRotation = plain(from * random.turn(random.uniform(0.0, 2.0)));
      joint.fromTranslation = Vec3d(random.uniform(0.05, 0.3) * random.direction());
      joint.toTranslation = joint.fromTranslation + Vec3d(random.inBox(0.05));
      joints.push_back(joint);
    }
    const int a = random.below(count), b = (a + 1 + random.below(count - 1)) % count;
    one = hulls(random, a);
    other = hulls(random, b);
  }
  static std::vector<Hull> hulls(Random& random, int link) {
    std::vector<Hull> made;
    const int count = 1 + random.below(5);
    for (int i = 0; i < count; ++i) {
      Hull hull;
      hull.link = link;
      hull.count = 2 + random.below(2);
      const Vec3d center(random.inBox(0.2));
      for (Vec3d& p : hull.points) p = center + Vec3d(random.inBox(0.1));
      if (random.chance(0.1)) hull.points[1] = hull.points[0];
      hull.radius = hull.count == 3 && random.chance(0.7) ? 0.0 : random.magnitude(1e-3, 0.05);
      made.push_back(hull);
    }
    return made;
  }
  [[nodiscard]] Precise distance(const std::vector<PreciseFrame>& frames, const Hull& a,
                                 const Hull& b) const {
    const auto at = [&](const Hull& hull) {
      Corners<Precise> corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto k = std::min(i, static_cast<std::size_t>(hull.count - 1));
        corners[i] = frames[static_cast<std::size_t>(hull.link)].at(hull.points[k].as<Precise>());
      }
      return corners;
    };
    return preciseDistance(at(a), at(b)) - a.radius - b.radius;
  }
};

TEST(PairProver, MeasuresAsFiftyDigitsDo) {
  long double worst = 0;
  int touching = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    const RandomLinks c(random);
    const Motion motion(c.joints);
    const PairProver prover(motion, c.one, c.other);
    const double t = random.uniform(0, 1);
    const auto frames = preciseFrames(c.joints, Precise(t));
    Real least = Box::kEmpty;
    for (int k = 0; k < prover.numPieces(); ++k) {
      for (int j = 0; j < prover.numOthers(); ++j) {
        const auto truth = static_cast<long double>(c.distance(
            frames, c.one[static_cast<std::size_t>(k)], c.other[static_cast<std::size_t>(j)]));
        const Real separation = prover.separationFrom(k, j, t);
        worst = std::max(worst, std::abs(separation - truth));
        least = std::min(least, separation);
      }
    }
    EXPECT_EQ(static_cast<double>(prover.separationAt(t, Box::kEmpty) - least), 0.0);
    touching += least <= 0;
  }
  // Far inside kSoundGuard.
  EXPECT_LT(worst, 1e-17L);
  EXPECT_GT(touching, 15);
  std::cout << "worst error: " << worst << " m\n";
}

TEST(PairProver, FindsWhatALoopOverInstantsFinds) {
  constexpr int kInstants = 60;
  int found = 0, atOnce = 0, free = 0;
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    const RandomLinks c(random);
    const Motion motion(c.joints);
    Judge judge(motion, c.one, c.other);
    const auto first = judge.firstContact();
    const Real low = first ? first->low : 2;
    for (int k = 0; k <= kInstants; ++k) {
      const Real t = static_cast<Real>(k) / kInstants;
      if (t >= low) break;
      EXPECT_GT(judge.separationAt(t), 0) << "at t " << k << "/" << kInstants;
    }
    if (!first) {
      ++free;
      continue;
    }
    EXPECT_LE(judge.separationAt(first->high), 1e-12L);
    EXPECT_LE(first->high - first->low, 1e-9L);
    atOnce += first->high == 0;
    ++found;
  }
  EXPECT_GT(found - atOnce, 40);
  EXPECT_GT(free, 40);
}

// A part of many triangles in one place is smaller than any path, beside a triangle much larger.
TEST(PairProver, NeedsFewLooksForManyTrianglesInOnePlace) {
  for (int i = 0; i < 20; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    PairCase c = fallingCorner(random, false);
    for (Hull& hull : c.one) hull.points = {Vec3d{}, Vec3d{}, Vec3d{}};
    EXPECT_LT(c.judged(Answer{}).looks, 20'000u);
  }
}

// What carries both links does not cost a look.
TEST(PairProver, LooksNoMoreWhereTheWholeBodyTurns) {
  for (int i = 0; i < 60; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    PairCase c = crossingCapsules(random, false);
    c.joints[0].toRotation = c.joints[0].fromRotation;
    c.joints[0].toTranslation = c.joints[0].fromTranslation;
    const std::uint64_t atRest = c.judged(Answer{}).looks;
    c.joints[0].toRotation = turnAbout({0, 0.6, 0.8}, 2.5);
    c.joints[0].toTranslation.x += 30;
    EXPECT_EQ(c.judged(Answer{}).looks, atRest);
  }
}

}  // namespace
}  // namespace foretouch::oracle
