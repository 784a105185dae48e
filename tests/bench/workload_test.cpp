// tests/bench/workload_test.cpp: the steps that a benchmark asks for, and their times' shape.
#include "bench/workload.h"

#include <numeric>

#include <gtest/gtest.h>

#include "bench/pool.h"
#include "bench/timing.h"
#include "middleware/contact.h"
#include "tests/bench/world.h"

namespace foretouch::tools {
namespace {

/// Far, near, through the wall, on the other side and away; ten poses a second.
const std::vector<double> kWay = {-1.0, -0.9, -0.12, 0.4, 0.5, 0.9, 1.2};

WorkloadRequest everyStep() {
  WorkloadRequest request;
  request.rateHz = 10.0;
  request.place = Placement{};
  return request;
}

Result<Workload> chosen(const WorkloadRequest& request) {
  const BenchInputs inputs = test::benchInputs(kWay);
  return chooseSteps(inputs, bodyWithLinks(inputs.avatar, 2).value(), request);
}

TEST(ChooseSteps, TakesEveryStepOfAPlaceAndTellsTheirKind) {
  const auto workload = chosen(everyStep());
  ASSERT_TRUE(workload.ok()) << describe(workload.error());
  std::vector<StepClass> kinds;
  for (const StepPick& pick : workload.value().picks) kinds.push_back(pick.kind);
  EXPECT_EQ(kinds, (std::vector<StepClass>{StepClass::Far, StepClass::Near, StepClass::Contact,
                                           StepClass::Far, StepClass::Far, StepClass::Far}));
}

TEST(ChooseSteps, MixesAsAskedAndAlikeOnEveryRun) {
  WorkloadRequest request;
  request.rateHz = 10.0;
  request.steps = 40;
  request.floorY = -2.0;
  request.liftM = 0.5;
  const auto workload = chosen(request), again = chosen(request);
  ASSERT_TRUE(workload.ok()) << describe(workload.error());
  const auto& shares = workload.value().chosen;
  const auto& picks = workload.value().picks;
  ASSERT_FALSE(picks.empty());
  EXPECT_EQ(shares[static_cast<std::size_t>(StepClass::Start)], 0);
  EXPECT_NEAR(static_cast<double>(shares[static_cast<std::size_t>(StepClass::Contact)]),
              kBusyContact * static_cast<double>(picks.size()), 1.0);
  std::int64_t counted[kStepClasses] = {};
  ASSERT_EQ(picks.size(), again.value().picks.size());
  for (std::size_t i = 0; i < picks.size(); ++i) {
    ++counted[static_cast<std::size_t>(picks[i].kind)];
    EXPECT_EQ(picks[i].placement.origin, again.value().picks[i].placement.origin);
    EXPECT_EQ(picks[i].frame, again.value().picks[i].frame);
    // The lowest point of the man, the sphere at the hips, is where floor and lift put it.
    EXPECT_NEAR(picks[i].placement.origin.y(), -2.0 + 0.5 + 0.1, 1e-9);
  }
  EXPECT_TRUE(std::equal(std::begin(counted), std::end(counted), std::begin(shares)));
  request.seed = 2;
  const auto other = chosen(request);
  ASSERT_TRUE(other.ok());
  EXPECT_NE(other.value().picks[0].placement.origin, picks[0].placement.origin);
}

TEST(ChooseSteps, RefusesARateThatTheClipDoesNotHave) {
  WorkloadRequest request = everyStep();
  request.rateHz = 1000.0;
  EXPECT_FALSE(chosen(request).ok());
}

TEST(PercentilesOf, TakesRanks) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const Percentiles p = percentilesOf(values);
  EXPECT_EQ(p.mean, 50.5);
  EXPECT_EQ(p.p50, 50.0);
  EXPECT_EQ(p.p90, 90.0);
  EXPECT_EQ(p.p99, 99.0);
  EXPECT_EQ(p.max, 100.0);
  EXPECT_EQ(percentilesOf({3.0}).p99, 3.0);
  EXPECT_EQ(percentilesOf({}).max, 0.0);
}

class TimedSteps : public testing::Test {
 protected:
  BenchInputs inputs = test::benchInputs(kWay);
  BenchBody body = bodyWithLinks(inputs.avatar, 2).value();
  std::vector<StepPoses> steps = posesOf(inputs, body, chosen(everyStep()).value()).value();

  [[nodiscard]] std::vector<BenchCase> cases() const {
    std::vector<BenchCase> ways;
    for (const Simd simd : supportedSimd()) {
      BenchCase way;
      way.simd = simd;
      way.cold = ways.empty();
      ways.push_back(way);
    }
    return ways;
  }
};

TEST_F(TimedSteps, HaveATimeAStepAndTheSameCountersOnEveryRun) {
  TimingOptions options;
  options.repeats = 3;
  options.coldMb = 1;
  const Simd before = activeSimd();
  std::vector<std::size_t> backwards(steps.size());
  std::iota(backwards.rbegin(), backwards.rend(), std::size_t{0});
  const auto timing = timeSteps(body.avatar, steps, backwards, inputs.scene, cases(), options);
  const auto again = timeSteps(body.avatar, steps, backwards, inputs.scene, cases(), options);
  ASSERT_TRUE(timing.ok() && again.ok());
  EXPECT_EQ(activeSimd(), before);
  ASSERT_EQ(timing.value().cases.size(), cases().size());
  EXPECT_EQ(timing.value().raySetUs.size(), steps.size());
  for (std::size_t c = 0; c < cases().size(); ++c) {
    const CaseTimes& times = timing.value().cases[c];
    ASSERT_EQ(times.steps.size(), steps.size());
    EXPECT_EQ(times.everyUs.size(), 3 * steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_LE(times.steps[i].warmUs, times.steps[i].firstUs);
      EXPECT_EQ(std::isnan(times.steps[i].coldUs), c != 0);
      EXPECT_EQ(std::isnan(times.steps[i].onceUs), c != 0);
      EXPECT_EQ(times.steps[i].contacts, i == 2 ? 2 : 0);
      for (const auto& [name, field] : kCounterFields) {
        EXPECT_EQ(times.steps[i].counters.*field, again.value().cases[c].steps[i].counters.*field)
            << name;
      }
    }
  }
}

TEST_F(TimedSteps, RefuseBadOptions) {
  std::vector<BenchCase> ways = cases();
  ways.front().query.tolerance = -1.0;
  EXPECT_FALSE(timeSteps(body.avatar, steps, {}, inputs.scene, ways, TimingOptions{}).ok());
}

TEST_F(TimedSteps, OfACrowdAreAllAnsweredByAnyNumberOfThreads) {
  for (const int threads : {1, 2, 5}) {
    const auto times = timeCrowd(body.avatar, steps, inputs.scene, QueryOptions{}, 3, 12, threads);
    ASSERT_TRUE(times.ok());
    EXPECT_EQ(times.value().steps, 36);
    EXPECT_EQ(times.value().instantUs.size(), 12u);
    EXPECT_EQ(times.value().contacts, 12);  // every sixth step, two links
  }
  QueryOptions bad;
  bad.tolerance = 0.0;
  EXPECT_FALSE(timeCrowd(body.avatar, steps, inputs.scene, bad, 3, 2, 2).ok());
}

}  // namespace
}  // namespace foretouch::tools
