// The ellipsoid rung against an oracle of its own, in long double: in the space where the spheroid
// is the unit ball, its centre moves straight, and the distance of a point on a straight way from a
// triangle is a convex function of time: its least value and its first root are found by halving.
#include "tests/reference/spheroid_query.h"

#include <array>
#include <optional>

#include <gtest/gtest.h>

#include "judge/distance.h"
#include "middleware/scene/scene_parts.h"
#include "tests/middleware/random_scene.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::SpheroidQuery;
using oracle::Vec3r;
using test::Random;

/// In long double, by the oracle's closest points.
class Truth {
 public:
  explicit Truth(const Spheroid& spheroid) : spheroid_(spheroid) {}

  /// Distance of the centre from the triangle in units of the spheroid; below 1: they touch.
  [[nodiscard]] oracle::Real at(oracle::Real t, const Triangle& triangle) const {
    const Vec3r center = t * toUnit(wide(spheroid_.drift));
    std::array<Vec3r, 3> v;
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] = toUnit(wide(triangle.vertices[i]) - wide(spheroid_.start)) - center;
    }
    return oracle::closestPoints(Vec3r{}, Vec3r{}, v).distance;
  }

  /// The first instant of contact; nothing if there is none.
  [[nodiscard]] std::optional<oracle::Real> firstContact(const Triangle& triangle) const {
    if (at(0, triangle) < 1) return 0;
    oracle::Real low = 0, high = 1;
    for (int i = 0; i < 100; ++i) {
      const oracle::Real third = (high - low) / 3;
      if (at(low + third, triangle) <= at(high - third, triangle)) {
        high -= third;
      } else {
        low += third;
      }
    }
    oracle::Real touching = at(1, triangle) < at(low, triangle) ? 1 : low;
    if (at(touching, triangle) >= 1) return std::nullopt;
    oracle::Real free = 0;
    for (int i = 0; i < 64; ++i) {
      const oracle::Real middle = (free + touching) / 2;
      (at(middle, triangle) < 1 ? touching : free) = middle;
    }
    return touching;
  }

 private:
  static Vec3r wide(const Vector3d& v) {
    return oracle::Vec3d{v.x(), v.y(), v.z()}.as<oracle::Real>();
  }
  [[nodiscard]] Vec3r toUnit(const Vec3r& x) const {
    const Vec3r axis = wide(spheroid_.axis);
    const oracle::Real along = spheroid_.along, across = spheroid_.across;
    return (1 / across) * x + ((1 / along - 1 / across) * dot(axis, x)) * axis;
  }

  const Spheroid& spheroid_;
};

Spheroid randomSpheroid(Random& random, const Vector3d& center) {
  Spheroid spheroid;
  spheroid.start = center + random.inBox(1.5);
  spheroid.drift = random.chance(0.1) ? Vector3d(Vector3d::Zero())
                                      : Vector3d(random.magnitude(1e-3, 2.0) * random.direction());
  spheroid.axis = random.direction();
  spheroid.along = random.magnitude(0.02, 1.0);
  spheroid.across = random.magnitude(0.02, 1.0);
  return spheroid;
}

/// Triangles about the spheroid's way.
Scene sceneAround(Random& random, const Spheroid& spheroid, int count) {
  RawScene raw;
  raw.objectNames = {"one"};
  for (int i = 0; i < count; ++i) {
    const double size = random.magnitude(1e-2, 1.0);
    const Vector3d middle = spheroid.centerAt(random.uniform(0.0, 1.2)) +
                            random.uniform(0.0, 1.6) * spheroid.longest() * random.direction();
    Triangle t;
    for (Vector3d& v : t.vertices) v = middle + random.inBox(size);
    if (random.chance(0.1)) t.vertices[2] = t.vertices[1];
    raw.triangles.push_back(t);
    raw.objectOf.push_back(0);
  }
  return Scene::build(std::move(raw)).value();
}

struct Tally {
  int clear = 0, contact = 0, start = 0;
};

