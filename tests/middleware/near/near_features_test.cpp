// What links are near to, against the oracle's distance of every pair, and by the laws that a
// reduced answer keeps.
#include "middleware/near/near_features.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "judge/distance.h"
#include "lss/simd.h"
#include "tests/middleware/random_scene.h"
#include "tests/support/judged.h"
#include "tests/support/widest_afterwards.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

std::vector<LinkState> statesOf(const Avatar& avatar, const Pose& pose) {
  std::vector<LinkState> states;
  ChainMotion(avatar.skeleton(), pose, pose).statesAt(0.0, states);
  return states;
}

NearFeatures nearOf(const NearQuery& query, const std::vector<LinkState>& states, double reach,
                    NearDetail detail = NearDetail::Reduced) {
  Scratch scratch;
  NearFeatures near;
  query.answer(states, std::vector<double>(states.size(), reach), scratch, near, detail);
  return near;
}

oracle::Closest<oracle::Real> truth(const Lss& lss, const LinkState& state,
                                    const Triangle& triangle) {
  const auto real = [](const Vector3d& p) {
    return oracle::Vec3r{static_cast<oracle::Real>(p.x()), static_cast<oracle::Real>(p.y()),
                         static_cast<oracle::Real>(p.z())};
  };
  return oracle::closestPoints<oracle::Real>(
      real(state.pointAt(lss.a)), real(state.pointAt(lss.b)),
      {real(triangle.vertices[0]), real(triangle.vertices[1]), real(triangle.vertices[2])});
}

double separationOf(const Lss& lss, const LinkState& state, const Triangle& triangle) {
  return static_cast<double>(truth(lss, state, triangle).distance) - lss.radius;
}

class NearFeaturesTest : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

using PairKey = std::tuple<LinkId, std::int32_t, TriangleId>;

TEST_P(NearFeaturesTest, AreOfEveryPairWithinReachAndTrueOfIt) {
  std::size_t found = 0, farther = 0, within = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Vector3d center = random.chance(0.2) ? Vector3d(random.inBox(1e5)) : Vector3d::Zero();
    const Scene scene = Scene::build(test::clutter(random, 300, 3, center)).value();
    const test::RandomBody body = test::bodyInClutter(random, 6, center);
    const std::vector<IgnoredPair> ignored{{1, 0}, {2, IgnoredPair::kEveryObject}};
    const NearQuery query = NearQuery::build(body.avatar, scene, ignored).value();
    const auto states = statesOf(body.avatar, body.to);
    std::vector<double> reach(states.size(), random.magnitude(1e-2, 1.0));
    reach[3] = -1.0;
    Scratch scratch;
    NearFeatures all;
    query.answer(states, reach, scratch, all, NearDetail::All);
    std::map<PairKey, double> gaps;
    for (const NearFeature& feature : all.features) {
      const Lss& lss = body.avatar.lss(feature.link)[slotOf(feature.lss)];
      const LinkState& state = states[slotOf(feature.link)];
      const Triangle& triangle = scene.triangle(feature.triangle);
      const double separation = separationOf(lss, state, triangle);
      // The gap is at this place: the pair's own is the least.
      auto& gap =
          gaps.try_emplace({feature.link, feature.lss, feature.triangle}, 1e9).first->second;
      gap = std::min(gap, feature.gap);
      EXPECT_LE(separation, feature.gap + 1e-9 + 1e-9 * center.norm());
      EXPECT_LE(feature.gap, reach[0]);
      const Vector3d p_Axis = feature.p_WLink + lss.radius * feature.nhat_SL_W;
      const Vector3d a = state.pointAt(lss.a), b = state.pointAt(lss.b);
      EXPECT_LE((p_Axis - (a + feature.along * (b - a))).norm(), 1e-8 + 1e-9 * center.norm());
      EXPECT_LE(
          static_cast<double>(
              truth({feature.p_WScene, feature.p_WScene, 0.0}, LinkState(), triangle).distance),
          1e-9 + 1e-14 * center.norm());
      ++found;
    }
    for (LinkId link = 0; link < body.avatar.numLinks(); ++link) {
      const auto& own = body.avatar.lss(link);
      for (std::int32_t i = 0; i < static_cast<std::int32_t>(own.size()); ++i) {
        for (TriangleId id = 0; id < static_cast<TriangleId>(scene.numTriangles()); ++id) {
          const auto it = gaps.find({link, i, id});
          const bool isAsked = link != 2 && link != 3 && !(link == 1 && scene.object(id) == 0);
          if (!isAsked) {
            EXPECT_EQ(it, gaps.end());
            continue;
          }
          const double separation =
              separationOf(own[slotOf(i)], states[slotOf(link)], scene.triangle(id));
          if (it == gaps.end()) {
            EXPECT_GT(separation, reach[0] - 1e-14);
            ++farther;
          } else {
            EXPECT_LE(it->second, separation);
            EXPECT_GE(it->second, separation - 1e-9 - 1e-9 * center.norm());
            ++within;
          }
        }
      }
    }
  }
  EXPECT_GT(found, 5000U);
  EXPECT_GT(within, 2500U);
  EXPECT_GT(farther, 50000U);
}

