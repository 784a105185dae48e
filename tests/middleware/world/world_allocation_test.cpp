// Windows of a world allocate nothing once everything has grown. A program of its own: it counts
// the calls of malloc.
#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/world/world.h"
#include "tests/middleware/own_body.h"
#include "tests/support/allocation_count.h"

namespace foretouch {
namespace {

using test::Random;

/// Four random bodies that go to and fro with clocks of their own, and a mesh that stands still.
class Crowd {
 public:
  Crowd() : world_(World::build(test::farScene()).value()) {
    Random random(3);
    for (BodyId body = 0; body < 4; ++body) {
      const test::OwnBody made = test::randomOwnBody(random);
      BodyOptions options;
      if (const auto rules = PairRules::derive(made.avatar); rules.ok()) {
        options.self = rules.value();
      }
      EXPECT_TRUE(world_.add(made.avatar, options).ok());
      poses_.push_back({made.steps.from, made.steps.to});
      poses_.back()[0].translations[0] = random.inBox(0.2);
      poses_.back()[1].translations[0] = random.inBox(0.2);
    }
    EXPECT_TRUE(world_.add(test::farScene()).ok());
  }

  /// Everybody's next pose, then the window before the last one.
  void tick() {
    for (BodyId body = 0; body < 4; ++body) {
      const Pose& pose = poses_[slotOf(body)][static_cast<std::size_t>(now_ % 2)];
      ASSERT_TRUE(world_.push(body, 1000 * now_ + 100 * body, pose).ok());
    }
    const RigidPose still{Quaternion::Identity(), Eigen::Vector3d(-90, -90, -90)};
    ASSERT_TRUE(world_.push(4, 1000 * now_, still).ok());
    ++now_;
    if (now_ < 4) return;
    const std::int64_t end = 1000 * (now_ - 2);
    const auto asked = world_.contacts(end - 1000, end, scratch_, answer_);
    ASSERT_TRUE(asked.ok()) << describe(asked.error());
    world_.forgetBefore(end);
  }
  [[nodiscard]] const WorldContacts& answer() const { return answer_; }

 private:
  World world_;
  std::vector<std::array<Pose, 2>> poses_;
  std::int64_t now_ = 0;
  Scratch scratch_;
  WorldContacts answer_;
};

TEST(WorldAllocations, AreNoneOnceEverythingHasGrown) {
  if (!test::countsAllocations()) GTEST_SKIP() << "this build has an allocator of its own";
  Crowd crowd;
  for (int i = 0; i < 12; ++i) crowd.tick();
  ASSERT_GT(crowd.answer().contacts.size(), 10u);
  const std::uint64_t before = test::numAllocations();
  for (int i = 0; i < 4; ++i) crowd.tick();
  EXPECT_EQ(test::numAllocations(), before);
}

}  // namespace
}  // namespace foretouch
