#include "tessellation/swept_surface.h"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tessellation/lattice.h"
#include "tests/tessellation/surface_checks.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// A random chain over a few steps, the LSS on one of its links, and the oracle's view of the same.
struct SweepCase {
  std::vector<ChainMotion> motions;
  std::vector<SweptSpan> spans;
  LinkId link = 0;
  Lss lss;
  std::vector<TrueSweep::Part> parts;

  [[nodiscard]] TrueSweep truth() const { return TrueSweep(parts, link, lss); }
};

Pose movedPose(Random& random, const Pose& pose) {
  Pose moved = pose;
  for (std::size_t j = 0; j < moved.rotations.size(); ++j) {
    const double angle = random.chance(0.2) ? 0.0 : random.magnitude(1e-3, 1.0);
    moved.rotations[j] = moved.rotations[j] * random.turn(angle);
    if (j == 0 && random.chance(0.7)) moved.translations[j] += random.inBox(0.2);
  }
  return moved;
}

SweepCase sweepCase(std::uint64_t seed) {
  Random random(seed);
  SweepCase c;
  const int joints = 1 + random.below(5);
  RawSkeleton raw;
  for (int j = 0; j < joints; ++j) {
    raw.joints.push_back({"joint" + std::to_string(j), j - 1,
                          random.uniform(0, 0.4) * random.direction(), random.rotation()});
  }
  const Skeleton skeleton = Skeleton::build(raw).value();
  c.link = random.below(joints);
  c.lss = {random.inBox(0.2), random.inBox(0.2),
           random.chance(0.1) ? 0.0 : random.magnitude(2e-3, 0.1)};
  switch (random.below(6)) {
    case 0: c.lss.b = c.lss.a; break;           // a sphere
    case 1: c.lss.b = -c.lss.a; break;          // turns about its own middle
    case 2: c.lss.a = Vector3d::Zero(); break;  // one end at the joint
    default: break;
  }
  Pose from = restPose(skeleton);
  const int steps = 1 + random.below(3);
  const bool comesBack = random.chance(0.2);
  const Pose start = from;
  for (int n = 0; n < steps; ++n) {
    Pose to = random.chance(0.1) ? from : movedPose(random, from);
    if (comesBack && n + 1 == steps) to = start;
    const double beginT = n == 0 && random.chance(0.3) ? 0.4 : 0.0;
    const double endT = n + 1 == steps && random.chance(0.3) ? 0.7 : 1.0;
    c.motions.emplace_back(skeleton, from, to);
    c.spans.push_back({beginT, endT, n + beginT, n + endT});
    c.parts.push_back({oracle::Motion(plainJoints(skeleton, from, to)), beginT, endT});
    from = to;
  }
  return c;
}

Result<SweptSurface> surfaceOf(const SweepCase& c, const SweptSurfaceOptions& options) {
  auto builder = SweptSurfaceBuilder::create(c.lss, options);
  if (!builder.ok()) return builder.error();
  for (std::size_t n = 0; n < c.motions.size(); ++n) {
    const auto done = builder.value().add(c.motions[n], c.link, c.spans[n]);
    if (!done.ok()) return done.error();
  }
  return builder.value().finish();
}

/// A joint that turns by `turn` about z, and an LSS on it.
SweepCase turningCase(double turn, const Lss& lss, const SweptSpan& span) {
  RawSkeleton raw;
  raw.joints.push_back({"only", kNoParent, {0, 0, 0}, Quaternion::Identity()});
  const Skeleton skeleton = Skeleton::build(raw).value();
  Pose to = restPose(skeleton);
  to.rotations[0] = Eigen::AngleAxisd(turn, Vector3d::UnitZ());
  SweepCase c;
  c.lss = lss;
  c.motions.emplace_back(skeleton, restPose(skeleton), to);
  c.spans.push_back(span);
  return c;
}

double errorFor(std::uint64_t seed) {
  return Random(seed + 77).magnitude(5e-4, 2e-2);
}

