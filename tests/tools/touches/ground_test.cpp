#include "tools/touches/ground.h"

#include <cmath>

#include <gtest/gtest.h>

#include "assets/avatar/avatar_file.h"
#include "tests/tools/small_world.h"

namespace foretouch::tools {
namespace {

/// The man with his hips at y = 0, so that his lowest point is at -0.1; he rises by `rise`.
class Ground : public testing::Test {
 protected:
  void begin(const GroundRule& rule, double rise = 0.0) {
    Pose from = restPose(avatar_.skeleton()), to = from;
    to.translations[0].y() += rise;
    motion_.assign(avatar_.skeleton(), from, to);
    ground_.emplace(avatar_, scene_, rule);
    ground_->beginStep(motion_);
  }

  /// A contact at height `y`, whose normal is so many degrees away from up.
  [[nodiscard]] bool isGround(double y, double awayDeg, Verdict verdict = Verdict::Contact,
                              double toi = 0.0, TriangleId triangle = kFloor) {
    const double away = awayDeg * 3.14159265358979323846 / 180.0;
    LinkContact contact;
    contact.verdict = verdict;
    contact.toi = toi;
    contact.p_WScene = {0.3, y, -0.2};
    contact.nhat_SL_W = {std::sin(away), std::cos(away), 0.0};
    contact.triangle = triangle;
    return ground_->isGround(contact);
  }

  static constexpr TriangleId kFloor = 0, kWall = 1;
  const Scene scene_ =
      Scene::build({{Triangle{{Eigen::Vector3d(-9, 0, -9), Eigen::Vector3d(9, 0, 9),
                               Eigen::Vector3d(9, 0, -9)}},
                     Triangle{{Eigen::Vector3d(1, -9, 0), Eigen::Vector3d(1, 9, 0),
                               Eigen::Vector3d(1, 0, 9)}}},
                    {0, 0},
                    {"defaultobject"}})
          .value();
  const Avatar avatar_ = parseAvatar(test::kManAvatar, "man.json").value();
  ChainMotion motion_;
  std::optional<GroundTest> ground_;
};

TEST_F(Ground, IsWhereTheNormalPointsUp) {
  begin({});
  EXPECT_TRUE(isGround(-0.1, 0.0));
  EXPECT_TRUE(isGround(-0.1, 44.9));
  EXPECT_FALSE(isGround(-0.1, 45.1));
  EXPECT_FALSE(isGround(-0.1, 90.0));
  EXPECT_FALSE(isGround(-0.1, 180.0));
  GroundRule steep;
  steep.angleDeg = 60.0;
  begin(steep);
  EXPECT_TRUE(isGround(-0.1, 59.9));
  EXPECT_FALSE(isGround(-0.1, 60.1));
}

TEST_F(Ground, IsNearTheLowestPointOfTheBody) {
  begin({});
  EXPECT_TRUE(isGround(0.149, 0.0));
  EXPECT_FALSE(isGround(0.151, 0.0));
  EXPECT_TRUE(isGround(-3.0, 0.0));
  GroundRule low;
  low.heightM = 0.05;
  begin(low);
  EXPECT_TRUE(isGround(-0.051, 0.0));
  EXPECT_FALSE(isGround(-0.049, 0.0));
}

TEST_F(Ground, IsMeasuredWhereTheBodyIsAtThatInstant) {
  begin({}, 1.0);
  EXPECT_FALSE(isGround(0.4, 0.0));
  EXPECT_FALSE(isGround(0.4, 0.0, Verdict::Contact, 0.2));
  EXPECT_TRUE(isGround(0.4, 0.0, Verdict::Contact, 0.3));
}

// The axis of a foot that has sunk in meets the floor, or is below it: whatever the normal says.
TEST_F(Ground, IsTheLevelTriangleThatADeepContactIsIn) {
  begin({});
  for (const double awayDeg : {0.0, 90.0, 180.0}) {
    EXPECT_TRUE(isGround(-0.1, awayDeg, Verdict::StartsInContact));
    EXPECT_FALSE(isGround(-0.1, awayDeg, Verdict::StartsInContact, 0.0, kWall));
  }
  EXPECT_FALSE(isGround(0.3, 0.0, Verdict::StartsInContact));
  EXPECT_TRUE(isGround(-0.1, 0.0, Verdict::Contact, 0.0, kWall));  // the wall's upper edge
}

TEST_F(Ground, IsNothingThatIsUndecidedOrNotAskedFor) {
  begin({});
  EXPECT_FALSE(isGround(-0.1, 0.0, Verdict::Undecided));
  GroundRule kept;
  kept.use = GroundUse::Keep;
  begin(kept);
  EXPECT_FALSE(isGround(-0.1, 0.0));
}

}  // namespace
}  // namespace foretouch::tools
