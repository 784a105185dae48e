// Tests tools/world/world_maker.h: where bodies are depends on what a world file says, not on the
// order of its tables. Random worlds, in which who carries whom changes for many at one instant,
// are held against places that are composed by hand, and against themselves in another order.
#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/holds.h"
#include "tests/tools/world/drawn_world.h"
#include "tests/tools/world/small_stage.h"
#include "tools/world/followed_world.h"
#include "tools/world/world_maker.h"

namespace foretouch::test {
namespace {

using tools::BodyPlaces;
using tools::LoadedWorld;

BodyId numberOf(const LoadedWorld& world, const std::string& name) {
  BodyId body = 0;
  while (world.nameOf(body) != name) ++body;
  return body;
}

/// What a replay tells, by names.
std::map<std::string, double> toldOf(const SmallStage& stage, LoadedWorld& world) {
  std::map<std::string, double> told;
  std::map<std::string, int> counts;
  const auto pair = [&](BodyId a, BodyId b) {
    return std::min(world.nameOf(a), world.nameOf(b)) + std::max(world.nameOf(a), world.nameOf(b));
  };
  const auto tell = [&](const std::string& what, const WorldTime& time) {
    told[what + " " + std::to_string(counts[what]++)] = secondsOf(time);
  };
  for (const WorldContact& contact : stage.contactsOf(world)) {
    tell(pair(contact.a.body, contact.b.body) + " " + toString(contact.verdict), contact.time);
  }
  const auto followed =
      tools::followWorld(world, world.beginUs, world.endUs, [&](const auto& stretch) {
        for (const WorldEvent& event : stretch.contacts.events) {
          tell(pair(event.a.body, event.b.body) + " " + toString(event.kind), event.time);
        }
        return true;
      });
  EXPECT_TRUE(followed.ok()) << describe(followed.error());
  return told;
}

TEST(TableOrder, DoesNotCountAndBodiesAreWhereTheFileSays) {
  const SmallStage stage;
  int chains = 0;
  std::size_t told = 0;
  constexpr unsigned kWorlds = 200;
  for (unsigned seed = 0; seed < kWorlds; ++seed) {
    const DrawnWorld drawn(seed, seed % 2 == 0, true);
    chains += drawn.sameInstantChains();
    std::vector<int> order{0, 1, 2, 3, 4, 5};
    auto world = stage.load(drawn.text(order));
    ASSERT_TRUE(world.ok()) << seed << describe(world.error());
    std::mt19937 random(seed);
    std::shuffle(order.begin(), order.end(), random);
    auto other = stage.load(drawn.text(order));
    ASSERT_TRUE(other.ok()) << seed << describe(other.error());
    EXPECT_EQ(world.value().beginUs, other.value().beginUs);
    EXPECT_EQ(world.value().endUs, other.value().endUs);
    const auto stretches = world.value().stretches(), otherStretches = other.value().stretches();
    const BodyPlaces places(stretches), otherPlaces(otherStretches);
    for (int body = 0; body < DrawnWorld::kBodies; ++body) {
      const BodyId here = numberOf(world.value(), DrawnWorld::nameOf(body));
      const BodyId there = numberOf(other.value(), DrawnWorld::nameOf(body));
      for (int quarter = 0; quarter <= 2 * DrawnWorld::kSegments; ++quarter) {
        SCOPED_TRACE(std::to_string(seed) + DrawnWorld::nameOf(body) + std::to_string(quarter));
        const RigidPose found = places.linkAt(here, 0, quarter * 250'000);
        const RigidPose again = otherPlaces.linkAt(there, 0, quarter * 250'000);
        EXPECT_EQ(found.translation, again.translation);
        EXPECT_EQ(found.rotation.coeffs(), again.rotation.coeffs());
        const Eigen::Isometry3d right = drawn.frameAt(body, quarter);
        EXPECT_LT((found.translation - right.translation()).norm(), 1e-9);
        EXPECT_LT((found.rotation.toRotationMatrix() - right.linear()).norm(), 1e-9);
      }
    }
    const auto ofWorld = toldOf(stage, world.value());
    const auto ofOther = toldOf(stage, other.value());
    told += ofWorld.size();
    ASSERT_EQ(ofWorld.size(), ofOther.size()) << seed;
    for (const auto& [what, timeS] : ofWorld) {
      ASSERT_EQ(ofOther.count(what), 1U) << seed << what;
      EXPECT_NEAR(timeS, ofOther.at(what), 1e-9) << seed << what;
    }
  }
  EXPECT_GT(chains, 2 * static_cast<int>(kWorlds));
  EXPECT_GT(told, std::size_t{8} * kWorlds);
}

}  // namespace
}  // namespace foretouch::test
