// Questions to a world in C: the answers are those of the C++ library, bit for bit; and bad input
// is refused by name.
#include "middleware/ask/ask.h"

#include <algorithm>
#include <deque>
#include <foretouch/ask.h>
#include <limits>
#include <string>
#include <vector>

#include "lss/index.h"
#include "tests/bindings/moving_world.h"
#include "tests/middleware/own_body.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::MovingWorld;
using test::Random;

constexpr std::int64_t kEndUs = 50'000;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void copy(const Vector3d& from, double (&to)[3]) {
  std::copy(from.data(), from.data() + 3, to);
}

ft_lss lssOf(const Lss& lss) {
  ft_lss c{};
  copy(lss.a, c.a);
  copy(lss.b, c.b);
  c.radius = lss.radius;
  return c;
}

/// Of C++ as C has it; refers to `parts` and `instants`, which outlive it.
struct InC {
  explicit InC(const AskWhom& given) {
    EXPECT_EQ(ft_ask_whom_init(&whom, sizeof whom), FT_OK);
    for (const AskPart& part : given.only) only.push_back({part.body, part.link, part.object});
    for (const AskPart& part : given.without) {
      without.push_back({part.body, part.link, part.object});
    }
    whom.groups = given.groups;
    whom.asks_still = given.asksStill ? 1 : 0;
    whom.only = only.data();
    whom.only_count = only.size();
    whom.without = without.data();
    whom.without_count = without.size();
  }
  InC(const InC&) = delete;
  InC& operator=(const InC&) = delete;

  ft_question question(const WorldQuestion& given) {
    ft_question c{};
    EXPECT_EQ(ft_question_init(&c, sizeof c), FT_OK);
    c.what = static_cast<std::int32_t>(given.what);
    c.which = static_cast<std::int32_t>(given.which);
    c.shape = lssOf(given.shape);
    copy(given.direction, c.direction);
    c.reach = given.reach;
    c.time_us = given.time.us;
    c.time_fraction = given.time.fraction;
    c.whom = &whom;
    for (const AskInstant& instant : given.instants) {
      instants.push_back({instant.body, 0, instant.time.us, instant.time.fraction});
    }
    c.instants = instants.data();
    c.instant_count = instants.size();
    if (!given.hull.empty()) c.hull = given.hull.front().data();
    c.hull_count = given.hull.size();
    c.solids = given.solids ? 1 : 0;
    return c;
  }

  ft_ask_whom whom{};
  std::vector<ft_ask_part> only, without;
  std::vector<ft_ask_instant> instants;
};

template <typename Told>
void expectSameHit(const WorldHit& hit, const Told& told) {
  EXPECT_EQ(told.is_assumed != 0, hit.isAssumed);
  EXPECT_EQ(told.what.body, hit.what.body);
  EXPECT_EQ(told.what.link, hit.what.link);
  EXPECT_EQ(told.what.lss, hit.what.lss);
  EXPECT_EQ(told.what.triangle, hit.what.triangle);
  EXPECT_EQ(told.what.object, hit.object);
  EXPECT_EQ(told.distance, hit.distance);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(told.what.point[k], hit.what.p_W[k]);
    EXPECT_EQ(told.normal[k], hit.nhat_W[k]);
    EXPECT_EQ(told.weights[k], hit.weights[slotOf(k)]);
  }
}

std::vector<ft_world_hit> hitsOf(const ft_world* world) {
  size_t count = 0;
  EXPECT_EQ(ft_world_hits(world, nullptr, 0, &count), FT_OK) << ft_last_error();
  std::vector<ft_world_hit> hits(count);
  if (count == 0) return hits;
  hits[0].size = sizeof hits[0];
  EXPECT_EQ(ft_world_hits(world, hits.data(), count, &count), FT_OK) << ft_last_error();
  return hits;
}

std::vector<ft_unknown_body> unknownOf(const ft_world* world) {
  size_t count = 0;
  EXPECT_EQ(ft_world_unknown(world, nullptr, 0, &count), FT_OK) << ft_last_error();
  std::vector<ft_unknown_body> bodies(count);
  if (count == 0) return bodies;
  bodies[0].size = sizeof bodies[0];
  EXPECT_EQ(ft_world_unknown(world, bodies.data(), count, &count), FT_OK);
  return bodies;
}