/// One link with one LSS, which stands as its state says.
Avatar single(const Lss& lss) {
  return Avatar::build(Skeleton::build({{RawJoint{"link"}}}).value(), {{lss}}).value();
}

/// A board of `side` m in the plane y = 0, of 2 cells^2 triangles.
RawScene board(int cells, double side) {
  RawScene raw;
  raw.objectNames = {"board"};
  const auto at = [&](int i, int j) {
    return Vector3d(side * (static_cast<double>(i) / cells - 0.5), 0.0,
                    side * (static_cast<double>(j) / cells - 0.5));
  };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      raw.triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      raw.triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  }
  raw.objectOf.assign(raw.triangles.size(), 0);
  return raw;
}

/// The scene in another place.
RawScene moved(RawScene raw, const Eigen::Matrix3d& R, const Vector3d& p) {
  for (Triangle& triangle : raw.triangles) {
    for (Vector3d& v : triangle.vertices) v = R * v + p;
  }
  return raw;
}

std::string described(const NearFeatures& near) {
  std::ostringstream text;
  for (const NearFeature& f : near.features) {
    text << toString(f.feature) << " lss " << f.lss << " along " << f.along << " gap " << f.gap
         << " at " << f.p_WScene.transpose() << " n " << f.nhat_SL_W.transpose() << " triangle "
         << f.triangle << '\n';
  }
  return text.str();
}

/// The same places, whichever triangles hold them; `R`, `p`: from x to y.
void expectSame(const NearFeatures& x, const NearFeatures& y, double within,
                const Eigen::Matrix3d& R = Eigen::Matrix3d::Identity(),
                const Vector3d& p = Vector3d::Zero()) {
  EXPECT_EQ(x.features.size(), y.features.size());
  std::vector<char> isTaken(y.features.size(), 0);
  for (const NearFeature& f : x.features) {
    bool isFound = false;
    for (std::size_t i = 0; i < y.features.size() && !isFound; ++i) {
      const NearFeature& g = y.features[i];
      isFound = isTaken[i] == 0 && f.link == g.link && f.lss == g.lss && f.feature == g.feature &&
                std::abs(f.gap - g.gap) <= within && std::abs(f.along - g.along) <= within &&
                (R * f.p_WScene + p - g.p_WScene).norm() <= within &&
                (R * f.p_WLink + p - g.p_WLink).norm() <= within &&
                (R * f.nhat_SL_W - g.nhat_SL_W).norm() <= within;
      if (isFound) isTaken[i] = 1;
    }
    EXPECT_TRUE(isFound);
  }
  if (testing::Test::HasFailure()) {
    std::cerr << described(x) << "against\n" << described(y);
    FAIL();
  }
}

/// A capsule as long as a forearm, near the plane y = 0: above the board, or across its rim.
LinkState nearPlane(Random& random, double half, double radius) {
  LinkState state;
  state.R_WL = random.turn(random.magnitude(1e-6, 0.6)).toRotationMatrix() *
               Eigen::AngleAxisd(random.uniform(-3.0, 3.0), Vector3d::UnitY()).toRotationMatrix();
  state.p_WL = {random.uniform(-half, half), radius + random.uniform(-0.01, 0.03),
                random.uniform(-half, half)};
  return state;
}