std::uint64_t countFromEnvironment(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

class SweptSurfaceSides : public testing::TestWithParam<SurfaceSide> {};
INSTANTIATE_TEST_SUITE_P(Both, SweptSurfaceSides,
                         testing::Values(SurfaceSide::Outer, SurfaceSide::Inner),
                         [](const auto& name) {
                           return name.param == SurfaceSide::Outer ? "Outer" : "Inner";
                         });

TEST_P(SweptSurfaceSides, IsClosedOrientedAndOutward) {
  int built = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const SweepCase c = sweepCase(seed);
    SweptSurfaceOptions options;
    options.side = GetParam();
    options.error = errorFor(seed);
    const auto surface = surfaceOf(c, options);
    ASSERT_TRUE(surface.ok()) << describe(surface.error());
    if (surface.value().vanishes) continue;
    ++built;
    EXPECT_EQ(looseEdges(surface.value()), 0u);
    EXPECT_EQ(brokenRings(surface.value()), 0u);
    EXPECT_GT(volumeOf(surface.value()), 0.0);
    EXPECT_LE(surface.value().certifiedError, options.error);
    EXPECT_GT(surface.value().certifiedError, 0.2 * options.error);
  }
  EXPECT_GT(built, 150);
}

TEST(SweptSurface, OuterHoldsEveryPointOfTheTrueSweep) {
  const std::uint64_t perCase = countFromEnvironment("FORETOUCH_SWEEP_SAMPLES", 400'000) / 200;
  std::uint64_t inside = 0, outside = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const SweepCase c = sweepCase(seed);
    SweptSurfaceOptions options;
    options.error = errorFor(seed);
    const auto surface = surfaceOf(c, options);
    ASSERT_TRUE(surface.ok()) << describe(surface.error());
    const Winding winding(surface.value());
    const TrueSweep truth = c.truth();
    Random random(seed);
    for (std::uint64_t i = 0; i < perCase; ++i) {
      const Vector3d p = truth.sample(random);
      (winding.at(p) >= 1 ? inside : outside) += 1;
    }
  }
  EXPECT_EQ(outside, 0u) << "of " << inside + outside;
  EXPECT_GT(inside, 100'000u);
  RecordProperty("points", std::to_string(inside + outside));
}

// The union's boundary lies on faces of the surface, so the farthest enclosed point is on one.
TEST(SweptSurface, OuterIsAsCloseAsCertified) {
  double worst = 0.0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    const SweepCase c = sweepCase(seed);
    SweptSurfaceOptions options;
    options.error = errorFor(seed);
    const auto surface = surfaceOf(c, options);
    ASSERT_TRUE(surface.ok()) << describe(surface.error());
    const TrueSweep truth = c.truth();
    Random random(seed);
    const auto& s = surface.value();
    for (int i = 0; i < 60; ++i) {
      const auto& t =
          s.triangles[static_cast<std::size_t>(random.below(static_cast<int>(s.triangles.size())))];
      double u = random.uniform(0, 1), v = random.uniform(0, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      if (random.chance(0.5)) u = v = 0;
      const Vector3d p = s.vertices[t[0]] + u * (s.vertices[t[1]] - s.vertices[t[0]]) +
                         v * (s.vertices[t[2]] - s.vertices[t[0]]);
      const double distance = truth.distance(p);
      ASSERT_LE(distance, s.certifiedError);
      worst = std::max(worst, distance / s.certifiedError);
    }
  }
  EXPECT_GT(worst, 0.5);  // the certificate is no idle one
  RecordProperty("worstShare", std::to_string(worst));
}

TEST(SweptSurface, InnerIsInsideAndAsCloseAsCertified) {
  std::uint64_t inside = 0, covered = 0, samples = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const SweepCase c = sweepCase(seed);
    SweptSurfaceOptions options;
    options.side = SurfaceSide::Inner;
    options.error = errorFor(seed);
    const auto surface = surfaceOf(c, options);
    ASSERT_TRUE(surface.ok()) << describe(surface.error());
    const auto& s = surface.value();
    if (s.vanishes) {
      EXPECT_LT(c.lss.radius, 1.2 * options.error);
      continue;
    }
    const TrueSweep truth = c.truth();
    const Winding winding(s);
    Random random(seed);
    for (int i = 0; i < 60; ++i) {
      const auto& t =
          s.triangles[static_cast<std::size_t>(random.below(static_cast<int>(s.triangles.size())))];
      const Vector3d p = (s.vertices[t[0]] + s.vertices[t[1]] + s.vertices[t[2]]) / 3.0;
      ASSERT_EQ(truth.distance(i % 2 == 0 ? p : s.vertices[t[0]]), 0.0);
      ++inside;
    }
    // A point within the true sweep at the certified depth, and so a point of the inner solid: the
    // sweep of the LSS with its radius less the error.
    Lss core = c.lss;
    core.radius -= s.certifiedError;
    const TrueSweep deep(c.parts, c.link, core);
    for (int i = 0; i < 300; ++i) {
      covered += winding.at(deep.sample(random)) >= 1;
      ++samples;
    }
  }
  EXPECT_GT(inside, 3000u);
  EXPECT_EQ(covered, samples);
}

