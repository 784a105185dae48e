// A reduced answer, byte for byte, against the reduction of every place of every triangle: no tree,
// no lanes, no order.
#include "middleware/near/near_reduction.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/simd.h"
#include "middleware/near/near_blocks.h"
#include "middleware/near/near_features.h"
#include "middleware/scene/scene_parts.h"
#include "tessellation/swept_lss.h"
#include "tests/middleware/random_scene.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::StandingLss;
using test::Random;

StandingLss standing(const Avatar& avatar, LinkId link, std::int32_t i, const LinkState& state,
                     double reach) {
  const Lss& lss = avatar.lss(link)[slotOf(i)];
  const AxisEnds ends = axisEnds(lss, state);
  const double extent = state.p_WL.lpNorm<1>() + lss.a.lpNorm<1>() + lss.b.lpNorm<1>();
  return {link, i, ends.a, ends.b, lss.radius, reach, MotionBounds::kPointRounding * extent};
}

/// What is left of all places, in the order of an answer; `all`: how many there are.
std::vector<NearFeature> expected(const Avatar& avatar, const Scene& scene,
                                  const std::vector<LinkState>& states, double reach,
                                  std::uint64_t& all) {
  std::vector<NearFeature> features;
  internal::NearReduction reduction;
  internal::NearPlaces places;
  const internal::FlatEdges& flat = scene.parts().flatEdges();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const LinkState& state = states[slotOf(link)];
    for (std::size_t i = 0; i < avatar.lss(link).size(); ++i) {
      const StandingLss lss = standing(avatar, link, static_cast<std::int32_t>(i), state, reach);
      reduction.begin(scene, lss, state.R_WL);
      for (auto id = static_cast<TriangleId>(scene.numTriangles()); id-- > 0;) {
        internal::findPlaces(lss, scene.triangle(id), id, flat, nullptr, places);
        for (int p = 0; p < places.count; ++p) reduction.offer(places.place[p]);
        all += static_cast<std::uint64_t>(places.count);
      }
      std::vector<internal::NearPlace> left;
      reduction.finish(left);
      for (internal::NearPlace& place : left) {
        place.feature.gap = internal::provenGap(lss, scene.triangle(place.feature.triangle), place);
        features.push_back(place.feature);
      }
    }
  }
  const auto key = [](const NearFeature& f) {
    return std::make_tuple(f.link, f.lss, f.gap, f.triangle, f.along);
  };
  std::sort(features.begin(), features.end(),
            [&](const NearFeature& x, const NearFeature& y) { return key(x) < key(y); });
  return features;
}

bool isSame(const NearFeature& x, const NearFeature& y) {
  const auto bytes = [](const auto& a, const auto& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
  };
  return x.link == y.link && x.lss == y.lss && x.triangle == y.triangle && x.feature == y.feature &&
         bytes(x.along, y.along) && bytes(x.gap, y.gap) && bytes(x.p_WScene, y.p_WScene) &&
         bytes(x.p_WLink, y.p_WLink) && bytes(x.nhat_SL_W, y.nhat_SL_W);
}

/// Places; what doubles looked at; features that are left.
struct Tally {
  std::uint64_t all = 0, inDoubles = 0, left = 0;
};

void compare(const Avatar& avatar, const Scene& scene, const std::vector<LinkState>& states,
             double reach, Tally& tally) {
  const NearQuery query = NearQuery::build(avatar, scene).value();
  Scratch scratch;
  NearFeatures near;
  query.answer(states, std::vector<double>(states.size(), reach), scratch, near);
  const std::vector<NearFeature> truth = expected(avatar, scene, states, reach, tally.all);
  tally.inDoubles += near.counters.advancements;
  tally.left += truth.size();
  ASSERT_EQ(near.features.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    ASSERT_TRUE(isSame(near.features[i], truth[i])) << "feature " << i;
  }
}

class NearReductionTest : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

