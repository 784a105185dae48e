// Blended points in lanes against fifty digits, at every width: places, velocities and bounds of a
// skin's triangles, and the boxes and LSS that contain its clusters.
#include "middleware/lanes/blend_lanes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "lss/simd.h"
#include "middleware/pair/skin_lanes.h"
#include "middleware/surface/avatar_surface.h"
#include "tests/support/name_of_simd.h"
#include "tests/support/random_motion.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using test::Random;
using Real = oracle::Precise;

class BlendLanes : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

Avatar avatarOf(const Skeleton& skeleton) {
  std::vector<std::vector<Lss>> lss(countOf(skeleton.numJoints()));
  for (auto& ofLink : lss) ofLink.push_back({Vector3d::Zero(), Vector3d(0.1, 0, 0), 0.01});
  return Avatar::build(skeleton, std::move(lss)).value();
}

/// Vertices with one to six shares, some of one link, bound where the skeleton rests or anywhere;
/// weights that add up to 1 as nearly as a skin's must. The last link has no triangle.
struct MovingSkin {
  test::RandomMotion chain;
  Avatar avatar;
  ChainMotion motion;
  SkinnedSurface surface;
  ChainNodes nodes;
  double begin = 0.0, end = 1.0;

  explicit MovingSkin(Random& random)
      : chain(test::randomMotion(random, 2 + random.below(5))),
        avatar(avatarOf(chain.skeleton)),
        motion(chain.skeleton, chain.from, chain.to),
        surface(surfaceOf(avatar, random)) {
    const int slabs = 1 << random.below(4), slab = random.below(slabs);
    begin = static_cast<double>(slab) / slabs;
    end = static_cast<double>(slab + 1) / slabs;
    nodes.evaluate(motion, begin, end, motion.stateAt(0, 0.5).p_WL + random.inBox(2.0));
  }

  static SkinnedSurface surfaceOf(const Avatar& avatar, Random& random) {
    const Pose rest = restPose(avatar.skeleton());
    std::vector<LinkState> states;
    ChainMotion(avatar.skeleton(), rest, rest).statesAt(0.0, states);
    Skin skin;
    std::vector<std::size_t> counts;
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      const int count = link + 1 < avatar.numLinks() ? 1 + random.below(90) : 0;
      counts.push_back(countOf(count));
      for (int i = 0; i < count; ++i) addTriangle(random, link, states, skin);
    }
    return SkinnedSurface::build(avatar, std::move(skin), counts).value();
  }
  static void addTriangle(Random& random, LinkId link, const std::vector<LinkState>& states,
                          Skin& skin) {
    const Vector3d middle =
        states[slotOf(link)].p_WL + random.uniform(0.0, 0.4) * random.direction();
    std::array<std::int32_t, 3> ids{};
    for (std::int32_t& id : ids) {
      id = static_cast<std::int32_t>(skin.vertices.size());
      skin.vertices.push_back(vertexAt(random, link, states, middle + random.inBox(0.05)));
    }
    skin.triangles.push_back(ids);
  }
  static std::vector<SkinInfluence> vertexAt(Random& random, LinkId link,
                                             const std::vector<LinkState>& states,
                                             const Vector3d& place) {
    std::vector<SkinInfluence> shares{{link, 1.0, Vector3d::Zero()}};
    for (int more = random.below(6); more > 0; --more) {
      shares.push_back({random.below(static_cast<int>(states.size())), random.magnitude(1e-3, 2.0),
                        Vector3d::Zero()});
    }
    double sum = 0.0;
    for (const SkinInfluence& share : shares) sum += share.weight;
    const double off = 1.0 + random.uniform(-9e-10, 9e-10);
    const bool isBoundAtRest = random.chance(0.8);
    for (SkinInfluence& share : shares) {
      const LinkState& state = states[slotOf(share.link)];
      share.weight *= off / sum;
      share.p_L = state.R_WL.transpose() * (place - state.p_WL);
      if (!isBoundAtRest) share.p_L += random.inBox(0.2);
    }
    return shares;
  }

  [[nodiscard]] const SkinParts& parts() const { return surface.parts(); }
  [[nodiscard]] Real timeOf(float u) const {
    return Real(begin) + (Real(u) + 1) * (Real(end) - Real(begin)) / 2;
  }
  [[nodiscard]] std::vector<oracle::PreciseFrame> framesAt(float u) const {
    return oracle::preciseFrames(chain.precise, timeOf(u));
  }
  /// The true place of a vertex.
  [[nodiscard]] Precise3 placeOf(std::int32_t vertex,
                                 const std::vector<oracle::PreciseFrame>& frames) const {
    Precise3 place;
    for (const SkinInfluence& share : parts().skin.vertices[slotOf(vertex)]) {
      place = place + Real(share.weight) * frames[slotOf(share.link)].at(share.p_L);
    }
    return place;
  }
};