TEST(SweptSurface, WindsAroundNothingOutside) {
  std::uint64_t outside = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const SweepCase c = sweepCase(seed);
    SweptSurfaceOptions options;
    options.error = errorFor(seed);
    const auto surface = surfaceOf(c, options);
    ASSERT_TRUE(surface.ok());
    const Winding winding(surface.value());
    const TrueSweep truth = c.truth();
    Random random(seed);
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = truth.sample(random) + random.magnitude(1e-3, 0.3) * random.direction();
      const int turns = winding.at(p);
      ASSERT_GE(turns, 0);
      if (turns == 0) continue;
      ASSERT_LE(truth.distance(p), surface.value().certifiedError);
    }
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = truth.sample(random) + random.magnitude(1e-3, 0.3) * random.direction();
      if (truth.distance(p) <= surface.value().certifiedError) continue;
      ASSERT_EQ(winding.at(p), 0);
      ++outside;
    }
  }
  EXPECT_GT(outside, 500u);
}

TEST(SweptSurface, OfAnLssThatStandsStillIsTheLss) {
  RawSkeleton raw;
  raw.joints.push_back({"only", kNoParent, {1, 2, 3}, Quaternion::Identity()});
  const Skeleton skeleton = Skeleton::build(raw).value();
  const Pose pose = restPose(skeleton);
  SweepCase c;
  c.lss = {{0, 0, 0}, {0, 0.5, 0}, 0.1};
  c.motions.emplace_back(skeleton, pose, pose);
  c.spans.push_back({});
  const auto surface = surfaceOf(c, {});
  ASSERT_TRUE(surface.ok());
  EXPECT_EQ(looseEdges(surface.value()), 0u);
  EXPECT_GT(volumeOf(surface.value()), volume(c.lss));
  EXPECT_LT(volumeOf(surface.value()), 1.03 * volume(c.lss));
}

// A straight shift sweeps a prism and two halves of the LSS: a closed form.
TEST(SweptSurface, OfAStraightShiftHasTheVolumeOfThePrism) {
  RawSkeleton raw;
  raw.joints.push_back({"only", kNoParent, {0, 0, 0}, Quaternion::Identity()});
  const Skeleton skeleton = Skeleton::build(raw).value();
  const Pose from = restPose(skeleton);
  Pose to = from;
  to.translations[0] = {1, 0, 0};
  SweepCase c;
  c.lss = {{0, 0, 0}, {0, 0.5, 0}, 0.1};
  c.motions.emplace_back(skeleton, from, to);
  c.spans.push_back({});
  const double truth = volume(c.lss) + 1.0 * (0.5 * 0.2 + 3.14159265358979 * 0.01);
  for (const SurfaceSide side : {SurfaceSide::Outer, SurfaceSide::Inner}) {
    SweptSurfaceOptions options;
    options.side = side;
    options.error = 1e-4;
    const auto surface = surfaceOf(c, options);
    ASSERT_TRUE(surface.ok());
    const double ratio = volumeOf(surface.value()) / truth;
    const bool isOuter = side == SurfaceSide::Outer;
    EXPECT_GT(ratio, isOuter ? 1.0 : 0.997);
    EXPECT_LT(ratio, isOuter ? 1.003 : 1.0);
  }
}