/// Two restless bodies, a door that swings, a still one; a third body that is silent at the end.
struct Hall {
  explicit Hall(std::uint64_t seed) : random(seed), still(test::doorScene()), world(1e-4, &still) {
    for (int i = 0; i < 3; ++i) {
      const test::OwnBody made = test::randomOwnBody(random);
      BodyOptions options;
      options.group = i;
      options.whenSilent = i == 2 ? WhenSilent::Undecided : WhenSilent::Wait;
      const BodyId body = world.add(made.avatar, options);
      Pose poses[2] = {made.steps.from, made.steps.to};
      for (Pose& pose : poses) pose.translations[0] = random.inBox(0.6);
      world.push(body, 0, poses[0]);
      world.push(body, i == 2 ? kEndUs / 2 : kEndUs, poses[1]);
    }
    const BodyId door = world.add(test::doorScene());
    world.push(door, 0, test::doorPose(0.0, {-0.3, -1, 0}));
    world.push(door, kEndUs, test::doorPose(1.0, {-0.3, -1, 0}));
  }

  Random random;
  RawScene still;
  MovingWorld world;
  Scratch scratch;

  void drawWhom(AskWhom& whom) {
    if (random.chance(0.2)) whom.groups = 0b101;
    whom.asksStill = random.chance(0.8);
    if (random.chance(0.2)) whom.only = {{random.below(4), kEveryLink, kEveryObject}};
    if (random.chance(0.2)) whom.without = {{kStillScene, kEveryLink, random.below(2)}};
  }
  Lss drawShape() {
    const Vector3d from = random.inBox(2.0);
    return {from, random.chance(0.5) ? from : from + random.inBox(0.3),
            random.chance(0.4) ? 0.0 : random.magnitude(1e-3, 0.2)};
  }
  WorldQuestion drawQuestion() {
    WorldQuestion question;
    question.what = static_cast<AskWhat>(random.below(3));
    question.which = static_cast<AskWhich>(random.below(3));
    question.shape = drawShape();
    if (random.chance(0.3)) {
      question.shape.b = question.shape.a;
      question.hull = boxCorners(Vector3d(0.1, 0.2, 0.3), random.rotation());
    }
    question.solids = random.chance(0.3);
    question.direction = random.inBox(0.5) - question.shape.a;
    question.reach = random.magnitude(0.1, 10.0);
    question.time = {drawUs(), 0.25};
    if (random.chance(0.3)) question.instants = {{1, {drawUs(), 0.5}}};
    drawWhom(question);
    return question;
  }
  std::int64_t drawUs() { return random.below(static_cast<int>(kEndUs)); }
};