TEST_P(NearFeaturesTest, OfAFlatBoardDoNotDependOnItsTriangles) {
  const Lss lss{{0.0, 0.0, 0.0}, {0.25, 0.0, 0.0}, 0.04};
  const Avatar avatar = single(lss);
  std::size_t faces = 0, edges = 0, vertices = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random random(seed);
    const Eigen::Matrix3d R =
        seed == 0 ? Eigen::Matrix3d::Identity().eval() : random.rotation().toRotationMatrix();
    const Vector3d p = seed == 0 ? Vector3d::Zero() : Vector3d(random.inBox(3.0));
    const Scene coarse = Scene::build(moved(board(1, 1.0), R, p)).value();
    const Scene fine = Scene::build(moved(board(100, 1.0), R, p)).value();
    const NearQuery two = NearQuery::build(avatar, coarse).value();
    const NearQuery many = NearQuery::build(avatar, fine).value();
    for (int k = 0; k < 200; ++k) {
      SCOPED_TRACE(testing::Message() << seed << ' ' << k);
      LinkState state = nearPlane(random, 0.55, lss.radius);
      state.R_WL = R * state.R_WL;
      state.p_WL = R * state.p_WL + p;
      const NearFeatures x = nearOf(two, {state}, 0.05), y = nearOf(many, {state}, 0.05);
      expectSame(x, y, 1e-6);
      if (HasFatalFailure()) return;
      for (const NearFeature& f : x.features) {
        faces += f.feature == FeatureKind::Face ? 1 : 0;
        edges += f.feature == FeatureKind::Edge ? 1 : 0;
        vertices += f.feature == FeatureKind::Vertex ? 1 : 0;
      }
    }
  }
  EXPECT_GT(faces, 500U);
  EXPECT_GT(edges, 100U);
  EXPECT_GT(vertices, 5U);
}

/// The clutter's triangles in another order; `to[i]`: where triangle i went.
RawScene shuffled(const RawScene& raw, Random& random, std::vector<TriangleId>& to) {
  RawScene other;
  other.objectNames = raw.objectNames;
  std::vector<std::size_t> from(raw.triangles.size());
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = i;
  for (std::size_t i = from.size(); i > 1; --i) {
    std::swap(from[i - 1], from[slotOf(random.below(static_cast<int>(i)))]);
  }
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    other.triangles.push_back(raw.triangles[from[i]]);
    other.objectOf.push_back(raw.objectOf[from[i]]);
    to[from[i]] = static_cast<TriangleId>(i);
  }
  return other;
}

TEST_P(NearFeaturesTest, DoNotDependOnTheOrderOfTheTriangles) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const RawScene raw = test::clutter(random, 400, 3, Vector3d::Zero());
    const test::RandomBody body = test::bodyInClutter(random, 5, Vector3d::Zero());
    std::vector<TriangleId> to;
    const Scene scene = Scene::build(raw).value();
    const Scene other = Scene::build(shuffled(raw, random, to)).value();
    const auto states = statesOf(body.avatar, body.from);
    for (const NearDetail detail : {NearDetail::Reduced, NearDetail::Nearest}) {
      const auto near = nearOf(NearQuery::build(body.avatar, scene).value(), states, 0.3, detail);
      const auto same = nearOf(NearQuery::build(body.avatar, other).value(), states, 0.3, detail);
      expectSame(near, same, 0.0);
      if (HasFatalFailure()) return;
      for (const NearFeature& feature : near.features) {
        const Triangle& triangle = scene.triangle(feature.triangle);
        EXPECT_TRUE(std::any_of(same.features.begin(), same.features.end(), [&](const auto& f) {
          return other.triangle(f.triangle).vertices == triangle.vertices && f.gap == feature.gap;
        }));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1000U);
}