// Of a ball that stands still on the lattice the surface is the polytope itself, and what its
// corners and facets are off is exact in fifty digits. The certificate adds what the budget leaves
// to chords, to the rounding of places and to the lattice (swept_surface.md 5).
TEST(SweptSurface, CertifiesNoLessThanABallsOwnPolytopeNeeds) {
  using Real = oracle::Precise;
  constexpr double kRadius = 1.0;
  const SweepCase c = turningCase(0.0, {{0, 0, 0}, {0, 0, 0}, kRadius}, {});
  for (const SurfaceSide side : {SurfaceSide::Outer, SurfaceSide::Inner}) {
    SweptSurfaceOptions options;
    options.side = side;
    const SweptSurface s = surfaceOf(c, options).value();
    Real off = 0;
    for (const auto& t : s.triangles) {
      const oracle::Precise3 a(s.vertices[t[0]]), b(s.vertices[t[1]]), d(s.vertices[t[2]]);
      const oracle::Precise3 normal = oracle::cross(b - a, d - a);
      off = std::max(off, side == SurfaceSide::Outer
                              ? oracle::norm(a) - Real(kRadius)
                              : Real(kRadius) - oracle::dot(normal, a) / oracle::norm(normal));
    }
    const Real needed =
        off + Real("0.105") * Real(options.error) + Real("0.8661") * Real(s.spacing);
    EXPECT_GE(Real(s.certifiedError), needed);
    EXPECT_LE(Real(s.certifiedError), needed + Real("1e-11"));
  }
}

TEST(SweptSurface, CoordinatesFitFloatsWhereAskedTo) {
  const SweepCase c = sweepCase(3);
  SweptSurfaceOptions options;
  options.bits = CoordinateBits::Single;
  const auto surface = surfaceOf(c, options);
  ASSERT_TRUE(surface.ok());
  for (const Vector3d& v : surface.value().vertices) {
    for (const double x : v) ASSERT_EQ(static_cast<double>(static_cast<float>(x)), x);
  }
}

TEST(SweptSurface, HasAsManyTrianglesAsItMayAndNoMore) {
  const SweepCase c = turningCase(0.0, {{0, 0, 0}, {0, 0.5, 0}, 0.1}, {});
  SweptSurfaceOptions options;
  options.maxTriangles = surfaceOf(c, options).value().triangles.size();
  EXPECT_TRUE(surfaceOf(c, options).ok());
  --options.maxTriangles;
  EXPECT_EQ(surfaceOf(c, options).error().code, ErrorCode::LimitExceeded);
}

// Farther out than a piece may be long, in spacings of the lattice.
TEST(SweptSurface, OfAShortPieceFarOutIsNotRefused) {
  SweptSurfaceOptions options;
  options.error = 1e-3;
  const Lss lss{{9e6, 0, 0}, {9e6, 0.5, 0}, 0.1};
  const SweptSurface surface = surfaceOf(turningCase(0.0, lss, {}), options).value();
  EXPECT_GT(9e6 / surface.spacing, static_cast<double>(kMaxLatticeDifference));
  EXPECT_EQ(looseEdges(surface), 0u);
}

TEST(SweptSurface, RefusesWhatItCannotCertify) {
  SweepCase c = sweepCase(5);
  SweptSurfaceOptions options;
  options.error = 1e-9;
  options.bits = CoordinateBits::Single;
  EXPECT_FALSE(surfaceOf(c, options).ok());
  options.bits = CoordinateBits::Double;
  options.error = 1e-4;
  options.maxTriangles = 100;
  const auto many = surfaceOf(c, options);
  ASSERT_FALSE(many.ok());
  EXPECT_EQ(many.error().code, ErrorCode::LimitExceeded);
  options.maxTriangles = 1'000'000;
  for (const double error : {0.0, -1.0, std::nan(""), 1e-13, 1e9}) {
    options.error = error;
    EXPECT_FALSE(surfaceOf(c, options).ok()) << error;
  }
  options.error = 1e-3;
  c.lss.radius = -1.0;
  EXPECT_FALSE(surfaceOf(c, options).ok());
}

