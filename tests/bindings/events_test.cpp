// What happens in a moving world, in C: events, parts and what is open are those of the C++
// library, bit for bit; so are depths and impulses; and bad input is refused by name.
#include <array>
#include <cmath>
#include <foretouch/events.h>
#include <foretouch/mechanics.h>
#include <foretouch/triggers.h>
#include <limits>
#include <string>
#include <vector>

#include "lss/index.h"
#include "middleware/depth/depth.h"
#include "middleware/events/world_follower.h"
#include "middleware/mechanics/mass.h"
#include "tests/bindings/moving_world.h"
#include "tests/bindings/same_answers.h"
#include "tests/middleware/own_body.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::MovingWorld;
using test::Random;

std::vector<ft_event> eventsOf(const ft_world* world) {
  return test::listed<ft_event>([&](ft_event* events, std::size_t room, std::size_t* required) {
    return ft_world_events(world, events, room, required);
  });
}

std::vector<ft_part> partsOf(const ft_world* world) {
  return test::listed<ft_part>([&](ft_part* parts, std::size_t room, std::size_t* required) {
    return ft_world_parts(world, parts, room, required);
  });
}

std::vector<ft_part> openOf(const ft_world* world) {
  return test::listed<ft_part>([&](ft_part* parts, std::size_t room, std::size_t* required) {
    return ft_world_open_parts(world, parts, room, required);
  });
}

