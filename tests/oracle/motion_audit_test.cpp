// tests/oracle/motion_audit_test.cpp: controls: the audit tells what breaks a promise, by how much,
// and what is ugly.
#include "tests/oracle/motion_audit.h"

#include <gtest/gtest.h>

#include "bench/solid/figure.h"

namespace foretouch::test {
namespace {

constexpr double kTickS = 0.01;

/// A figure that stands, shown as its tracker says but for what a test does to it.
class Audited {
 public:
  Audited() : avatar_(tools::figure()), audit(nothing_, avatar_, {}) {
    tracked = rest = tick.shown = restPose(avatar_.skeleton());
    tick.state = SolidState::Equal;
    audit.begin("control");
    for (int i = 0; i < 4; ++i) look();
  }
  void look() { audit.look(tracked, tick, kTickS); }
  [[nodiscard]] std::size_t joint(const char* name) const {
    return static_cast<std::size_t>(*avatar_.skeleton().find(name));
  }

  Pose tracked, rest;
  SolidTick tick;

 private:
  oracle::Scene nothing_{std::vector<oracle::Triangle>{}};
  Avatar avatar_;

 public:
  MotionAudit audit;
};

Quaternion turned(double angle, const Eigen::Vector3d& axis) {
  return Quaternion(Eigen::AngleAxisd(angle, axis));
}

TEST(MotionAudit, FindsNothingWhereShownIsTracked) {
  Audited run;
  EXPECT_EQ(run.audit.tally().violations(), 0u);
  EXPECT_EQ(run.audit.ugly().jerk.value, 0.0);
  EXPECT_NEAR(run.audit.ugly().unseen.value, 0.0, 1e-7);
}

TEST(MotionAudit, NamesWhoOutrunsTheTrackedOnes) {
  for (const double speed : {1.99, 2.01}) {
    Audited run;
    run.tick.shown.translations[0].x() += speed * kTickS;
    run.look();
    const std::uint64_t isToo = speed > 2.0 ? 1 : 0;
    EXPECT_EQ(run.audit.tally().outrun, isToo) << speed;
    EXPECT_EQ(run.audit.tally().headOutrun, isToo) << speed;
    EXPECT_NEAR(run.audit.tally().headBeyond, speed, 1e-9);
  }
}

/// A hand that is fast is no leave for the head.
TEST(MotionAudit, MeasuresTheHeadByTheTrackedHead) {
  Audited run;
  run.tracked.rotations[run.joint("RightArm")] = turned(0.5, Eigen::Vector3d::UnitZ());
  run.tick.shown.translations[0].x() += 3.0 * kTickS;
  run.look();
  EXPECT_EQ(run.audit.tally().outrun, 0u);
  EXPECT_EQ(run.audit.tally().headOutrun, 1u);
}

/// A joint that moves no end of an LSS far, by its own angle: a hand about its own axis.
TEST(MotionAudit, NamesAJointThatTurnsFasterThanTheTrackedOnes) {
  for (const double speed : {9.9, 10.1}) {
    Audited run;
    run.tick.shown.rotations[run.joint("RightHand")] =
        turned(speed * kTickS, Eigen::Vector3d::UnitX());
    run.look();
    EXPECT_EQ(run.audit.tally().overturned, speed > 10.0 ? 1 : 0) << speed;
    EXPECT_NEAR(run.audit.tally().turnBeyond, speed, 1e-9);
  }
  Audited run;  // as fast as the other hand, and the catch-up beyond
  run.tracked.rotations[run.joint("LeftHand")] = turned(5.0 * kTickS, Eigen::Vector3d::UnitX());
  run.tick.shown.rotations[run.joint("RightHand")] =
      turned(14.9 * kTickS, Eigen::Vector3d::UnitX());
  run.look();
  EXPECT_EQ(run.audit.tally().overturned, 0u);
}

TEST(MotionAudit, TellsALiftThatJumps) {
  Audited run;
  run.tick.lift = 0.049 * kTickS;
  run.look();
  EXPECT_EQ(run.audit.tally().liftJumped, 0u);
  run.tick.lift += 0.051 * kTickS;
  run.look();
  EXPECT_EQ(run.audit.tally().liftJumped, 1u);
  EXPECT_NE(run.audit.tally().table().find("1 in which the lift (at most 0.001 m) jumped"),
            std::string::npos);
}

TEST(MotionAudit, MeasuresWhatIsUgly) {
  Audited run;
  const std::size_t arm = run.joint("RightArm");
  run.tick.shown.rotations[arm] = turned(0.7, Eigen::Vector3d::UnitZ());
  run.look();
  EXPECT_NEAR(run.audit.ugly().unseen.value, 0.7, 1e-9);
  EXPECT_EQ(run.audit.ugly().unseen.link, arm);
  // From rest, all that it moved: the third difference.
  Audited thrown;
  thrown.tick.shown.translations[0].x() += 0.01;
  thrown.look();
  EXPECT_NEAR(thrown.audit.ugly().jerk.value, 0.01 / (kTickS * kTickS * kTickS), 1e-6);
  // An arm that is folded back through the trunk, which nobody tracked so.
  Audited folded;
  folded.tick.shown.rotations[arm] = turned(3.1, Eigen::Vector3d::UnitY());
  folded.look();
  EXPECT_GT(folded.audit.ugly().ownDepth.value, 0.05);
  EXPECT_EQ(folded.audit.tally().deeper, 1u);
}

}  // namespace
}  // namespace foretouch::test