TEST_P(NearReductionTest, OfClutterIsThatOfAllPlaces) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Vector3d center = random.chance(0.2) ? Vector3d(random.inBox(1e5)) : Vector3d::Zero();
    const Scene scene = Scene::build(test::clutter(random, 600, 1, center)).value();
    const test::RandomBody body = test::bodyInClutter(random, 6, center);
    std::vector<LinkState> states;
    body.motion().statesAt(1.0, states);
    compare(body.avatar, scene, states, random.magnitude(0.05, 1.0), tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.left, 3000U);
  EXPECT_LT(tally.inDoubles, tally.all);
}

/// The triangle in every place of a block.
internal::PlaceBlock blockOf(const Triangle& triangle) {
  internal::PlaceBlock block{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      auto& row = block.vertex[corner][axis];
      std::fill(std::begin(row), std::end(row), triangle.vertices[corner][axis]);
    }
  }
  return block;
}

/// An axis that passes by a vertex, an edge or the inside of the triangle at a small distance.
StandingLss passing(Random& random, const Triangle& triangle) {
  double u = random.uniform(0.0, 1.0), v = random.chance(0.4) ? 0.0 : random.uniform(0.0, 1.0 - u);
  if (random.chance(0.3)) u = v = 0.0;
  const auto& p = triangle.vertices;
  const Vector3d near = p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]);
  const Vector3d at = near + random.magnitude(1e-7, 0.1) * random.direction();
  const Vector3d half = 0.2 * random.direction();
  const double share = random.chance(0.3) ? 0.0 : random.uniform(0.0, 2.0);
  return {0, 0, at - share * half, at + (2.0 - share) * half, 0.05, 0.2, 0.0};
}

unsigned anyOf(const internal::PlaceChoice& choice) {
  unsigned any = choice.unsure;
  for (const unsigned may : choice.may) any |= may;
  return any;
}