/// The curve's own derivatives in fifty digits.
Precise3 derivativeOf(const BlendTriangle& curve, int corner, float u, int order) {
  Precise3 sum;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Real power = 1;
    for (int k = order; k < kCoefficients; ++k, power *= Real(u)) {
      const auto column = static_cast<std::size_t>(3 * corner) + axis;
      sum[axis] += Real(order == 1 ? k : k * (k - 1)) * Real(curve.c[k][column]) * power;
    }
  }
  return sum;
}

bool isIn(const CurveBox& box, const Precise3& place) {
  bool isInside = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    isInside =
        isInside && place[axis] >= Real(box.lower[axis]) && place[axis] <= Real(box.upper[axis]);
  }
  return isInside;
}

struct Used {
  double place = 0.0, velocity = 0.0, acceleration = 0.0;
};

/// Every curve of a link at one instant each.
void checkCurves(const MovingSkin& moving, LinkId link, SkinLanes& lanes, Random& random,
                 Used& used) {
  const FramePolynomials& frame = lanes.beginLink(link);
  const Precise3 origin = Precise3(moving.nodes.origin()) +
                          Precise3(Vector3d(frame.origin[0], frame.origin[1], frame.origin[2]));
  for (std::int32_t i = 0; i < moving.parts().numTriangles(link); ++i) {
    const std::int32_t which = lanes.curve(HierarchyChild::triangle(i));
    ASSERT_EQ(lanes.curve(HierarchyChild::triangle(i)), which) << "made once";
    TrianglePairBlock pairs{};
    PairFloats u{};
    u[0] = test::randomInstant(random);
    placeBlends(lanes.curves(), &which, u, 1, pairs);
    const auto frames = moving.framesAt(u[0]), atStart = moving.framesAt(-1.0F);
    const auto pointOf = [](const PairFloats(&p)[3]) {
      return Precise3(Real(p[0][0]), Real(p[1][0]), Real(p[2][0]));
    };
    for (int corner = 0; corner < 3; ++corner) {
      const std::int32_t vertex =
          moving.parts().triangle(link, i)[static_cast<std::size_t>(corner)];
      const Real off = norm(moving.placeOf(vertex, frames) - origin - pointOf(pairs.link[corner]));
      ASSERT_LE(off, Real(lanes.hull(which).pad));
      used.place = std::max(used.place, static_cast<double>(off / Real(lanes.hull(which).pad)));
      ASSERT_TRUE(isIn(lanes.hull(which).swept, moving.placeOf(vertex, frames) - origin));
      ASSERT_TRUE(isIn(lanes.hull(which).start, moving.placeOf(vertex, atStart) - origin));
      const BlendTriangle& curve = lanes.curves()[which];
      const Real slip =
          norm(derivativeOf(curve, corner, u[0], 1) - pointOf(pairs.velocity[corner]));
      ASSERT_LE(slip, Real(pairs.velocityPad[0]));
      used.velocity =
          std::max(used.velocity, static_cast<double>(slip / Real(pairs.velocityPad[0])));
      const Real bend = norm(derivativeOf(curve, corner, u[0], 2));
      ASSERT_LE(bend, Real(pairs.acceleration[corner][0]));
      used.acceleration = std::max(used.acceleration,
                                   static_cast<double>(bend / Real(pairs.acceleration[corner][0])));
    }
  }
}

TEST_P(BlendLanes, PlaceTrianglesWithinTheirPads) {
  Used used;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const MovingSkin moving(random);
    SkinLanes lanes;
    lanes.beginSpan(moving.parts(), *moving.parts().blends, moving.motion, moving.nodes);
    for (LinkId link = 0; link + 1 < moving.motion.numLinks(); ++link) {
      checkCurves(moving, link, lanes, random, used);
    }
  }
  EXPECT_GT(used.place, 0.02) << "a pad that is never needed is not the bound it says";
  EXPECT_GT(used.velocity, 0.01);
  EXPECT_GT(used.acceleration, 0.2);
}