void judge(const Spheroid& spheroid, const Scene& scene, double tolerance, const LinkContact& got,
           Tally& tally) {
  const Truth truth(spheroid);
  oracle::Real first = 2;
  for (TriangleId id = 0; id < static_cast<TriangleId>(scene.numTriangles()); ++id) {
    first = std::min(first, truth.firstContact(scene.triangle(id)).value_or(2));
  }
  constexpr double kRounding = 1e-9;
  const oracle::Real scale = spheroid.longest();
  switch (got.verdict) {
    case Verdict::Clear:
      EXPECT_GT(first, 1) << "missed";
      ++tally.clear;
      return;
    case Verdict::Contact: {
      EXPECT_LE(static_cast<oracle::Real>(got.toi), first) << "late";
      // In the unit ball's space nothing is farther than by the shortest semi-axis in the world's.
      const oracle::Real gap =
          truth.at(static_cast<oracle::Real>(got.toi), scene.triangle(got.triangle)) - 1;
      EXPECT_LE(gap * scale, tolerance * (1 + 1e-6)) << "early";
      ++tally.contact;
      break;
    }
    case Verdict::StartsInContact:
      EXPECT_LE((truth.at(0, scene.triangle(got.triangle)) - 1) * scale, 1e-9);
      EXPECT_EQ(got.toi, 0.0);
      ++tally.start;
      break;
    case Verdict::Undecided: ADD_FAILURE() << "undecided: " << toString(got.reason); return;
  }
  EXPECT_NEAR(got.nhat_SL_W.norm(), 1.0, 1e-12);
  EXPECT_LE(got.separation, tolerance);
  const Vector3d center = spheroid.centerAt(got.toi);
  EXPECT_NEAR(spheroid.toUnit(got.p_WLink - center).norm(), 1.0, kRounding);
  if (got.verdict == Verdict::Contact) {
    EXPECT_NEAR((got.p_WLink - got.p_WScene).norm(), got.separation, kRounding);
  }
}

LinkContact answer(const Spheroid& spheroid, const Scene& scene, double tolerance) {
  std::vector<TriangleId> found;
  QueryCounters counters;
  const internal::IgnoredObjects none;
  const internal::WorkMeter unlimited{QueryOptions{}};
  const SpheroidQuery query{spheroid, scene, scene.parts().bvh, tolerance, unlimited, none};
  return internal::firstContactOf(query, found, counters);
}

TEST(SpheroidContacts, AreSoundAndTight) {
  Tally tally;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d center =
        i % 5 == 0 ? Vector3d(1e4 * random.direction()) : Vector3d(random.inBox(2));
    const Spheroid spheroid = randomSpheroid(random, center);
    const Scene scene = sceneAround(random, spheroid, 1 + random.below(4));
    const double tolerance = std::array<double, 4>{1e-2, 1e-3, 1e-5, 1e-7}[i % 4];
    judge(spheroid, scene, tolerance, answer(spheroid, scene, tolerance), tally);
    if (HasFailure()) return;
  }
  EXPECT_GT(tally.clear, 200);
  EXPECT_GT(tally.contact, 200);
  EXPECT_GT(tally.start, 200);
}

/// Falls onto a face, an edge and a vertex whose instants are known.
TEST(SpheroidContacts, OfPlaneEdgeAndVertexAreAtTheirClosedForms) {
  Spheroid spheroid;
  spheroid.start = Vector3d(0, 3, 0);
  spheroid.drift = Vector3d(0, -4, 0);
  spheroid.along = 1.0;  // upright
  spheroid.across = 0.25;
  const auto impactWith = [&](const Triangle& triangle) {
    const Scene scene = Scene::build({{triangle}, {0}, {"one"}}).value();
    const LinkContact got = answer(spheroid, scene, 1e-7);
    EXPECT_EQ(got.verdict, Verdict::Contact);
    return got.toi;
  };
  const double x = 0.15;  // beside the axis: the surface is lower by sqrt(1 - (x/across)^2)
  const double below = std::sqrt(1.0 - x * x / (0.25 * 0.25));
  EXPECT_NEAR(impactWith({{Vector3d(-9, 0, -9), Vector3d(9, 0, -9), Vector3d(0, 0, 9)}}), 0.5,
              1e-7);
  EXPECT_NEAR(impactWith({{Vector3d(x, 0, -9), Vector3d(x, 0, 9), Vector3d(x, -5, 0)}}),
              (3.0 - below) / 4.0, 1e-7);
  EXPECT_NEAR(impactWith({{Vector3d(x, 0, 0), Vector3d(x, -5, 1), Vector3d(x, -5, -1)}}),
              (3.0 - below) / 4.0, 1e-7);
}

TEST(SpheroidContacts, AtTheStartAreWithWhatIsNearestToTheCentre) {
  Random random(11);
  for (int i = 0; i < 20; ++i) {
    const Scene scene = Scene::build(test::clutter(random, 400, 2, Vector3d::Zero())).value();
    Spheroid spheroid = randomSpheroid(random, Vector3d::Zero());
    spheroid.start = random.inBox(0.5);
    spheroid.along = 1.5;
    spheroid.across = 0.8;
    const LinkContact got = answer(spheroid, scene, 1e-3);
    ASSERT_EQ(got.verdict, Verdict::StartsInContact);
    const Truth truth(spheroid);
    const double reported = static_cast<double>(truth.at(0, scene.triangle(got.triangle)));
    for (TriangleId id = 0; id < static_cast<TriangleId>(scene.numTriangles()); ++id) {
      EXPECT_LE(reported, static_cast<double>(truth.at(0, scene.triangle(id))) + 1e-12);
    }
    EXPECT_NEAR(got.penetration, (1.0 - reported) * 0.8, 1e-9);
  }
}

}  // namespace
}  // namespace foretouch
