#include "tests/bindings/solid_world.h"

#include <algorithm>
#include <cmath>
#include <foretouch/solid_world.h>

#include "tests/bindings/same_answers.h"

namespace foretouch::test {

SolidHandle makeSolid(const SceneHandle& scene, const AvatarHandle& avatar,
                      const ft_solid_options* options) {
  ft_solid* solid = nullptr;
  EXPECT_EQ(ft_solid_create(scene.get(), avatar.get(), options, &solid), FT_OK) << ft_last_error();
  return SolidHandle(solid);
}

RawScene tableScene(int numTiles) {
  RawScene table;
  const double side = 4.0 / numTiles;
  for (int i = 0; i < numTiles; ++i) {
    const double x = -2.0 + side * i;
    table.triangles.push_back({{{{x, 0, -2}, {x + side, 0, -2}, {x + side, 0, 2}}}});
    table.triangles.push_back({{{{x, 0, -2}, {x + side, 0, 2}, {x, 0, 2}}}});
    table.objectOf.insert(table.objectOf.end(), {0, 0});
  }
  table.objectNames = {"table"};
  return table;
}

Avatar armAvatar() {
  RawSkeleton bones;
  bones.joints.push_back({"Shoulder", kNoParent, {0, 0.3, 0}, Quaternion::Identity()});
  bones.joints.push_back({"Elbow", 0, {0.3, 0, 0}, Quaternion::Identity()});
  bones.joints.push_back({"Hand", 1, {0.25, 0, 0}, Quaternion::Identity()});
  const Lss upper{{0, 0, 0}, {0.3, 0, 0}, 0.05}, fore{{0, 0, 0}, {0.25, 0, 0}, 0.04};
  const Lss palm{{0, 0, 0}, {0.08, 0, 0}, 0.03};
  return Avatar::build(Skeleton::build(bones).value(), {{upper}, {fore}, {palm}}).value();
}

Pose armPose(const Avatar& avatar, double t) {
  const double down = std::clamp(std::min(t, 3.0 - t), 0.0, 1.0);
  const double along = std::clamp(t - 1.0, 0.0, 1.0);
  Pose pose = restPose(avatar.skeleton());
  pose.rotations[0] = Eigen::AngleAxisd(0.8 * along, Eigen::Vector3d::UnitY()) *
                      Eigen::AngleAxisd(-0.75 * down, Eigen::Vector3d::UnitZ());
  pose.rotations[1] = Eigen::AngleAxisd(-0.3 * down, Eigen::Vector3d::UnitZ());
  return validatedPose(avatar.skeleton(), std::move(pose)).value();
}

SolidWorld::SolidWorld()
    : avatarOfCxx(armAvatar()),
      sceneOfCxx(Scene::build(tableScene()).value()),
      scene(makeScene(tableScene())),
      avatar(makeAvatar(avatarOfCxx)) {}

namespace {

/// `ask`: the functions of C that say what the tick shows.
template <typename Ask>
WholeTick wholeTickOf(const Ask& ask, const ft_solid_tick& tick) {
  WholeTick whole;
  whole.tick = tick;
  std::size_t joints = 0, count = 0;
  EXPECT_EQ(ask.shown(nullptr, nullptr, 0, &joints), FT_OK) << ft_last_error();
  EXPECT_EQ(tick.joint_count, joints);
  if (joints == 0) return whole;
  whole.rotations.resize(4 * joints);
  whole.translations.resize(3 * joints);
  EXPECT_EQ(ask.shown(whole.rotations.data(), whole.translations.data(), joints, &count), FT_OK);
  whole.joints.resize(joints);
  whole.joints[0].size = sizeof(ft_solid_joint);
  EXPECT_EQ(ask.joints(whole.joints.data(), joints, &count), FT_OK);
  EXPECT_EQ(count, joints);
  whole.contacts.resize(tick.contact_count + 1);
  whole.contacts[0].size = sizeof(ft_solid_contact);
  EXPECT_EQ(ask.contacts(whole.contacts.data(), tick.contact_count, &count), FT_OK);
  EXPECT_EQ(count, tick.contact_count);
  if (tick.contact_count > 0) {
    EXPECT_EQ(whole.contacts.back().size, 0u) << "written past the end";
  }
  whole.contacts.pop_back();
  whole.wayTimes.resize(tick.way_count);
  whole.wayRotations.resize(4 * joints * tick.way_count);
  whole.wayTranslations.resize(3 * joints * tick.way_count);
  for (std::size_t i = 0; i < tick.way_count; ++i) {
    EXPECT_EQ(ask.way(i, &whole.wayTimes[i], &whole.wayRotations[4 * joints * i],
                      &whole.wayTranslations[3 * joints * i], joints, nullptr),
              FT_OK);
  }
  expectRefused(ask.way(tick.way_count, nullptr, nullptr, nullptr, 0, nullptr),
                FT_ERROR_OUT_OF_RANGE, {"_way", "index"});
  return whole;
}

struct AskSolid {
  const ft_solid* solid;
  template <typename... Args>
  ft_status shown(Args... args) const {
    return ft_solid_shown(solid, args...);
  }
  template <typename... Args>
  ft_status joints(Args... args) const {
    return ft_solid_joints(solid, args...);
  }
  template <typename... Args>
  ft_status contacts(Args... args) const {
    return ft_solid_contacts(solid, args...);
  }
  template <typename... Args>
  ft_status way(Args... args) const {
    return ft_solid_way(solid, args...);
  }
};

struct AskWorld {
  const ft_world* world;
  std::int32_t body;
  template <typename... Args>
  ft_status shown(Args... args) const {
    return ft_solid_world_shown(world, body, args...);
  }
  template <typename... Args>
  ft_status joints(Args... args) const {
    return ft_solid_world_joints(world, body, args...);
  }
  template <typename... Args>
  ft_status contacts(Args... args) const {
    return ft_solid_world_contacts(world, body, args...);
  }
  template <typename... Args>
  ft_status way(Args... args) const {
    return ft_solid_world_way(world, body, args...);
  }
};

void expectSameCounters(const ft_solid_tick& c, const SolidCounters& cxx) {
  EXPECT_EQ(c.queries, cxx.queries);
  EXPECT_EQ(c.iterations, cxx.iterations);
  EXPECT_EQ(c.features, cxx.features);
  EXPECT_EQ(c.rows, cxx.rows);
  EXPECT_EQ(c.around_queries, cxx.aroundQueries);
  EXPECT_EQ(c.placing_queries, cxx.placingQueries);
  EXPECT_EQ(c.work, cxx.work);
}

void expectSameContact(const ft_solid_contact& c, const SolidContact& cxx, const Scene& scene) {
  EXPECT_EQ(c.size, sizeof c);
  EXPECT_EQ(c.link, cxx.link);
  EXPECT_EQ(c.lss, cxx.lss);
  EXPECT_EQ(c.triangle, cxx.triangle);
  EXPECT_EQ(c.object, cxx.triangle < 0 ? -1 : scene.object(cxx.triangle));
  EXPECT_EQ(c.other, cxx.other);
  expectSameVector(c.point, cxx.p_W);
  expectSameVector(c.normal, cxx.nhat_W);
  EXPECT_EQ(c.gap, cxx.gap);
  EXPECT_EQ(c.push, cxx.push);
  EXPECT_EQ(c.slip_speed, cxx.slipSpeed);
}

void expectSameWay(const WholeTick& c, const SolidTick& cxx) {
  ASSERT_EQ(c.tick.way_count, cxx.numWay);
  std::vector<double> rotations, translations;
  for (std::size_t i = 0; i < cxx.numWay; ++i) {
    EXPECT_EQ(c.wayTimes[i], cxx.times[i]);
    const PoseArrays piece(cxx.way[i]);
    rotations.insert(rotations.end(), piece.rotations.begin(), piece.rotations.end());
    translations.insert(translations.end(), piece.translations.begin(), piece.translations.end());
  }
  EXPECT_EQ(c.wayRotations, rotations);
  EXPECT_EQ(c.wayTranslations, translations);
}

}  // namespace

void expectSame(const WholeTick& c, const SolidTick& cxx, const Scene& scene) {
  EXPECT_EQ(c.tick.state, static_cast<int>(cxx.state));
  EXPECT_EQ(c.tick.limit, static_cast<int>(cxx.limit));
  EXPECT_EQ(c.tick.is_certified, cxx.isCertified ? 1 : 0);
  EXPECT_EQ(c.tick.has_appeared, cxx.hasAppeared ? 1 : 0);
  EXPECT_EQ(c.tick.deviation, cxx.deviation);
  EXPECT_EQ(c.tick.lift, cxx.lift);
  EXPECT_EQ(c.tick.clearance, cxx.clearance);
  EXPECT_EQ(c.tick.snap_in_s, cxx.snapInS);
  expectSameCounters(c.tick, cxx.counters);
  const PoseArrays shown(cxx.shown);
  EXPECT_EQ(c.rotations, shown.rotations);
  EXPECT_EQ(c.translations, shown.translations);
  ASSERT_EQ(c.joints.size(), cxx.joints.size());
  for (std::size_t j = 0; j < c.joints.size(); ++j) {
    EXPECT_EQ(c.joints[j].size, sizeof(ft_solid_joint));
    EXPECT_EQ(c.joints[j].state, static_cast<int>(cxx.joints[j]));
    EXPECT_EQ(c.joints[j].deviation, cxx.linkDeviation[j]);
  }
  ASSERT_EQ(c.contacts.size(), cxx.contacts.size());
  for (std::size_t i = 0; i < c.contacts.size(); ++i) {
    expectSameContact(c.contacts[i], cxx.contacts[i], scene);
  }
  expectSameWay(c, cxx);
}

WholeTick wholeTick(const ft_solid* solid, const ft_solid_tick& tick) {
  return wholeTickOf(AskSolid{solid}, tick);
}

WholeTick wholeTick(const ft_world* world, std::int32_t body) {
  ft_solid_tick tick{};
  tick.size = sizeof tick;
  EXPECT_EQ(ft_solid_world_get_tick(world, body, &tick, nullptr), FT_OK) << ft_last_error();
  return wholeTickOf(AskWorld{world, body}, tick);
}

WholeTick follow(ft_solid* solid, const Pose& tracked, const std::vector<std::uint8_t>* isTracked) {
  const PoseArrays arrays(tracked);
  const ft_pose pose = arrays.view();
  ft_solid_tick tick{};
  tick.size = sizeof tick;
  const std::uint8_t* const flags = isTracked == nullptr ? nullptr : isTracked->data();
  EXPECT_EQ(ft_solid_follow(solid, &pose, flags, 1.0 / 90.0, &tick), FT_OK) << ft_last_error();
  return wholeTick(solid, tick);
}

}  // namespace foretouch::test