TEST_P(NearReductionTest, LanesHaveTheDistanceOfDoublesToTheLastBits) {
  constexpr double kBits = 40.0 * kUnitRoundoff;
  int compared = 0, unsure = 0;
  for (int draw = 0; draw < 4000; ++draw) {
    SCOPED_TRACE(draw);
    Random random(static_cast<std::uint64_t>(draw));
    const Scene scene = Scene::build(test::clutter(random, 1, 1, Vector3d::Zero())).value();
    const Triangle& triangle = scene.triangle(0);
    const StandingLss lss = passing(random, triangle);
    const internal::PlacedLss placed = internal::placedLss(lss);
    const internal::PlaceBlock block = blockOf(triangle);
    internal::NearPlaces places;
    internal::findPlaces(lss, triangle, 0, scene.parts().flatEdges(), nullptr, places);
    for (int i = 0; i < places.count; ++i) {
      internal::NearReduction reduction;
      reduction.begin(scene, lss, Eigen::Matrix3d::Identity());
      internal::NearBins bins = reduction.bins();
      reduction.offer(places.place[i]);
      const auto* const held =
          std::find_if(std::begin(reduction.bins().limit), std::end(reduction.bins().limit),
                       [](double limit) { return std::isfinite(limit); });
      const auto bin = held - std::begin(reduction.bins().limit);
      std::fill(std::begin(bins.limit), std::end(bins.limit), -1.0);
      if (internal::mayWinBins(placed, bins, block).unsure != 0) {
        ++unsure;
        continue;
      }
      bins.limit[bin] = *held;
      EXPECT_EQ(anyOf(internal::mayWinBins(placed, bins, block)), 255U) << i;
      const bool isAlone = std::none_of(
          places.place, places.place + places.count, [&](const internal::NearPlace& other) {
            return other.distance < places.place[i].distance * (1.0 - kBits);
          });
      if (!isAlone) continue;
      bins.limit[bin] = *held * (1.0 - kBits);
      EXPECT_EQ(anyOf(internal::mayWinBins(placed, bins, block)), 0U) << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 2000);
  EXPECT_GT(unsure, 2000);  // the axis passes through the face, or is in line with an edge
}

/// A heap of bars, each along one of the axes, cut into `cells` pieces, at places that floats hold:
/// ends above edges, edges along axes and ties are the rule there.
RawScene heapOfBars(Random& random, int bars, int cells) {
  RawScene raw;
  raw.objectNames = {"bars"};
  const auto quad = [&](const Vector3d& p, const Vector3d& u, const Vector3d& v) {
    raw.triangles.push_back({{p, p + u, p + u + v}});
    raw.triangles.push_back({{p, p + u + v, p + v}});
    raw.objectOf.insert(raw.objectOf.end(), 2, 0);
  };
  for (int bar = 0; bar < bars; ++bar) {
    const int axis = random.below(3);
    Vector3d corner, piece = Vector3d::Zero(), side = Vector3d::Zero(), rise = Vector3d::Zero();
    for (double& x : corner) x = (random.below(64) - 32) / 64.0;
    piece[axis] = 1.0 / 64.0;
    side[(axis + 1) % 3] = rise[(axis + 2) % 3] = 1.0 / 32.0;
    for (int cell = 0; cell < cells; ++cell, corner += piece) {
      quad(corner, piece, side);
      quad(corner + rise, piece, side);
      quad(corner, piece, rise);
      quad(corner + side, piece, rise);
    }
  }
  return raw;
}

TEST_P(NearReductionTest, OfBarsThatAreInLineWithTheLinksIsThatOfAllPlaces) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Scene scene = Scene::build(heapOfBars(random, 60, 20)).value();
    const Vector3d along = 0.25 * Vector3d::Unit(random.below(3));
    const Lss lss{Vector3d::Zero(), random.chance(0.2) ? Vector3d::Zero() : along, 0.03};
    const Avatar avatar =
        Avatar::build(Skeleton::build({{RawJoint{"link"}}}).value(), {{lss}}).value();
    LinkState state;
    for (double& x : state.p_WL) x = (random.below(64) - 32) / 64.0;
    // In line, or nearly.
    if (random.chance(0.5))
      state.R_WL = random.turn(random.magnitude(1e-9, 1e-2)).toRotationMatrix();
    compare(avatar, scene, {state}, random.magnitude(0.02, 0.5), tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.left, 200U);
  EXPECT_LT(tally.inDoubles, tally.all / 3);  // along a bar's edges, vertices stand for little
}

/// A hilly surface of small triangles: lanes refuse nearly all of it.
RawScene hills(Random& random, int cells) {
  RawScene raw;
  raw.objectNames = {"hills"};
  std::vector<Vector3d> points;
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k <= cells; ++k) {
      points.emplace_back(1.0 * i / cells - 0.5, random.uniform(-0.01, 0.01),
                          1.0 * k / cells - 0.5);
    }
  }
  const auto at = [&](int i, int k) { return points[slotOf(i * (cells + 1) + k)]; };
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) {
      raw.triangles.push_back({{at(i, k), at(i + 1, k), at(i + 1, k + 1)}});
      raw.triangles.push_back({{at(i, k), at(i + 1, k + 1), at(i, k + 1)}});
      raw.objectOf.insert(raw.objectOf.end(), 2, 0);
    }
  }
  return raw;
}

TEST_P(NearReductionTest, OfManyTrianglesHardlyTakesDoubles) {
  Tally tally;
  const Avatar avatar = Avatar::build(Skeleton::build({{RawJoint{"link"}}}).value(),
                                      {{{Vector3d::Zero(), {0.25, 0.0, 0.0}, 0.04}}})
                            .value();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Scene scene = Scene::build(hills(random, 60)).value();
    LinkState state;
    state.R_WL = random.turn(0.3).toRotationMatrix();
    state.p_WL = {-0.1, 0.06, 0.0};
    compare(avatar, scene, {state}, 0.1, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.all, 10000U);
  EXPECT_LT(tally.inDoubles, tally.all / 4);
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, NearReductionTest, testing::ValuesIn(supportedSimd()),
                         [](const auto& width) { return toString(width.param); });

}  // namespace
}  // namespace foretouch
