// tests/judge/judge_test.cpp: the judge on motions whose first contact is known in closed
// form: it accepts the answers that keep the promise and names every planted lie.
#include "judge/judge.h"

#include <gtest/gtest.h>

#include "tests/judge/expect_finding.h"
#include "tests/support/random_geometry.h"

namespace foretouch::oracle {
namespace {

using test::Random;

constexpr int kCases = 200;

/// A capsule over the floor y = 0, with its height over it in closed form.
struct FloorCase {
  std::vector<Joint> joints{Joint{}};
  std::vector<Capsule> capsules{Capsule{}};
  Scene floor{{Triangle{Vec3d{-50, 0, -50}, Vec3d{60, 0, -40}, Vec3d{0, 0, 70}}}};
  Real drop = 0;    // separation at t = 0
  Real length = 0;  // of the rod; 0: a sphere that falls at `drop` per `impact`
  Real rate = 0;    // of turning, radians a step; or of falling, metres a step
  Real height = 0;  // of the pivot
  Real radius = 0;

  [[nodiscard]] Real separation(Real t) const {
    return length > 0 ? height - length * std::sin(rate * t) - radius : drop - rate * t;
  }
  /// The instant at which the separation is `s`.
  [[nodiscard]] Real when(Real s) const {
    return length > 0 ? std::asin((height - radius - s) / length) / rate : (drop - s) / rate;
  }
  [[nodiscard]] Vec3r foot(Real t) const {
    if (length == 0) return {joints[0].fromTranslation.x, 0, 0};
    return {length * std::cos(rate * t), 0, 0};
  }
  /// What a flawless product would say with its contact at t.
  [[nodiscard]] Answer contactAt(Real t) const {
    Answer a;
    a.verdict = Verdict::Contact;
    a.toi = a.freeUntil = static_cast<double>(t);
    const Vec3r at = foot(a.toi);
    a.separation = static_cast<double>(std::max<Real>(0, separation(a.toi)));
    a.triangle = a.capsule = 0;
    a.onScene = at.as<double>();
    a.onLink = {static_cast<double>(at.x), a.separation, 0};
    a.normal = {0, 1, 0};
    return a;
  }
  [[nodiscard]] Judgement judged(const Answer& answer, double tolerance = kTolerance) const {
    const Motion motion(joints);
    return Judge(floor, motion, 0, capsules).judge(answer, tolerance);
  }
};

FloorCase fallingSphere(Random& random, bool touches) {
  FloorCase c;
  const double radius = random.magnitude(1e-3, 0.3);
  const double drop = random.magnitude(1e-2, 3.0);
  const double fall =
      touches ? drop * random.uniform(1.2, 3.0) : drop - random.magnitude(2e-3, 5e-3);
  const double start = radius + drop;
  c.capsules[0] = {{Vec3d{}, Vec3d{}}, radius};
  c.joints[0].fromTranslation = {random.uniform(-5, 5), start, 0};
  c.joints[0].toTranslation = c.joints[0].fromTranslation - Vec3d{0, fall, 0};
  c.radius = radius;
  c.drop = static_cast<Real>(start) - radius;
  c.rate = static_cast<Real>(c.joints[0].fromTranslation.y) - c.joints[0].toTranslation.y;
  return c;
}

FloorCase turningRod(Random& random, bool touches) {
  FloorCase c;
  const double radius = random.magnitude(1e-3, 0.1);
  const double length = random.magnitude(0.2, 2.0);
  const double angle = random.uniform(0.3, 1.2);
  // Touching halfway down at the latest, or short of it at the end by millimetres.
  const double height = touches ? radius + length * std::sin(random.uniform(0.1, 0.8) * angle)
                                : radius + length * std::sin(angle) + random.magnitude(2e-3, 5e-3);
  c.capsules[0] = {{Vec3d{}, Vec3d{length, 0, 0}}, radius};
  c.joints[0].fromTranslation = c.joints[0].toTranslation = {0, height, 0};
  c.joints[0].toRotation = {std::cos(angle / 2), 0, 0, -std::sin(angle / 2)};
  c.length = length;
  c.rate = 2 * std::atan2(static_cast<Real>(std::sin(angle / 2)),
                          static_cast<Real>(std::cos(angle / 2)));
  c.height = height;
  c.radius = radius;
  return c;
}

template <typename Check>
void forEachCase(bool touches, Check check) {
  for (int i = 0; i < kCases; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    check(i % 2 == 0 ? fallingSphere(random, touches) : turningRod(random, touches), random);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(OracleJudge, AcceptsContactWithinTheTolerance) {
  forEachCase(true, [](const FloorCase& c, Random& random) {
    const double share = random.magnitude(1e-6, 0.999);
    expectFinding(c.judged(c.contactAt(c.when(share * kTolerance))), Finding::Ok);
  });
}

TEST(OracleJudge, AcceptsClearWhereNothingIsTouched) {
  forEachCase(false,
              [](const FloorCase& c, Random&) { expectFinding(c.judged(Answer{}), Finding::Ok); });
}

TEST(OracleJudge, CatchesContactThatIsLateByAMillionth) {
  forEachCase(true, [](const FloorCase& c, Random&) {
    expectFinding(c.judged(c.contactAt(c.when(0) + 1e-6L)), Finding::Late);
  });
}

TEST(OracleJudge, CatchesContactThatIsLateByAFewLastPlaces) {
  forEachCase(true, [](const FloorCase& c, Random&) {
    const Real depth = 4 * kSoundGuard * (c.radius + c.drop + c.height + c.length + 8);
    expectFinding(c.judged(c.contactAt(c.when(-depth))), Finding::Late);
  });
}

TEST(OracleJudge, CatchesContactReportedBeforeTheTolerance) {
  forEachCase(true, [](const FloorCase& c, Random&) {
    expectFinding(c.judged(c.contactAt(c.when((1 + 1e-6L) * kTolerance))), Finding::Early);
  });
}

TEST(OracleJudge, CatchesNeverHit) {
  forEachCase(true, [](const FloorCase& c, Random&) {
    expectFinding(c.judged(Answer{}), Finding::Missed);
  });
}

TEST(OracleJudge, CatchesAlwaysHit) {
  forEachCase(true, [](const FloorCase& c, Random&) {
    expectFinding(c.judged(c.contactAt(0)), Finding::Early);
    Answer start = c.contactAt(0);
    start.verdict = Verdict::StartsInContact;
    expectFinding(c.judged(start), Finding::WrongStart);
  });
}

TEST(OracleJudge, CatchesStartThatIsANanometreOff) {
  FloorCase c;
  c.capsules[0].radius = 0.25;
  c.joints[0].fromTranslation = {0, 0.25 + 1e-9, 0};
  c.joints[0].toTranslation = {0, 0.1, 0};
  c.drop = 1e-9L;
  c.rate = 0.15L;
  Answer start = c.contactAt(0);
  start.verdict = Verdict::StartsInContact;
  expectFinding(c.judged(start), Finding::WrongStart);
  // The same with the sphere a nanometre inside is right, once the depth is named.
  c.joints[0].fromTranslation.y = 0.25 - 1e-9;
  start.separation = 0;
  start.penetration = 1e-9;
  start.onLink.y = -1e-9;
  expectFinding(c.judged(start), Finding::Ok);
}

TEST(OracleJudge, CatchesUndecidedThatClaimsTooMuch) {
  forEachCase(true, [](const FloorCase& c, Random&) {
    Answer a;
    a.verdict = Verdict::Undecided;
    a.freeUntil = static_cast<double>(c.when(1e-5L));
    expectFinding(c.judged(a), Finding::Ok);
    a.freeUntil = static_cast<double>(c.when(0) + 1e-6L);
    expectFinding(c.judged(a), Finding::Late);
  });
}

TEST(OracleJudge, CatchesADipBetweenTwoFreePoses) {
  // A pendulum's lowest point lies between the poses; it dips below the floor by `depth` only
  // there.
  for (const double depth : {1e-2, 1e-5, 1e-8, 1e-11}) {
    SCOPED_TRACE(depth);
    FloorCase c;
    c.capsules[0] = {{Vec3d{0, -1, 0}, Vec3d{0, -1, 0}}, 0.05};
    c.joints[0].fromTranslation = c.joints[0].toTranslation = {0, 1.05 - depth, 0};
    c.joints[0].fromRotation = {std::cos(0.3), 0, 0, -std::sin(0.3)};
    c.joints[0].toRotation = {std::cos(0.31), 0, 0, std::sin(0.31)};
    expectFinding(c.judged(Answer{}), Finding::Missed);
    c.joints[0].fromTranslation.y = c.joints[0].toTranslation.y = 1.05 + depth;
    expectFinding(c.judged(Answer{}), Finding::Ok);
  }
}

TEST(OracleJudge, CatchesTunnelling) {
  // A millimetre sphere crosses a large triangle at 50 m a step: sampling would need luck.
  FloorCase c;
  c.capsules[0].radius = 5e-4;
  c.joints[0].fromTranslation = {1, 30, 2};
  c.joints[0].toTranslation = {1, -20, 2};
  expectFinding(c.judged(Answer{}), Finding::Missed);
}

TEST(OracleJudge, SeesAnAxisWithoutRadiusPierce) {
  FloorCase c;
  c.capsules[0] = {{Vec3d{0, -0.1, 0}, Vec3d{0, 0.1, 0}}, 0.0};
  c.joints[0].fromTranslation = {1, 1, 2};
  c.joints[0].toTranslation = {1, -1, 2};
  expectFinding(c.judged(Answer{}), Finding::Missed);
  c.joints[0].toTranslation = {1, 0.11, 2};
  expectFinding(c.judged(Answer{}), Finding::Ok);
}

TEST(OracleJudge, CatchesWitnessesThatDoNotBelong) {
  forEachCase(true, [](const FloorCase& c, Random& random) {
    const Answer right = c.contactAt(c.when(0.5L * kTolerance));
    Answer wrong = right;
    switch (random.below(7)) {
      case 0: wrong.separation += 1e-8; break;
      case 1: wrong.onScene.y += 1e-8; break;
      case 2: wrong.onLink.x += 1e-8; break;
      case 3: wrong.normal = {0, -1, 0}; break;
      case 4: wrong.triangle = 1; break;
      case 5: wrong.capsule = -1; break;
      default: wrong.freeUntil = 1.0; break;
    }
    expectFinding(c.judged(wrong), Finding::Inconsistent);
    wrong = right;
    wrong.toi = std::numeric_limits<double>::quiet_NaN();
    expectFinding(c.judged(wrong), Finding::Inconsistent);
  });
}

TEST(OracleJudge, BracketsTheFirstContact) {
  forEachCase(true, [](const FloorCase& c, Random&) {
    const Motion motion(c.joints);
    const auto first = Judge(c.floor, motion, 0, c.capsules).firstContact();
    ASSERT_TRUE(first.has_value());
    EXPECT_LE(first->low, c.when(0) + 1e-14L);
    EXPECT_GE(first->high, c.when(0) - 1e-14L);
    EXPECT_LE(first->high - first->low, 1e-9L);
  });
  forEachCase(false, [](const FloorCase& c, Random&) {
    const Motion motion(c.joints);
    EXPECT_FALSE(Judge(c.floor, motion, 0, c.capsules).firstContact().has_value());
  });
}

TEST(OracleJudge, MeasuresTheLeastSeparationOfMany) {
  for (int i = 0; i < 100; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    std::vector<Triangle> triangles;
    for (int k = 0; k < 200; ++k) {
      const auto pair = test::randomPair(random, 0.3, random.inBox(3.0));
      Triangle t;
      for (std::size_t j = 0; j < 3; ++j) t[j] = {pair.v[j].x(), pair.v[j].y(), pair.v[j].z()};
      triangles.push_back(t);
    }
    const Scene scene(triangles);
    const Motion motion({Joint{}});
    const Capsule capsule{{Vec3d{0, -0.2, 0}, Vec3d{0.1, 0.3, 0}}, 0.1};
    Real least = Box::kEmpty;
    for (const Triangle& t : triangles) {
      const auto closest =
          closestPoints<Real>(capsule.ends[0].as<Real>(), capsule.ends[1].as<Real>(),
                              {t[0].as<Real>(), t[1].as<Real>(), t[2].as<Real>()});
      least = std::min(least, closest.distance - static_cast<Real>(capsule.radius));
    }
    const Judge judge(scene, motion, 0, {capsule});
    EXPECT_NEAR(static_cast<double>(judge.separationAt(0) - least), 0.0, 1e-17) << "case " << i;
  }
}

/// Triangles all around, more than a first look takes at once, and an arm of three joints.
struct CrowdedCase {
  std::vector<Triangle> triangles;
  std::vector<Joint> joints;
  Capsule capsule;

  explicit CrowdedCase(Random& random) {
    for (int k = 0; k < 1000; ++k) {
      const auto pair = test::randomPair(random, random.magnitude(5e-3, 0.1), random.inBox(0.8));
      Triangle t;
      for (std::size_t j = 0; j < 3; ++j) t[j] = {pair.v[j].x(), pair.v[j].y(), pair.v[j].z()};
      triangles.push_back(t);
    }
    for (int j = 0; j < 3; ++j) {
      const auto from = random.rotation();
      const auto to = from * random.turn(random.uniform(0.0, 0.8));
      const Eigen::Vector3d offset = 0.3 * random.direction();
      Joint joint;
      joint.parent = j - 1;
      joint.fromRotation = {from.w(), from.x(), from.y(), from.z()};
      joint.toRotation = {to.w(), to.x(), to.y(), to.z()};
      joint.fromTranslation = joint.toTranslation = {offset.x(), offset.y(), offset.z()};
      joints.push_back(joint);
    }
    capsule = {{Vec3d{}, Vec3d{0.2, 0, 0}}, random.magnitude(1e-3, 3e-2)};
  }
  [[nodiscard]] Real separationByLoop(const Motion& motion, Real t) const {
    const auto ends = motion.pointsAt(2, capsule.ends, t, 0);
    Real least = Box::kEmpty;
    for (const Triangle& v : triangles) {
      least =
          std::min(least, closestPoints<Real>(ends[0].position, ends[1].position,
                                              {v[0].as<Real>(), v[1].as<Real>(), v[2].as<Real>()})
                              .distance);
    }
    return least - static_cast<Real>(capsule.radius);
  }
};

TEST(OracleJudge, FindsWhatALoopOverInstantsAndTrianglesFinds) {
  constexpr int kInstants = 40;
  int found = 0, atOnce = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    const CrowdedCase c(random);
    const Scene scene(c.triangles);
    const Motion motion(c.joints);
    const auto first = Judge(scene, motion, 2, {c.capsule}).firstContact();
    const Real low = first ? first->low : 2;
    for (int k = 0; k <= kInstants; ++k) {
      const Real t = static_cast<Real>(k) / kInstants;
      if (t >= low) break;
      EXPECT_GT(c.separationByLoop(motion, t), 0) << "at t " << k << "/" << kInstants;
    }
    if (!first) continue;
    EXPECT_LE(c.separationByLoop(motion, first->high), 0);
    EXPECT_LE(first->high - first->low, 1e-9L);
    atOnce += first->high == 0;
    ++found;
  }
  EXPECT_GT(found - atOnce, 10);
  EXPECT_LT(found, 55);
}

}  // namespace
}  // namespace foretouch::oracle