/// By Horner's rule in float, as lanes do without fused operations.
float horner(const float (&c)[kCoefficients], float u) {
  float sum = c[kCoefficients - 1];
  for (int k = kCoefficients - 2; k >= 0; --k) {
    const volatile float product = sum * u;
    sum = product + c[k];
  }
  return sum;
}

bool isIn(const SweptBoxes& boxes, std::int32_t box, const Precise3& place) {
  bool isInside = true;
  for (int axis = 0; axis < 3; ++axis) {
    const Real x = place[static_cast<std::size_t>(axis)];
    isInside = isInside && x >= Real(boxes.lower[axis][box]) && x <= Real(boxes.upper[axis][box]);
  }
  return isInside;
}

/// How much of a cluster's radius its vertices need at an instant: more than 1 is a gap.
double shareOfRadius(const MovingSkin& moving, const LssPolynomials& lss, float u,
                     const Precise3& place) {
  Precise3 centre = Precise3(moving.nodes.origin());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    centre[axis] += Real(lss.origin[axis]) + Real(horner(lss.a[axis], u));
  }
  return static_cast<double>(norm(place - centre) / Real(lss.radius));
}

/// The true places of the vertices of some of a table's triangles.
std::vector<Precise3> placesOf(const MovingSkin& moving, LinkId link, PartRange triangles,
                               const std::vector<oracle::PreciseFrame>& frames) {
  std::vector<Precise3> places;
  for (std::int32_t i = triangles.first; i < triangles.last; ++i) {
    const std::int32_t triangle = moving.parts().blends->triangle(i);
    for (const std::int32_t vertex : moving.parts().triangle(link, triangle)) {
      places.push_back(moving.placeOf(vertex, frames));
    }
  }
  return places;
}

/// The same of a part's, whose axis is a curve.
double shareOfPart(const MovingSkin& moving, const FramePolynomials& frame, SkinLanes& lanes,
                   std::int32_t part, float u, const Precise3& place) {
  const std::int32_t which = lanes.curve(HierarchyChild::node(part));
  TrianglePairBlock pairs{};
  PairFloats instant{};
  instant[0] = u;
  placeBlends(lanes.curves(), &which, instant, 1, pairs);
  Precise3 centre = Precise3(moving.nodes.origin());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(pairs.link[0][axis][0], pairs.link[1][axis][0]) << "a segment of no length";
    centre[axis] += Real(frame.origin[axis]) + Real(pairs.link[0][axis][0]);
  }
  const BlendHull& hull = lanes.hull(which);
  const Vector3d from(frame.origin[0], frame.origin[1], frame.origin[2]);
  const Precise3 relative = place - Precise3(moving.nodes.origin()) - Precise3(from);
  EXPECT_TRUE(isIn(hull.swept, relative));
  EXPECT_TRUE(u > -1.0F || isIn(hull.start, relative));
  return static_cast<double>(norm(place - centre) / (Real(hull.radius) + Real(hull.pad)));
}

/// How fast an end of a cluster's axis moves, per u.
double speedOf(const float (&rows)[3][kCoefficients], float u) {
  Vector3d velocity = Vector3d::Zero();
  double power = 1.0;
  for (int k = 1; k < kCoefficients; ++k, power *= double{u}) {
    for (int axis = 0; axis < 3; ++axis) velocity[axis] += k * power * double{rows[axis][k]};
  }
  return velocity.norm();
}

struct Shares {
  double cluster = 0.0, part = 0.0;
};

void checkLink(const MovingSkin& moving, LinkId link, SkinLanes& lanes, const SweptBoxes& boxes,
               float u, Shares& used) {
  const BlendTable& table = *moving.parts().blends;
  const SweptBoxes& whole = lanes.linkBoxes(0.0);
  const FramePolynomials& frame = lanes.beginLink(link);
  const auto frames = moving.framesAt(u);
  std::size_t seen = 0;
  for (std::int32_t lss = table.table().first(link); lss < table.table().first(link + 1); ++lss) {
    const LssPolynomials polynomials = lanes.polynomials(lss);
    ASSERT_LE(speedOf(polynomials.a, u), polynomials.speedA);
    ASSERT_LE(speedOf(polynomials.b, u), polynomials.speedB);
    const PartRange parts = lanes.partsOf(lss - table.table().first(link));
    for (std::int32_t part = parts.first; part < parts.last; ++part) {
      const PartRange triangles = lanes.trianglesOf(HierarchyChild::node(part));
      for (const Precise3& place : placesOf(moving, link, triangles, frames)) {
        const Precise3 relative = place - Precise3(moving.nodes.origin());
        ASSERT_TRUE(isIn(boxes, lss, relative));
        ASSERT_TRUE(isIn(whole, link, relative));
        const double share = shareOfRadius(moving, polynomials, u, place);
        const double ofPart = shareOfPart(moving, frame, lanes, part, u, place);
        ASSERT_LE(share, 1.0);
        ASSERT_LE(ofPart, 1.0);
        used.cluster = std::max(used.cluster, share);
        used.part = std::max(used.part, ofPart);
        ++seen;
      }
    }
  }
  ASSERT_EQ(seen, 3 * countOf(moving.parts().numTriangles(link)));
}

