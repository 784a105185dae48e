// What links are near to, against the oracle's distance of every pair, and by the laws that a
// reduced answer keeps.
#include "middleware/query/near_features.h"

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
  NearScratch scratch;
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
    NearScratch scratch;
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

INSTANTIATE_TEST_SUITE_P(EveryWidth, NearFeaturesTest, testing::ValuesIn(supportedSimd()),
                         [](const auto& width) { return toString(width.param); });

}  // namespace
}  // namespace foretouch