Vector3d vectorOf(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

void expectSameSide(const ft_world_side& c, const ContactSide& cxx) {
  EXPECT_EQ(c.body, cxx.body);
  EXPECT_EQ(c.link, cxx.link);
  EXPECT_EQ(c.lss, cxx.lss);
  EXPECT_EQ(c.triangle, cxx.triangle);
  EXPECT_EQ(vectorOf(c.point), cxx.p_W);
}

void expectSame(const ft_event& c, const WorldEvent& cxx) {
  EXPECT_EQ(c.size, sizeof c);
  EXPECT_EQ(c.kind, static_cast<int>(cxx.kind));
  EXPECT_EQ(c.cause, static_cast<int>(cxx.cause));
  EXPECT_EQ(c.reason, static_cast<int>(cxx.reason));
  EXPECT_EQ(c.time_us, cxx.time.us);
  EXPECT_EQ(c.time_fraction, cxx.time.fraction);
  EXPECT_EQ(c.since_us, cxx.since.us);
  EXPECT_EQ(c.since_fraction, cxx.since.fraction);
  EXPECT_EQ(c.separation, cxx.separation);
  test::expectSameDepth(c.penetration, cxx.kind == EventKind::StartsInside, cxx.penetration);
  EXPECT_EQ(vectorOf(c.normal), cxx.nhat_BA_W);
  EXPECT_EQ(vectorOf(c.velocity), cxx.velocity_W);
  EXPECT_EQ(c.approach_speed, cxx.approachSpeed);
  EXPECT_EQ(c.approach_lower, cxx.approachLower);
  EXPECT_EQ(c.approach_upper, cxx.approachUpper);
  EXPECT_EQ(c.effective_mass, cxx.effectiveMass);
  EXPECT_EQ(c.is_assumed, cxx.isAssumed ? 1 : 0);
  expectSameSide(c.a, cxx.a);
  expectSameSide(c.b, cxx.b);
  ASSERT_EQ(static_cast<std::size_t>(c.point_count), cxx.numPoints);
  for (std::size_t i = 0; i < cxx.numPoints; ++i) {
    EXPECT_EQ(vectorOf(c.points[i].point_a), cxx.points[i].p_WA);
    EXPECT_EQ(vectorOf(c.points[i].point_b), cxx.points[i].p_WB);
    EXPECT_EQ(c.points[i].separation, cxx.points[i].separation);
  }
}

void expectSame(const ft_part& c, const WorldPart& cxx) {
  EXPECT_EQ(c.is_contact, cxx.kind == PartKind::Contact ? 1 : 0);
  EXPECT_EQ(c.reason, static_cast<int>(cxx.reason));
  EXPECT_EQ(c.is_assumed, cxx.isAssumed ? 1 : 0);
  EXPECT_EQ(c.began_before, cxx.beganBefore ? 1 : 0);
  EXPECT_EQ(c.goes_on, cxx.goesOn ? 1 : 0);
  EXPECT_EQ(c.from_us, cxx.from.us);
  EXPECT_EQ(c.from_fraction, cxx.from.fraction);
  EXPECT_EQ(c.to_us, cxx.to.us);
  EXPECT_EQ(c.to_fraction, cxx.to.fraction);
  EXPECT_EQ(c.since_us, cxx.since.us);
  EXPECT_EQ(c.since_fraction, cxx.since.fraction);
  expectSameSide(c.a, cxx.a);
  expectSameSide(c.b, cxx.b);
}

/// Follows both, and expects the same of all that they tell. Returns how many events there were.
std::size_t followBoth(MovingWorld& world, WorldFollower& follower, std::int64_t untilUs) {
  WorldEvents answer;
  EXPECT_TRUE(follower.follow(world.cxx, untilUs, answer).ok());
  EXPECT_EQ(ft_world_follow(world.c.get(), untilUs), FT_OK) << ft_last_error();
  std::int64_t from = 0, until = 0;
  EXPECT_EQ(ft_world_followed(world.c.get(), &from, &until), FT_OK);
  EXPECT_EQ(from, answer.fromUs);
  EXPECT_EQ(until, answer.toUs);
  const auto events = eventsOf(world.c.get());
  EXPECT_EQ(events.size(), answer.events.size());
  for (std::size_t i = 0; i < std::min(events.size(), answer.events.size()); ++i) {
    SCOPED_TRACE("event " + std::to_string(i));
    expectSame(events[i], answer.events[i]);
  }
  const auto parts = partsOf(world.c.get());
  EXPECT_EQ(parts.size(), answer.parts.size());
  for (std::size_t i = 0; i < std::min(parts.size(), answer.parts.size()); ++i) {
    SCOPED_TRACE("part " + std::to_string(i));
    expectSame(parts[i], answer.parts[i]);
  }
  const auto open = openOf(world.c.get());
  EXPECT_EQ(open.size(), follower.open().size());
  for (std::size_t i = 0; i < std::min(open.size(), follower.open().size()); ++i) {
    EXPECT_EQ(open[i].since_us, follower.open()[i].since.us);
    EXPECT_EQ(open[i].since_fraction, follower.open()[i].since.fraction);
    expectSameSide(open[i].a, follower.open()[i].a);
    expectSameSide(open[i].b, follower.open()[i].b);
  }
  return events.size();
}

/// Restless bodies in and out of each other, a door and what stands still: some are weighed.
TEST(CEvents, AreThoseOfTheLibrary) {
  std::size_t events = 0, depths = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("case " + std::to_string(seed));
    Random random(seed);
    const RawScene still = test::doorScene();
    MovingWorld world(random.magnitude(1e-5, 1e-3), &still);
    std::vector<std::array<Pose, 2>> poses;
    for (int i = 0; i < 3; ++i) {
      const test::OwnBody made = test::randomOwnBody(random);
      poses.push_back({made.steps.from, made.steps.to});
      for (Pose& pose : poses.back()) pose.translations[0] = random.inBox(0.4);
      world.add(made.avatar, {}, random.chance(0.5));
    }
    const BodyId door = world.add(test::doorScene());
    FollowOptions options;
    options.cutUs = random.chance(0.5) ? 0 : 20'000;
    ft_follow_options ofC = test::initialised(ft_follow_options_init);
    ofC.cut_us = options.cutUs;
    ofC.threads = random.chance(0.5) ? 1 : 2;
    WorldFollower follower = WorldFollower::start(5'000, options).value();
    ASSERT_EQ(ft_world_follow_from(world.c.get(), 5'000, &ofC), FT_OK) << ft_last_error();
    const Mass mass =
        checkedMass({12.0, {0.45, 1.0, 0.0}, Vector3d(4.0, 1.0, 5.0).asDiagonal()}).value();
    const double center[3] = {0.45, 1.0, 0.0}, inertia[9] = {4, 0, 0, 0, 1, 0, 0, 0, 5};
    ASSERT_TRUE(follower.weigh(door, mass).ok());
    ASSERT_EQ(ft_world_weigh(world.c.get(), door, 12.0, center, inertia), FT_OK) << ft_last_error();
    for (std::int64_t k = 0; k < 6; ++k) {
      for (BodyId body = 0; body < 3; ++body) {
        world.push(body, 10'000 * k + 1'000 * body,
                   poses[slotOf(body)][slotOf(static_cast<std::int32_t>(k % 2))]);
      }
      world.push(door, 10'000 * k, test::doorPose(0.3 * static_cast<double>(k), {-0.3, -1, 0}));
    }
    for (const std::int64_t until : {20'000, 20'000, 33'000, 50'000}) {
      events += followBoth(world, follower, until);
    }
    for (const BodyId other : {1, 2}) {
      const DepthQuestion question{0, kEveryLink, other, kEveryLink};
      ft_depth_question asked{};
      asked.size = sizeof asked;
      asked.body = 0;
      asked.link = asked.from_link = FT_EVERY_LINK;
      asked.from_body = other;
      asked.time_us = 31'234;
      asked.time_fraction = 0.25;
      ft_depth found{};
      found.size = sizeof found;
      Scratch scratch;
      const auto cxx = world.cxx.depth({31'234, 0.25}, question, scratch);
      ASSERT_TRUE(cxx.ok());
      ASSERT_EQ(ft_world_depth(world.c.get(), &asked, &found), FT_OK) << ft_last_error();
      EXPECT_EQ(found.lower, cxx.value().depth.lower);
      EXPECT_EQ(found.upper, cxx.value().depth.upper);
      EXPECT_EQ(found.is_certified, cxx.value().depth.isCertified ? 1 : 0);
      EXPECT_EQ(vectorOf(found.way_out), cxx.value().depth.wayOut);
      depths += found.lower > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(events, 200U);
  EXPECT_GT(depths, 3U);
}

TEST(CMechanics, IsThatOfTheLibrary) {
  Random random(3);
  int sliding = 0, sticking = 0;
  for (int i = 0; i < 2'000; ++i) {
    const double kg = random.magnitude(0.1, 50.0);
    Mass mass;
    mass.kg = kg;
    mass.center_B = random.inBox(0.5);
    mass.inertia_B = (kg * Vector3d(0.4, 0.5, 0.6)).asDiagonal();
    const Quaternion q = Quaternion(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                    random.uniform(-1.0, 1.0), random.uniform(0.1, 1.0))
                             .normalized();
    const RigidPose pose{q, random.inBox(2.0)};
    const Vector3d point = random.inBox(2.0);
    const Eigen::Matrix3d inverse = inverseMassAt(mass, pose, point);
    double ofC[9];
    const double rotation[4] = {q.w(), q.x(), q.y(), q.z()};
    std::array<double, 9> inertia{};
    for (int k = 0; k < 3; ++k) inertia[static_cast<std::size_t>(4 * k)] = mass.inertia_B(k, k);
    ASSERT_EQ(ft_inverse_mass_at(kg, mass.center_B.data(), inertia.data(), rotation,
                                 pose.translation.data(), point.data(), ofC),
              FT_OK)
        << ft_last_error();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        EXPECT_EQ(ofC[3 * row + column], inverse(row, column));
    }
    ContactMaterial material;
    CollisionPoint met;
    met.nhat_BA_W = random.inBox(1.0).normalized();
    met.velocity_W = random.inBox(3.0);
    met.inverseMass_W = inverse;
    material.restitution = random.uniform(0.0, 1.0);
    material.friction = random.uniform(0.0, 1.5);
    const CollisionImpulse expected = collisionImpulse(met, material);
    ft_collision_point given{};
    given.size = sizeof given;
    Eigen::Map<Vector3d>(given.normal) = met.nhat_BA_W;
    Eigen::Map<Vector3d>(given.velocity) = met.velocity_W;
    for (int k = 0; k < 9; ++k) given.inverse_mass[k] = ofC[k];
    given.restitution = material.restitution;
    given.friction = material.friction;
    ft_collision_impulse found{};
    found.size = sizeof found;
    ASSERT_EQ(ft_collide(&given, &found), FT_OK) << ft_last_error();
    EXPECT_EQ(vectorOf(found.on_a), expected.onA_W);
    sliding += found.sticks == 0 && vectorOf(found.on_a).norm() > 0.0 ? 1 : 0;
    sticking += found.sticks;
  }
  EXPECT_GT(sliding, 100);
  EXPECT_GT(sticking, 100);
}

TEST(CEvents, RefuseBadInputByName) {
  MovingWorld both;
  ft_world* const world = both.c.get();
  const auto refuses = [](ft_status status, ft_status expected, const std::string& words) {
    EXPECT_EQ(status, expected) << ft_last_error();
    EXPECT_NE(std::string(ft_last_error()).find(words), std::string::npos) << ft_last_error();
  };
  const double center[3] = {0, 0, 0}, inertia[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::size_t required = 0;
  refuses(ft_world_follow(world, 1), FT_ERROR_NO_STEP, "ft_world_follow_from()");
  refuses(ft_world_weigh(world, 0, 1.0, center, inertia), FT_ERROR_NO_STEP,
          "ft_world_follow_from()");
  ft_follow_options options = test::initialised(ft_follow_options_init);
  options.threads = 0;
  refuses(ft_world_follow_from(world, 0, &options), FT_ERROR_OUT_OF_RANGE, "threads");
  options.threads = 1;
  options.cut_us = -1;
  refuses(ft_world_follow_from(world, 0, &options), FT_ERROR_OUT_OF_RANGE, "cut_us");
  ASSERT_EQ(ft_world_follow_from(world, 0, nullptr), FT_OK);
  refuses(ft_world_events(world, nullptr, 0, &required), FT_ERROR_NO_STEP, "ft_world_follow()");
  refuses(ft_world_parts(world, nullptr, 0, &required), FT_ERROR_NO_STEP, "ft_world_follow()");
  refuses(ft_world_weigh(world, 0, 1.0, center, inertia), FT_ERROR_UNKNOWN_NAME, "body");
  Random random(1);
  const BodyId many = both.add(test::randomOwnBody(random).avatar);
  EXPECT_NE(ft_world_weigh(world, many, 1.0, center, inertia), FT_OK);
  EXPECT_NE(ft_world_weigh_avatar(world, many, -1.0), FT_OK);
  EXPECT_NE(ft_world_weigh_avatar(world, many, std::numeric_limits<double>::quiet_NaN()), FT_OK);
  EXPECT_EQ(ft_world_weigh_avatar(world, many, 60.0), FT_OK) << ft_last_error();
}

}  // namespace
}  // namespace foretouch