TEST_P(BlendLanes, ContainTheTrianglesOfClustersAndPartsAtEveryInstant) {
  Shares used;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(500 + seed);
    const MovingSkin moving(random);
    const BlendTable& table = *moving.parts().blends;
    SkinLanes lanes;
    lanes.beginSpan(moving.parts(), table, moving.motion, moving.nodes);
    SweptBoxes boxes;
    boxes.resize(table.size());
    for (std::int32_t lss = 0; lss < table.size(); ++lss) lanes.addBox(lss, 0.0, boxes);
    const float u = test::randomInstant(random);
    for (LinkId link = 0; link + 1 < moving.motion.numLinks(); ++link) {
      checkLink(moving, link, lanes, boxes, u, used);
    }
  }
  EXPECT_GT(used.cluster, 0.9);
  EXPECT_GT(used.part, 0.9);
}

// Merged one after the other, a thousand shares of one place leave it by hundreds of roundings.
TEST(BlendTable, HoldsVerticesOfAThousandShares) {
  Random random(1);
  const Avatar avatar = avatarOf(test::randomMotion(random, 2).skeleton);
  const Vector3d p(1.3, 1.7, 1.1);
  std::vector<SkinInfluence> shares(1, {0, 0.5, p});
  shares.resize(1001, {0, 0.5 / 1000.0, p});
  Skin skin{std::vector<std::vector<SkinInfluence>>(3, shares), {{0, 1, 2}}};
  std::vector<std::size_t> counts(countOf(avatar.numLinks()));
  counts[0] = 1;
  const auto surface = SkinnedSurface::build(avatar, std::move(skin), counts);
  ASSERT_TRUE(surface.ok());
  const BlendTable& table = *surface.value().parts().blends;
  const BlendShare& made = *table.shares(table[table.table().first(0)]);
  const double off = (Vector3d(made.a[0], made.a[1], made.a[2]) - p).norm();
  EXPECT_GT(off, 256.0 * kUnitRoundoff * p.norm());
  EXPECT_LE(off, table[table.table().first(0)].radius);
}

// The last link has no triangle, so its own LSS is asked: a blend of one share.
TEST_P(BlendLanes, ContainTheLssOfALinkWithoutTriangles) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(900 + seed);
    const MovingSkin moving(random);
    const BlendTable& table = *moving.parts().blends;
    const LinkId link = moving.motion.numLinks() - 1;
    const std::int32_t own = table.table().first(link);
    ASSERT_EQ(table.size() - own, 1);
    ASSERT_EQ(table.table()[own].radius, moving.avatar.lss(link)[0].radius);
    SkinLanes lanes;
    lanes.beginSpan(moving.parts(), table, moving.motion, moving.nodes);
    SweptBoxes boxes;
    boxes.resize(table.size());
    lanes.addBox(own, 0.0, boxes);
    const LssPolynomials polynomials = lanes.polynomials(own);
    const float u = test::randomInstant(random);
    const auto frames = moving.framesAt(u);
    const Precise3 from = Precise3(moving.nodes.origin());
    const Precise3 end = frames[slotOf(link)].at(moving.avatar.lss(link)[0].b) - from;
    EXPECT_TRUE(isIn(boxes, own, end));
    Precise3 centre;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      centre[axis] = Real(polynomials.origin[axis]) + Real(horner(polynomials.b[axis], u));
    }
    EXPECT_LE(norm(end - centre) + Real(moving.avatar.lss(link)[0].radius),
              Real(polynomials.radius));
  }
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, BlendLanes, testing::ValuesIn(supportedSimd()),
                         test::nameOfSimd);

}  // namespace
}  // namespace foretouch::internal