TEST_P(NearFeaturesTest, MoveWithTheSceneAndTheBody) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    RawScene raw = test::clutter(random, 300, 1, Vector3d::Zero());
    const test::RandomBody body = test::bodyInClutter(random, 5, Vector3d::Zero());
    const Eigen::Matrix3d R = random.rotation().toRotationMatrix();
    const Vector3d p = random.inBox(3.0);
    auto states = statesOf(body.avatar, body.from);
    const Scene scene = Scene::build(raw).value();
    const Scene other = Scene::build(moved(raw, R, p)).value();
    const auto near = nearOf(NearQuery::build(body.avatar, scene).value(), states, 0.2);
    for (LinkState& state : states) {
      state.R_WL = R * state.R_WL;
      state.p_WL = R * state.p_WL + p;
    }
    const auto same = nearOf(NearQuery::build(body.avatar, other).value(), states, 0.2);
    expectSame(near, same, 1e-9, R, p);
    if (HasFatalFailure()) return;
    compared += near.features.size();
  }
  EXPECT_GT(compared, 400U);
}

TEST_P(NearFeaturesTest, NearestIsTheNearestOfAll) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Scene scene = Scene::build(test::clutter(random, 300, 3, Vector3d::Zero())).value();
    const test::RandomBody body = test::bodyInClutter(random, 6, Vector3d::Zero());
    const auto states = statesOf(body.avatar, body.from);
    const NearQuery query = NearQuery::build(body.avatar, scene).value();
    const auto nearest = nearOf(query, states, 0.4, NearDetail::Nearest);
    const auto reduced = nearOf(query, states, 0.4);
    for (LinkId link = 0; link < body.avatar.numLinks(); ++link) {
      double least = 1e9;
      for (const Lss& lss : body.avatar.lss(link)) {
        for (TriangleId id = 0; id < static_cast<TriangleId>(scene.numTriangles()); ++id) {
          least = std::min(least, separationOf(lss, states[slotOf(link)], scene.triangle(id)));
        }
      }
      const NearRange& range = nearest.links[slotOf(link)];
      ASSERT_EQ(range.count, least <= 0.4 ? 1U : 0U);
      if (range.count == 0) continue;
      EXPECT_NEAR(nearest.features[range.first].gap, least, 1e-9);
      EXPECT_LE(nearest.features[range.first].gap, least);
      // A reduced answer has it, or a face that stands for it.
      double kept = 1e9;
      const NearRange& left = reduced.links[slotOf(link)];
      for (std::size_t i = 0; i < left.count; ++i) {
        kept = std::min(kept, reduced.features[left.first + i].gap);
      }
      EXPECT_LE(kept, least + 1e-4);
      ++compared;
    }
  }
  EXPECT_GT(compared, 150U);
}

/// A box of 1 m by 2 cm by 1 m, its top at y = 0, each side cut into cells.
RawScene tableTop(int cells) {
  RawScene raw;
  raw.objectNames = {"table"};
  const double half = 0.5, thick = 0.02;
  const auto addSide = [&](const Vector3d& corner, const Vector3d& u, const Vector3d& v) {
    const auto at = [&](int i, int j) {
      // The same sums for both sides of an edge, so that they share vertices bit for bit.
      const auto mix = [&](int axis) {
        return corner[axis] + u[axis] * i / cells + v[axis] * j / cells;
      };
      return Vector3d(mix(0), mix(1), mix(2));
    };
    for (int i = 0; i < cells; ++i) {
      for (int j = 0; j < cells; ++j) {
        raw.triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
        raw.triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
      }
    }
  };
  const Vector3d x(1, 0, 0), y(0, thick, 0), z(0, 0, 1);
  const Vector3d low(-half, -thick, -half), high(half, 0, half);
  addSide(low, x, z);
  addSide(low + y, x, z);
  addSide(low, x, y);
  addSide(low + z, x, y);
  addSide(low, y, z);
  addSide(low + x, y, z);
  raw.objectOf.assign(raw.triangles.size(), 0);
  return raw;
}

