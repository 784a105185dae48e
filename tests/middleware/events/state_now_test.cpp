// What is in contact now, since when and how deep, beside the events: the follower's open parts,
// and World::depth() at the instant up to which it has followed.
#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/depth/depth.h"
#include "middleware/events/world_follower.h"
#include "tests/middleware/world/random_worlds.h"

namespace foretouch {
namespace {

using test::BothWorlds;
using test::Random;

using Pair = std::tuple<BodyId, LinkId, BodyId, LinkId>;

constexpr double kTolerance = 1e-3;

/// Entered and not left, by the events alone.
struct ByEvents {
  std::map<Pair, WorldTime> since;

  void take(const WorldEvents& told) {
    for (const WorldEvent& event : told.events) {
      const Pair pair{event.a.body, event.a.link, event.b.body, event.b.link};
      const bool begins = event.kind == EventKind::Enter || event.kind == EventKind::StartsInside;
      if (begins) since[pair] = event.time;
      if (event.kind == EventKind::Leave) since.erase(pair);
    }
  }
};

// At every instant at which somebody looks: who is open is who entered and has not left, since
// then; who is in somebody by more than the tolerance is open; and who is open is no farther than
// twice the tolerance.
TEST(StateNow, AgreesWithTheEventsAndWithTheDepthAtEveryInstant) {
  int open = 0, deep = 0, looked = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    BothWorlds both(kTolerance);
    std::vector<test::Walker> walkers;
    for (int i = 0; i < 3; ++i) {
      walkers.push_back(test::randomWalker(random, random.inBox(0.3), 0.1));
      const BodyId body = both.add(walkers.back().avatar);
      test::walk(both, body, walkers.back(), test::randomPeriod(random), test::kWindowUs, random);
    }
    WorldFollower follower = WorldFollower::start(0).value();
    ByEvents events;
    WorldEvents told;
    for (std::int64_t us = 0; us < test::kWindowUs; us += 1 + random.below(20'000)) {
      ASSERT_TRUE(follower.follow(both.world, us, told).ok());
      events.take(told);
      const WorldTime now{follower.followedUntilUs(), 0.0};
      std::map<Pair, WorldTime> state;
      for (const OpenPart& part : follower.open()) {
        ASSERT_EQ(part.kind, PartKind::Contact);
        state[{part.a.body, part.a.link, part.b.body, part.b.link}] = part.since;
      }
      ASSERT_EQ(state, events.since);
      for (BodyId a = 0; us > 0 && a < 3; ++a) {
        for (BodyId b = a + 1; b < 3; ++b) {
          for (LinkId i = 0; i < walkers[slotOf(a)].avatar.numLinks(); ++i) {
            for (LinkId j = 0; j < walkers[slotOf(b)].avatar.numLinks(); ++j) {
              const auto depth = both.world.depth(now, {a, i, b, j}, both.scratch);
              ASSERT_TRUE(depth.ok());
              const bool isOpen = state.count({a, i, b, j}) + state.count({b, j, a, i}) > 0;
              const double apart = static_cast<double>(
                  both.oracle.separationAt(a, i, b, j, 0, static_cast<test::Real>(now.us)));
              // Overlaps have no separation above 0: the judge's is then 0 or less.
              if (depth.value().depth.lower > 1e-9) {
                EXPECT_TRUE(isOpen) << a << '.' << i << ' ' << b << '.' << j << " at " << now.us;
                ++deep;
              }
              if (isOpen) {
                EXPECT_LE(apart, 2.0 * kTolerance + 1e-9);
                ++open;
              }
              ++looked;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(open, 200);
  EXPECT_GT(deep, 100);
  EXPECT_GT(looked, 10 * open);
}

}  // namespace
}  // namespace foretouch