TEST(CAskSkin, IsMetAsItIsBentAndRefusedByName) {
  RawSkeleton raw;
  raw.joints = {{"root", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const Avatar ball =
      Avatar::build(Skeleton::build(raw).value(), {{{Vector3d::Zero(), Vector3d::Zero(), 0.1}}})
          .value();
  const test::AvatarHandle avatar = test::makeAvatar(ball);
  // A sheet of one triangle that follows the root.
  const std::int32_t first[] = {0, 1, 2, 3}, links[] = {0, 0, 0}, triangle[] = {0, 1, 2},
                     owner[] = {0};
  const double weights[] = {1, 1, 1}, points[] = {-5, -5, 3, 5, -5, 3, 0, 5, 3};
  ft_skin skin{};
  skin.size = sizeof skin;
  skin.vertex_count = 3;
  skin.first_share = first;
  skin.share_links = links;
  skin.share_weights = weights;
  skin.share_points = points;
  skin.triangles = triangle;
  skin.triangle_links = owner;
  skin.triangle_count = 1;
  ASSERT_EQ(ft_avatar_set_skin(avatar.get(), &skin), FT_OK) << ft_last_error();
  const auto world = test::makeWorld();
  std::int32_t body = -1;
  ASSERT_EQ(ft_world_add_avatar(world.get(), avatar.get(), nullptr, &body), FT_OK);
  const double rotation[] = {1, 0, 0, 0}, translation[] = {0, 0, 0};
  ft_pose pose{};
  pose.size = sizeof pose;
  pose.joint_count = 1;
  pose.rotations = rotation;
  pose.translations = translation;
  ASSERT_EQ(ft_world_push(world.get(), body, 0, &pose), FT_OK) << ft_last_error();
  ft_question question{};
  ASSERT_EQ(ft_question_init(&question, sizeof question), FT_OK);
  question.shape.a[2] = question.shape.b[2] = 10.0;
  question.direction[2] = -1.0;
  question.reach = 50.0;
  std::int32_t verdict = -1;
  ASSERT_EQ(ft_world_probe(world.get(), &question, &verdict), FT_OK) << ft_last_error();
  ASSERT_EQ(verdict, FT_ASK_HIT);
  ft_world_hit hit{};
  hit.size = sizeof hit;
  ASSERT_EQ(ft_world_hits(world.get(), &hit, 1, nullptr), FT_OK);
  EXPECT_NEAR(hit.distance, 7.0, 1e-9);
  EXPECT_EQ(hit.what.triangle, 0);
  const std::int32_t none[] = {0, 1, 1, 3}, far[] = {99}, corner[] = {0, 1, 7};
  ft_skin bad = skin;
  bad.first_share = none;
  test::expectRefused(ft_avatar_set_skin(avatar.get(), &bad), FT_ERROR_OUT_OF_RANGE,
                      {"first_share"});
  bad = skin;
  bad.triangle_links = far;
  test::expectRefused(ft_avatar_set_skin(avatar.get(), &bad), FT_ERROR_OUT_OF_RANGE,
                      {"triangle_links", "99"});
  bad = skin;
  bad.triangles = corner;
  test::expectRefused(ft_avatar_set_skin(avatar.get(), &bad), FT_ERROR_OUT_OF_RANGE, {"vertices"});
  bad = skin;
  bad.share_weights = nullptr;
  test::expectRefused(ft_avatar_set_skin(avatar.get(), &bad), FT_ERROR_NULL_ARGUMENT,
                      {"share_weights"});
}

TEST(CAsk, AnswersAreThoseOfTheLibrary) {
  int hits = 0, clear = 0, unknown = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Hall hall(seed);
    for (int i = 0; i < 60; ++i) {
      const WorldQuestion question = hall.drawQuestion();
      WorldAnswer expected;
      ASSERT_TRUE(askWorld(hall.world.cxx, question, hall.scratch, expected).ok());
      InC inC(question);
      const ft_question given = inC.question(question);
      std::int32_t verdict = -1;
      ASSERT_EQ(ft_world_probe(hall.world.c.get(), &given, &verdict), FT_OK) << ft_last_error();
      EXPECT_EQ(verdict, static_cast<std::int32_t>(expected.verdict()));
      const auto found = hitsOf(hall.world.c.get());
      ASSERT_EQ(found.size(), expected.hits.size());
      for (std::size_t k = 0; k < found.size(); ++k) expectSameHit(expected.hits[k], found[k]);
      const auto bodies = unknownOf(hall.world.c.get());
      ASSERT_EQ(bodies.size(), expected.unknown.size());
      for (std::size_t k = 0; k < bodies.size(); ++k) {
        EXPECT_EQ(bodies[k].body, expected.unknown[k].body);
        EXPECT_EQ(bodies[k].why, static_cast<std::int32_t>(expected.unknown[k].why));
        EXPECT_EQ(bodies[k].object, expected.unknown[k].object);
      }
      hits += verdict == FT_ASK_HIT;
      clear += verdict == FT_ASK_CLEAR;
      unknown += verdict == FT_ASK_UNKNOWN;
    }
  }
  EXPECT_GT(hits, 50);
  EXPECT_GT(clear, 50);
  EXPECT_GT(unknown, 10);
}

// In any order of instants; but for some hit of many, which may be another one.
TEST(CAsk, ManyQuestionsHaveTheAnswersOfEachAlone) {
  int hits = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Hall hall(seed);
    ft_world* const world = hall.world.c.get();
    std::vector<WorldQuestion> questions;
    std::deque<InC> inC;
    std::vector<ft_question> given;
    for (int i = 0; i < 80; ++i) {
      WorldQuestion question = hall.drawQuestion();
      if (question.which == AskWhich::Any) question.which = AskWhich::All;
      if (i > 0 && hall.random.chance(0.5)) question.time = questions.front().time;
      questions.push_back(question);
    }
    for (const WorldQuestion& question : questions) {
      given.push_back(inC.emplace_back(question).question(question));
    }
    std::vector<ft_probed> probed(given.size());
    ASSERT_EQ(ft_world_probe_many(world, given.data(), given.size(), probed.data()), FT_OK)
        << ft_last_error();
    const auto allHits = hitsOf(world);
    const auto allUnknown = unknownOf(world);
    std::size_t hit = 0, unknown = 0;
    for (std::size_t i = 0; i < given.size(); ++i) {
      WorldAnswer expected;
      Scratch scratch;
      ASSERT_TRUE(askWorld(hall.world.cxx, questions[i], scratch, expected).ok());
      EXPECT_EQ(probed[i].verdict, static_cast<std::int32_t>(expected.verdict()));
      ASSERT_EQ(probed[i].hit_count, expected.hits.size());
      ASSERT_EQ(probed[i].unknown_count, expected.unknown.size());
      for (const WorldHit& one : expected.hits) expectSameHit(one, allHits[hit++]);
      for (const UnknownBody& one : expected.unknown) {
        EXPECT_EQ(allUnknown[unknown++].body, one.body);
      }
    }
    EXPECT_EQ(hit, allHits.size());
    EXPECT_EQ(unknown, allUnknown.size());
    hits += static_cast<int>(hit);
    given[7].reach = kNone;
    given[7].what = FT_ASK_CAST;
    EXPECT_EQ(ft_world_probe_many(world, given.data(), given.size(), probed.data()),
              FT_ERROR_NON_FINITE);
    EXPECT_NE(std::string(ft_last_error()).find("question 7"), std::string::npos)
        << ft_last_error();
    EXPECT_EQ(hitsOf(world).size(), allHits.size());
  }
  EXPECT_GT(hits, 100);
}