TEST_P(NearFeaturesTest, OfATableAreItsFacesAndItsRim) {
  const Lss lss{{0.0, 0.0, 0.0}, {0.25, 0.0, 0.0}, 0.04};
  const Avatar avatar = single(lss);
  for (const int cells : {1, 16}) {
    const Scene scene = Scene::build(tableTop(cells)).value();
    const NearQuery query = NearQuery::build(avatar, scene).value();
    const auto at = [&](double x, double y) {
      LinkState state;
      state.p_WL = {x, y, 0.013};
      return nearOf(query, {state}, 0.01);
    };
    // On the table: both ends, and no edge of the tiles.
    const NearFeatures on = at(-0.1, 0.045);
    ASSERT_EQ(on.features.size(), 2U) << described(on);
    for (const NearFeature& f : on.features) {
      EXPECT_EQ(f.feature, FeatureKind::Face);
      EXPECT_NEAR(f.gap, 0.005, 1e-12);
    }
    // Across the rim: one end, and the rim where the axis crosses it.
    const NearFeatures across = at(0.4, 0.045);
    ASSERT_EQ(across.features.size(), 2U) << described(across);
    const auto rim = std::find_if(across.features.begin(), across.features.end(),
                                  [](const auto& f) { return f.feature == FeatureKind::Edge; });
    ASSERT_NE(rim, across.features.end()) << described(across);
    EXPECT_NEAR(rim->p_WScene.x(), 0.5, 1e-12);
    EXPECT_NEAR(rim->along, 0.4, 1e-9);
    // Beside it: the rim's side.
    EXPECT_FALSE(at(0.545, -0.01).features.empty());
  }
}

TEST_P(NearFeaturesTest, OfAPoleAreItsEdges) {
  // A square pole of 1 cm along y, cut into many pieces: its edges stay.
  RawScene raw;
  raw.objectNames = {"pole"};
  const double side = 0.005;
  const Vector3d corners[] = {
      {-side, 0, -side}, {side, 0, -side}, {side, 0, side}, {-side, 0, side}};
  for (int k = 0; k < 4; ++k) {
    for (int j = -50; j < 50; ++j) {
      const Vector3d low(0, 0.01 * j, 0), high(0, 0.01 * (j + 1), 0);
      const Vector3d &p = corners[k], &q = corners[(k + 1) % 4];
      raw.triangles.push_back({{p + low, q + low, q + high}});
      raw.triangles.push_back({{p + low, q + high, p + high}});
    }
  }
  raw.objectOf.assign(raw.triangles.size(), 0);
  const Scene scene = Scene::build(raw).value();
  const Avatar avatar = single({{0.0, 0.0, -0.1}, {0.0, 0.0, 0.1}, 0.03});
  const NearQuery query = NearQuery::build(avatar, scene).value();
  LinkState state;
  state.p_WL = {0.04, 0.1234, 0.0};
  // Along z, beside a face of the pole that is narrower than the axis: its two edges.
  const NearFeatures near = nearOf(query, {state}, 0.01);
  std::size_t edges = 0;
  for (const NearFeature& f : near.features) {
    if (f.feature != FeatureKind::Edge) continue;
    ++edges;
    EXPECT_NEAR(std::abs(f.p_WScene.z()), side, 1e-12);
    EXPECT_NEAR(f.p_WScene.y(), 0.1234, 1e-12);
    EXPECT_NEAR(f.gap, 0.005, 1e-12);
  }
  EXPECT_GE(edges, 1U) << described(near);
  EXPECT_LE(near.features.size(), 2U) << described(near);
}

