// ft_near against the library's own answers, and what it refuses.
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/near/near_features.h"
#include "tests/bindings/c_world.h"
#include "tests/middleware/random_scene.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

struct ReleaseNear {
  void operator()(ft_near* near) const { ft_near_destroy(near); }
};
using NearHandle = std::unique_ptr<ft_near, ReleaseNear>;

NearHandle makeNear(const test::SceneHandle& scene, const test::AvatarHandle& avatar,
                    const ft_near_options* options = nullptr) {
  ft_near* made = nullptr;
  EXPECT_EQ(ft_near_create(scene.get(), avatar.get(), options, &made), FT_OK) << ft_last_error();
  return NearHandle(made);
}

std::vector<ft_near_feature> featuresOf(const NearHandle& near) {
  std::size_t count = 0;
  EXPECT_EQ(ft_near_features(near.get(), nullptr, 0, &count), FT_OK) << ft_last_error();
  std::vector<ft_near_feature> features(count);
  for (ft_near_feature& feature : features) feature.size = sizeof feature;
  EXPECT_EQ(ft_near_features(near.get(), features.data(), count, &count), FT_OK) << ft_last_error();
  return features;
}

Vector3d vectorOf(const double (&p)[3]) {
  return Eigen::Map<const Vector3d>(p);
}

TEST(CNear, AnswersAreThoseOfTheLibrary) {
  test::Random random(4);
  std::size_t compared = 0;
  const RawScene raw = test::clutter(random, 400, 3, Vector3d::Zero());
  const Scene scene = Scene::build(raw).value();
  const auto sceneHandle = test::makeScene(raw);
  for (int body = 0; body < 10; ++body) {
    const test::RandomBody random_body = test::bodyInClutter(random, 5, Vector3d::Zero());
    const Avatar& avatar = random_body.avatar;
    const auto avatarHandle = test::makeAvatar(avatar);
    const ft_ignored_pair ignored{1, 2};
    auto options = test::initialised(ft_near_options_init);
    options.ignored = &ignored;
    options.ignored_count = 1;
    options.detail = body % 3;
    const auto near = makeNear(sceneHandle, avatarHandle, &options);
    const test::PoseArrays pose(random_body.from);
    const ft_pose view = pose.view();
    std::vector<double> reach(5, 0.3);
    reach[2] = -1.0;
    ASSERT_EQ(ft_near_ask(near.get(), &view, reach.data(), reach.size()), FT_OK) << ft_last_error();

    const NearQuery query = NearQuery::build(avatar, scene, {{1, 2}}).value();
    Scratch scratch;
    NearFeatures expected;
    std::vector<LinkState> states;
    ChainMotion(avatar.skeleton(), random_body.from, random_body.from).statesAt(0.0, states);
    query.answer(states, reach, scratch, expected, static_cast<NearDetail>(body % 3));
    const auto features = featuresOf(near);
    ASSERT_EQ(features.size(), expected.features.size());
    for (std::size_t i = 0; i < features.size(); ++i) {
      const ft_near_feature& got = features[i];
      const NearFeature& wanted = expected.features[i];
      EXPECT_EQ(got.size, sizeof got);
      EXPECT_EQ(got.link, wanted.link);
      EXPECT_EQ(got.lss, wanted.lss);
      EXPECT_EQ(got.triangle, wanted.triangle);
      EXPECT_EQ(got.object, scene.object(wanted.triangle));
      EXPECT_EQ(got.feature, static_cast<int>(wanted.feature));
      EXPECT_EQ(got.along, wanted.along);
      EXPECT_EQ(got.gap, wanted.gap);
      EXPECT_EQ(vectorOf(got.point_scene), wanted.p_WScene);
      EXPECT_EQ(vectorOf(got.point_link), wanted.p_WLink);
      EXPECT_EQ(vectorOf(got.normal), wanted.nhat_SL_W);
      ++compared;
    }
    std::vector<ft_near_range> ranges(5);
    std::size_t count = 0;
    ASSERT_EQ(ft_near_ranges(near.get(), ranges.data(), ranges.size(), &count), FT_OK);
    ASSERT_EQ(count, 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(ranges[i].first, expected.links[i].first);
      EXPECT_EQ(ranges[i].count, expected.links[i].count);
      EXPECT_EQ(ranges[i].had_more, 0);
    }
  }
  EXPECT_GT(compared, 100U);
}

TEST(CNear, RefusesBadArgumentsByName) {
  const test::SmallWorld world;
  ft_near* made = nullptr;
  auto options = test::initialised(ft_near_options_init);
  options.detail = 7;
  test::expectRefused(ft_near_create(world.scene.get(), world.avatar.get(), &options, &made),
                      FT_ERROR_OUT_OF_RANGE, {"ft_near_create", "detail"});
  options.detail = FT_NEAR_REDUCED;
  const ft_ignored_pair nobody{9, 0};
  options.ignored = &nobody;
  options.ignored_count = 1;
  test::expectRefused(ft_near_create(world.scene.get(), world.avatar.get(), &options, &made),
                      FT_ERROR_OUT_OF_RANGE, {"ignored"});
  EXPECT_EQ(made, nullptr);
  test::expectRefused(ft_near_create(nullptr, world.avatar.get(), nullptr, &made),
                      FT_ERROR_NULL_ARGUMENT, {"scene"});

  const auto near = makeNear(world.scene, world.avatar);
  std::size_t count = 0;
  test::expectRefused(ft_near_features(near.get(), nullptr, 0, &count), FT_ERROR_NO_STEP,
                      {"ft_near_ask"});
  const ft_pose pose = world.up();
  const double reach[] = {0.5, 0.5};
  test::expectRefused(ft_near_ask(near.get(), &pose, reach, 2), FT_ERROR_MISMATCH, {"reach"});
  test::expectRefused(ft_near_ask(near.get(), &pose, nullptr, 1), FT_ERROR_NULL_ARGUMENT,
                      {"reach"});
  for (const double bad : {std::nan(""), 1.1e7, std::numeric_limits<double>::infinity()}) {
    test::expectRefused(ft_near_ask(near.get(), &pose, &bad, 1), FT_ERROR_OUT_OF_RANGE, {"reach"});
  }
  test::expectRefused(ft_near_ask(near.get(), nullptr, reach, 1), FT_ERROR_NULL_ARGUMENT, {"pose"});
  ASSERT_EQ(ft_near_ask(near.get(), &pose, reach, 1), FT_OK) << ft_last_error();
  EXPECT_TRUE(featuresOf(near).empty());
}

}  // namespace
}  // namespace foretouch
