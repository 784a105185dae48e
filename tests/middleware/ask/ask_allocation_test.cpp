// Questions allocate nothing once a thread's memory has grown. Of a program that counts the calls
// of malloc.
#include <vector>

#include <gtest/gtest.h>

#include "middleware/ask/ask.h"
#include "tests/middleware/random_scene.h"
#include "tests/middleware/world/random_worlds.h"
#include "tests/support/allocation_count.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

TEST(AskAllocations, StopOnceTheMemoryHasGrown) {
  if (!test::countsAllocations()) GTEST_SKIP() << "this build has an allocator of its own";
  test::Random random(3);
  test::BothWorlds both(Scene::build(test::clutter(random, 50, 3, Vector3d::Zero())).value(), {});
  for (int i = 0; i < 4; ++i) {
    test::Walker walker = test::randomWalker(random, random.inBox(0.8), 0.02);
    BodyOptions options;
    if (i == 0) options.surface = test::randomSurface(walker.avatar, random);
    test::walk(both, both.add(walker.avatar, options), walker, 11'111, test::kWindowUs, random);
  }
  test::fly(both, both.add(test::randomMesh(random)), Vector3d::Zero(), 8'333, test::kWindowUs,
            random);
  std::vector<WorldQuestion> questions;
  std::vector<FlightQuestion> flights;
  for (int i = 0; i < 40; ++i) {
    const Vector3d from = random.inBox(2.0), to = random.inBox(0.5);
    const WorldTime time{random.below(100'000), 0.25};
    questions.push_back(WorldQuestion::ray(from, to - from, 5.0, time));
    questions.back().which = static_cast<AskWhich>(i % 3);
    questions.push_back(WorldQuestion::cast({from, to, 0.1}, to - from, 2.0, time));
    questions.push_back(WorldQuestion::overlap({to, from, 0.2}, time));
    questions.push_back(WorldQuestion::nearest({to, to, 0.0}, 1.0, time));
    questions.back().instants = {{i % 4, {random.below(100'000), 0.0}}};
    FlightQuestion flight;
    flight.shape = {from, from, 0.05};
    flight.way = to - from;
    flight.fromUs = random.below(50'000);
    flight.toUs = flight.fromUs + 30'000;
    flights.push_back(flight);
  }
  Scratch scratch;
  WorldAnswer answer;
  FlightAnswer hit;
  std::uint64_t before = 0;
  int hits = 0;
  for (int round = 0; round < 3; ++round) {
    before = test::numAllocations();
    for (const WorldQuestion& question : questions) {
      ASSERT_TRUE(askWorld(both.world, question, scratch, answer).ok());
      hits += answer.hits.empty() ? 0 : 1;
    }
    for (const FlightQuestion& flight : flights) {
      ASSERT_TRUE(askFlight(both.world, flight, scratch, hit).ok());
      hits += hit.first ? 1 : 0;
    }
  }
  EXPECT_EQ(test::numAllocations() - before, 0U);
  EXPECT_GT(hits, 200);
}

}  // namespace
}  // namespace foretouch