TEST_P(NearFeaturesTest, OfAnAxisThroughATriangleOverlap) {
  const Scene scene = Scene::build(board(1, 1.0)).value();
  const Avatar avatar = single({{0.0, -0.1, 0.0}, {0.0, 0.2, 0.0}, 0.04});
  LinkState state;
  state.p_WL = {0.1, 0.0, 0.2};
  const auto near =
      nearOf(NearQuery::build(avatar, scene).value(), {state}, 0.01, NearDetail::Nearest);
  ASSERT_EQ(near.features.size(), 1U);
  const NearFeature& f = near.features[0];
  EXPECT_NEAR(f.gap, -0.04, 1e-12);
  EXPECT_LE(f.gap, -0.04);
  EXPECT_NEAR((f.nhat_SL_W - Vector3d(0, 1, 0)).norm(), 0.0, 1e-12);  // its longer part is above
  EXPECT_NEAR(f.along, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR((f.p_WScene - state.p_WL).norm(), 0.0, 1e-12);
}

TEST_P(NearFeaturesTest, OfTrianglesWithoutAreaAndOfBareLinks) {
  RawScene raw;
  raw.objectNames = {"odd"};
  const Vector3d p(0.3, 0.0, 0.0), q(0.3, 0.5, 0.0);
  raw.triangles = {{{p, p, p}}, {{p, q, 0.5 * (p + q)}}, {{p, p, q}}};
  raw.objectOf = {0, 0, 0};
  const Scene scene = Scene::build(raw).value();
  RawSkeleton skeleton;
  skeleton.joints = {RawJoint{"bare"}, RawJoint{"ball", 0}};
  const Avatar avatar = Avatar::build(Skeleton::build(skeleton).value(),
                                      {{}, {{Vector3d::Zero(), Vector3d::Zero(), 0.1}}})
                            .value();
  const NearQuery query = NearQuery::build(avatar, scene).value();
  const auto all = nearOf(query, {LinkState(), LinkState()}, 0.3, NearDetail::All);
  EXPECT_EQ(all.features.size(), 3U);
  const auto near = nearOf(query, {LinkState(), LinkState()}, 0.3);
  ASSERT_GE(near.features.size(), 1U);
  EXPECT_EQ(near.links[0].count, 0U);
  for (const NearFeature& f : near.features) {
    EXPECT_EQ(f.link, 1);
    EXPECT_NEAR(f.gap, 0.2, 1e-12);
    EXPECT_NE(f.feature, FeatureKind::Face);
  }
}

// A link of many balls, each with a corner of its own beside it.
TEST(NearQueries, KeepTheNearestWhereALinkHasTooMany) {
  RawScene raw;
  raw.objectNames = {"spikes"};
  RawSkeleton skeleton;
  skeleton.joints = {{"row", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  std::vector<Lss> balls;
  constexpr int kBalls = 400;
  for (int i = 0; i < kBalls; ++i) {
    const Vector3d middle(3.0 * i, 0.0, 0.0);
    const Vector3d out(0.0, std::cos(2.4 * i), std::sin(2.4 * i)), side(0.001, 0.0, 0.0);
    const double far = 0.3 + 1e-4 * i;
    balls.push_back({middle, middle, 0.1});
    raw.triangles.push_back(
        {{middle + far * out, middle + 2.0 * far * out + side, middle + 2.0 * far * out - side}});
    raw.objectOf.push_back(0);
  }
  const Scene scene = Scene::build(std::move(raw)).value();
  const Avatar row = Avatar::build(Skeleton::build(skeleton).value(), {balls}).value();
  const NearQuery query = NearQuery::build(row, scene).value();
  const auto all = nearOf(query, {LinkState()}, 1.0, NearDetail::All);
  EXPECT_FALSE(all.links[0].hadMore);
  EXPECT_EQ(all.features.size(), 1u * kBalls);
  const auto near = nearOf(query, {LinkState()}, 1.0);
  ASSERT_EQ(near.features.size(), kMostNearPerLink);
  EXPECT_TRUE(near.links[0].hadMore);
  for (const NearFeature& feature : near.features) {
    EXPECT_LT(feature.gap, 0.2 + 1e-4 * static_cast<double>(kMostNearPerLink));
  }
}

TEST(NearQueries, RefuseIgnoredPairsOfNobody) {
  const Scene scene = Scene::build(board(1, 1.0)).value();
  const Avatar avatar = single({{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, 0.04});
  for (const IgnoredPair& pair : {IgnoredPair{1, 0}, IgnoredPair{0, 1}, IgnoredPair{-1, 0}}) {
    const auto query = NearQuery::build(avatar, scene, {pair});
    ASSERT_FALSE(query.ok());
    EXPECT_EQ(query.error().file, "ignored");
  }
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, NearFeaturesTest, testing::ValuesIn(supportedSimd()),
                         [](const auto& width) { return toString(width.param); });

}  // namespace
}  // namespace foretouch