TEST(CAsk, FlightsAreThoseOfTheLibrary) {
  int hits = 0, others = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Hall hall(seed);
    for (int i = 0; i < 20; ++i) {
      FlightQuestion question;
      question.shape = hall.drawShape();
      if (hall.random.chance(0.3)) {
        question.shape.b = question.shape.a;
        question.hull = boxCorners(Vector3d(0.1, 0.2, 0.3), hall.random.rotation());
      }
      question.way = hall.random.inBox(0.5) - question.shape.a;
      question.fromUs = hall.random.below(20'000);
      question.toUs = question.fromUs + 1 + hall.random.below(20'000);
      hall.drawWhom(question);
      FlightAnswer expected;
      ASSERT_TRUE(askFlight(hall.world.cxx, question, hall.scratch, expected).ok());
      const InC inC(question);
      ft_flight flight{};
      ASSERT_EQ(ft_flight_init(&flight, sizeof flight), FT_OK);
      flight.shape = lssOf(question.shape);
      copy(question.way, flight.way);
      flight.from_us = question.fromUs;
      flight.to_us = question.toUs;
      flight.whom = &inC.whom;
      if (!question.hull.empty()) flight.hull = question.hull.front().data();
      flight.hull_count = question.hull.size();
      ft_flight_hit hit{};
      hit.size = sizeof hit;
      ASSERT_EQ(ft_world_fly(hall.world.c.get(), &flight, &hit), FT_OK) << ft_last_error();
      EXPECT_EQ(hit.verdict, static_cast<std::int32_t>(expected.verdict()));
      EXPECT_EQ(unknownOf(hall.world.c.get()).size(), expected.unknown.size());
      expected.first ? ++hits : ++others;
      if (!expected.first) continue;
      EXPECT_EQ(hit.time_us, expected.first->time.us);
      EXPECT_EQ(hit.time_fraction, expected.first->time.fraction);
      expectSameHit(expected.first->hit, hit);
    }
  }
  EXPECT_GT(hits, 20);
  EXPECT_GT(others, 20);
}

TEST(CAsk, WhatIsWrongIsRefusedByNameAndLeavesTheLastAnswer) {
  Hall hall(3);
  ft_world* const world = hall.world.c.get();
  EXPECT_EQ(ft_world_hits(world, nullptr, 0, nullptr), FT_ERROR_NO_STEP);
  EXPECT_EQ(ft_world_unknown(world, nullptr, 0, nullptr), FT_ERROR_NO_STEP);
  ft_question question{};
  ASSERT_EQ(ft_question_init(&question, sizeof question), FT_OK);
  question.direction[0] = 1.0;
  question.reach = 1.0;
  ASSERT_EQ(ft_world_probe(world, &question, nullptr), FT_OK) << ft_last_error();
  const std::size_t before = hitsOf(world).size();
  const auto refused = [&](const auto& change, ft_status status, const char* name) {
    ft_question bad = question;
    change(bad);
    EXPECT_EQ(ft_world_probe(world, &bad, nullptr), status) << name;
    EXPECT_NE(std::string(ft_last_error()).find(name), std::string::npos) << ft_last_error();
    EXPECT_EQ(hitsOf(world).size(), before);
  };
  refused([](ft_question& q) { q.what = 3; }, FT_ERROR_OUT_OF_RANGE, "what");
  refused([](ft_question& q) { q.which = -1; }, FT_ERROR_OUT_OF_RANGE, "which");
  refused([](ft_question& q) { q.direction[0] = 0.0; }, FT_ERROR_OUT_OF_RANGE, "direction");
  refused([](ft_question& q) { q.direction[1] = kNone; }, FT_ERROR_NON_FINITE, "direction");
  refused([](ft_question& q) { q.reach = 0.0; }, FT_ERROR_OUT_OF_RANGE, "reach");
  refused([](ft_question& q) { q.shape.a[2] = kNone; }, FT_ERROR_NON_FINITE, "shape");
  refused([](ft_question& q) { q.shape.radius = -1.0; }, FT_ERROR_OUT_OF_RANGE, "shape");
  refused([](ft_question& q) { q.time_fraction = 1.0; }, FT_ERROR_OUT_OF_RANGE, "time");
  refused([](ft_question& q) { q.hull_count = 4; }, FT_ERROR_NULL_ARGUMENT, "hull");
  const double corners[6] = {0, 0, 0, 1, kNone, 0};
  refused([&](ft_question& q) { q.hull = corners, q.hull_count = 2; }, FT_ERROR_NON_FINITE, "hull");
  refused([&](ft_question& q) { q.hull = corners, q.hull_count = 1, q.shape.b[0] = 1.0; },
          FT_ERROR_MISMATCH, "shape");
  refused([](ft_question& q) { q.solids = 2; }, FT_ERROR_OUT_OF_RANGE, "solids");
  refused([](ft_question& q) { q.instant_count = 1; }, FT_ERROR_NULL_ARGUMENT, "instants");
  ft_ask_whom whom{};
  ASSERT_EQ(ft_ask_whom_init(&whom, sizeof whom), FT_OK);
  const ft_ask_part nobody{7, FT_EVERY_LINK, FT_EVERY_OBJECT};
  whom.only = &nobody;
  whom.only_count = 1;
  refused([&](ft_question& q) { q.whom = &whom; }, FT_ERROR_UNKNOWN_NAME, "only");
  whom.only_count = 0;
  whom.asks_still = 2;
  refused([&](ft_question& q) { q.whom = &whom; }, FT_ERROR_OUT_OF_RANGE, "asks_still");
  ft_flight flight{};
  ASSERT_EQ(ft_flight_init(&flight, sizeof flight), FT_OK);
  ft_flight_hit hit{};
  hit.size = sizeof hit;
  EXPECT_EQ(ft_world_fly(world, &flight, &hit), FT_ERROR_OUT_OF_RANGE);  // a time without length
  EXPECT_EQ(ft_world_fly(world, &flight, nullptr), FT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(ft_world_probe(nullptr, &question, nullptr), FT_ERROR_NULL_ARGUMENT);
}

}  // namespace
}  // namespace foretouch