TEST(SweptSurface, SaysWhatAnErrorIsTooSmallFor) {
  const auto refusal = [](const Lss& lss, double error, CoordinateBits bits) {
    SweptSurfaceOptions options;
    options.error = error;
    options.bits = bits;
    const auto built = surfaceOf(turningCase(0.0, lss, {}), options);
    return built.ok() ? std::string("accepted") : built.error().message;
  };
  const auto ball = [](double x, double radius) { return Lss{{x, 0, 0}, {x, 0, 0}, radius}; };
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text << "; expected " << part;
  };
  has(refusal(ball(0, 1e4), 1e-9, CoordinateBits::Double), "a radius this large");
  has(refusal(ball(9e5, 0.1), 1e-3, CoordinateBits::Single), "single-precision coordinates");
  has(refusal(ball(9e6, 1e-5), 1e-8, CoordinateBits::Double), "poses this far from the origin");
  EXPECT_EQ(refusal(ball(0, 0.1), 1e-3, CoordinateBits::Single), "accepted");
}

TEST(SweptSurface, TimesRunThroughTheSpans) {
  const SweepCase c = sweepCase(11);
  const auto surface = surfaceOf(c, {});
  ASSERT_TRUE(surface.ok());
  const auto& times = surface.value().timesS;
  ASSERT_EQ(times.size(), surface.value().vertices.size());
  const auto [least, most] = std::minmax_element(times.begin(), times.end());
  EXPECT_GE(*least, c.spans.front().beginS);
  EXPECT_LE(*most, c.spans.back().endS);
  EXPECT_LT(*least, *most);
}

TEST(SweptSurface, TimesOfASpanOfTheMotionAreThoseOfItsPlaces) {
  constexpr double kRadius = 0.01, kTurn = 1.2;
  const SweptSpan span{0.25, 0.75, 10.0, 12.0};
  const SweepCase c = turningCase(kTurn, {{1, 0, 0}, {1, 0, 0}, kRadius}, span);
  const SweptSurface surface = surfaceOf(c, {}).value();
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    const Vector3d& v = surface.vertices[i];
    const double t = 0.25 + 0.5 * (surface.timesS[i] - 10.0) / 2.0;
    // Within the ball at that time, and a piece of the path.
    EXPECT_NEAR(std::atan2(v.y(), v.x()), kTurn * t, 3.0 * kRadius + kTurn * 0.5 / 10.0);
  }
  // A chord of an arc of this length leaves it by a tenth of the error, and a hundredth for bounds.
  const double needed = 0.5 * kTurn / std::sqrt(8.0 * 0.1 * SweptSurfaceOptions().error);
  EXPECT_GE(static_cast<double>(surface.pieces), needed);
  EXPECT_LE(static_cast<double>(surface.pieces), 1.01 * needed + 1.0);
  const auto [least, most] = std::minmax_element(surface.timesS.begin(), surface.timesS.end());
  EXPECT_EQ(*least, 10.0);
  EXPECT_EQ(*most, 12.0);
}

// A stick that turns about its middle: its ends move apart, so a piece's hull is wider than its
// sheet by half of an end's way. As many pieces as these need, and not a power of two of them.
TEST(SweptSurface, CutsAStickThatTurnsIntoAsManyPiecesAsItsSheetNeeds) {
  constexpr double kHalf = 0.5, kTurn = 1.5, kSheetShare = 0.46;
  const SweepCase c = turningCase(kTurn, {{-kHalf, 0, 0}, {kHalf, 0, 0}, 0.1}, {});
  SweptSurfaceOptions options;
  options.error = kHalf / 21.5;
  const double needed = 0.5 * kHalf * kTurn / (kSheetShare * options.error);
  const SweptSurface surface = surfaceOf(c, options).value();
  EXPECT_GE(static_cast<double>(surface.pieces), 0.9 * needed);
  EXPECT_LE(static_cast<double>(surface.pieces), 1.3 * needed);
}

}  // namespace
}  // namespace foretouch::test
