#include "network/service/service_health.h"

#include <string>

#include <gtest/gtest.h>

#include "network/service/service.h"

namespace foretouch {
namespace {

using internal::healthOf;

const internal::HealthLimits kLimits = {ServiceOptions{}.stuckAfter,
                                        ServiceOptions{}.unacceptedAfter};
using internal::ServiceState;

ServiceState well() {
  ServiceState state;
  state.threads = {{"receiving", 20}, {"thread 0", 300}};
  state.hasJournal = true;
  state.lastPoseUtimeUs = 1'000'000;
  state.nowUtimeUs = 3'500'000;
  return state;
}

TEST(ServiceHealth, IsOkAndTheTimeOfTheLastPose) {
  const ServiceHealth health = healthOf(well(), kLimits);
  EXPECT_TRUE(health.isWell && health.isAlive);
  EXPECT_EQ(health.text, "ok\nlast pose 2.500 s ago\n");
}

TEST(ServiceHealth, WithoutAThreadThereIsNoLife) {
  ServiceState state = well();
  state.threads[1].idleMs = 10'001;
  const ServiceHealth health = healthOf(state, kLimits);
  EXPECT_FALSE(health.isWell || health.isAlive);
  EXPECT_NE(health.text.find("stuck: thread 0 has not got on for 10.001 s"), std::string::npos);
}

TEST(ServiceHealth, ALogThatStallsOrFailsIsNoReasonToEndAService) {
  ServiceState state = well();
  state.journalIdleMs = 3'600'000;
  state.journalFailures = 7;
  state.journalFailure = "No space left on device";
  const ServiceHealth health = healthOf(state, kLimits);
  EXPECT_TRUE(health.isWell && health.isAlive);
  EXPECT_NE(health.text.find("degraded: the log has not got on for 3600.000 s"), std::string::npos);
  EXPECT_NE(health.text.find("degraded: 7 events are not in the log: No space left"),
            std::string::npos);
}

TEST(ServiceHealth, PosesThatNobodyAcceptsAreIllHealthAndLife) {
  ServiceState state = well();
  state.unacceptedMs = 9'999;
  EXPECT_TRUE(healthOf(state, kLimits).isWell);
  state.unacceptedMs = 10'000;
  EXPECT_FALSE(healthOf(state, kLimits).isWell);
  EXPECT_TRUE(healthOf(state, kLimits).isAlive);
}

}  // namespace
}  // namespace foretouch
