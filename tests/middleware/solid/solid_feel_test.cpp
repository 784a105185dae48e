// tests/middleware/solid/solid_feel_test.cpp: the shown body does nothing that nobody did: what the
// lift, the catch-up, snaps and the own body may do.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/pair_rules.h"
#include "tests/middleware/solid/solid_runner.h"

namespace foretouch::test {
namespace {

constexpr double kTickS = 1.0 / 90.0;

using Ends = std::vector<std::array<oracle::Vec3d, 2>>;

Ends endsOf(SolidRunner& run, const Pose& pose) {
  return run.judge.endsAt(tools::plainPose(pose));
}

/// The farthest that any end of an LSS is from one place to the other.
double farthest(const Ends& one, const Ends& other) {
  double most = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      most = std::max(most, norm(one[i][end] - other[i][end]));
    }
  }
  return most;
}

RawScene floorOnly() {
  RawScene raw;
  addSheet(raw, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  return raw;
}

/// The figure's legs end so far above the floor (m).
constexpr double kLegsAbove = 0.05;

SolidOptions onFeet() {
  SolidOptions options;
  const Avatar body = figure();
  for (LinkId link = 0; link < body.numLinks(); ++link) {
    const std::string& name = body.skeleton().name(link);
    options.feet.push_back(name == "LeftLeg" || name == "RightLeg");
  }
  return options;
}

TEST(SolidFeel, TheLiftChangesSlowlyThroughHops) {
  SolidRunner run(floorOnly(), onFeet());
  double lift = 0.0;
  int lifted = 0;
  Ends shown, tracked;
  for (int i = 0; i < 540; ++i) {
    // Its feet are 4 cm too low; once a second it hops by 20 cm within a third of a second.
    const double t = std::fmod(i * kTickS, 1.0), hop = i > 180 && t < 0.33 ? t / 0.33 : 0.0;
    Pose pose = run.rest();
    pose.translations[0].y() += 0.2 * 4.0 * hop * (1.0 - hop) - kLegsAbove - 0.04;
    const SolidTick& tick = run.follow(pose);
    const Ends shownNow = endsOf(run, tick.shown), trackedNow = endsOf(run, pose);
    if (i > 0) {
      EXPECT_LE(std::abs(tick.lift - lift), 0.05 * kTickS * (1 + 1e-9)) << i;
      EXPECT_LE(farthest(shownNow, shown),
                farthest(trackedNow, tracked) + SolidOptions{}.catchUp * kTickS)
          << i;
    }
    // It is the same body as tracked, lifted: no knees are bent once it stands as tracked.
    if (i > 180) {
      EXPECT_NEAR(tick.lift, 0.042, 6e-3) << i;
    }
    lifted += tick.lift > 0.0;
    lift = tick.lift;
    shown = shownNow;
    tracked = trackedNow;
  }
  EXPECT_GT(lifted, 500);
  EXPECT_EQ(run.violations(), 0u);
}

TEST(SolidFeel, ALiftThatNobodyAsksForFallsSlowly) {
  SolidRunner run(floorOnly(), onFeet());
  Pose low = run.rest();
  low.translations[0].y() -= kLegsAbove + 0.04;
  for (int i = 0; i < 180; ++i) run.follow(low);
  ASSERT_GT(run.tick.lift, 0.035);
  // Calibrated anew: it falls at its speed, to nothing, and what is shown is tracked again.
  Pose right = run.rest();
  right.translations[0].y() -= kLegsAbove - 0.003;
  double before = run.tick.lift;
  for (int i = 0; i < 270; ++i) {
    run.follow(right);
    EXPECT_LE(before - run.tick.lift, 0.05 * kTickS * (1 + 1e-9)) << i;
    before = run.tick.lift;
  }
  EXPECT_EQ(run.tick.lift, 0.0);
  EXPECT_TRUE(isSame(run.tick.shown, right));
}

/// Straight there within a tick, an arm that turns against another joint would go a long way.
TEST(SolidFeel, NoPointOutrunsTheTrackedOnes) {
  for (const double rateHz : {90.0, 30.0}) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      Random random(seed);
      SolidRunner run(wallAt(-0.45));
      Pose from = run.rest(), to = from;
      Ends shown, tracked;
      int late = 0;
      for (int i = 0; i < static_cast<int>(6 * rateHz); ++i) {
        const int every = static_cast<int>(rateHz / 2);
        // Half a second each; now and then, all at once.
        if (i % every == 0) {
          from = to;
          to = randomPose(run, random, 1.5, 0.5);
        }
        const double t = seed % 2 == 0 ? (i % every + 1.0) / every : 1.0;
        Pose pose = to;
        for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
          pose.rotations[j] = from.rotations[j].slerp(t, to.rotations[j]).normalized();
          pose.translations[j] = (1 - t) * from.translations[j] + t * to.translations[j];
        }
        run.follow(pose, 1.0 / rateHz);
        const Ends shownNow = endsOf(run, run.tick.shown), trackedNow = endsOf(run, pose);
        if (i > 0 && !run.tick.hasAppeared) {
          const double most = farthest(trackedNow, tracked) + SolidOptions{}.catchUp / rateHz;
          EXPECT_LE(farthest(shownNow, shown), most + 1e-9)
              << rateHz << " Hz, seed " << seed << ", tick " << i;
        }
        late += run.tick.state != SolidState::Equal ? 1 : 0;
        shown = shownNow;
        tracked = trackedNow;
      }
      EXPECT_GT(late, 10) << seed;
      EXPECT_EQ(run.violations(), 0u);
    }
  }
}

TEST(SolidFeel, CatchingUpGathersAndLosesSpeed) {
  // A wall that is gone: the hand goes to where it was tracked behind it.
  SolidRunner run(wallAt(-0.5));
  for (int i = 0; i < 90; ++i) run.follow(reaching(run, kPi / 2 * std::min(1.0, i / 45.0)));
  ASSERT_GT(run.tick.deviation, 0.1);
  RawScene away = wallAt(-3.0);
  ASSERT_TRUE(run.solid.changeScene(Scene::build(away).value()).ok());
  std::vector<double> speeds{0.0};
  Ends shown = endsOf(run, run.tick.shown);
  for (int i = 0; i < 40; ++i) {
    run.follow(reaching(run, kPi / 2));
    const Ends now = endsOf(run, run.tick.shown);
    speeds.push_back(farthest(now, shown) / kTickS);
    shown = now;
  }
  EXPECT_EQ(run.tick.state, SolidState::Equal);
  const double fastest = *std::max_element(speeds.begin(), speeds.end());
  EXPECT_GT(fastest, 1.0);
  EXPECT_LE(fastest, SolidOptions{}.catchUp + 1e-9);
  for (std::size_t i = 1; i < speeds.size(); ++i) {
    // Full speed takes 40 ms.
    EXPECT_LE(speeds[i] - speeds[i - 1], 50.0 * kTickS + 1e-9) << i;
  }
}

/// A step ends where the pace does: what would have stopped the whole of it is not touched yet.
TEST(SolidFeel, WhatIsToldAsSlidingTouchesSomething) {
  SolidOptions options;
  options.catchUp = 0.2;
  int sliding = 0, following = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Random random(seed);
    SolidRunner run(wallAt(-0.45), options);
    Pose to = run.rest();
    for (int i = 0; i < 360; ++i) {
      if (i % 45 == 0) to = randomPose(run, random, 1.5, 0.5);
      const SolidTick& tick = run.follow(to);
      for (const SolidContact& contact : tick.contacts) {
        EXPECT_LE(contact.gap, 1.25 * options.skin + 1e-9) << seed << ", tick " << i;
      }
      const bool isSliding = tick.state == SolidState::Sliding;
      if (isSliding) {
        const bool holdsItself =
            std::any_of(tick.contacts.begin(), tick.contacts.end(),
                        [](const SolidContact& contact) { return contact.other != kNoParent; });
        EXPECT_TRUE(holdsItself || !run.isFree(tick.shown, 1.25 * options.skin))
            << seed << ", tick " << i;
      }
      sliding += isSliding;
      following += tick.state == SolidState::Following;
    }
  }
  EXPECT_GT(sliding, 100);
  EXPECT_GT(following, 100);
}

/// Behind a closed wall, where no way leads.
RawScene wallAcross() {
  RawScene raw;
  addSheet(raw, {-40, -40, -0.5}, {80, 0, 0}, {0, 80, 0});
  return raw;
}

/// Bars all around the figure, a hand's breadth apart, and above it.
RawScene cage() {
  RawScene raw;
  constexpr double kHalf = 1.2, kTop = 2.2, kGap = 0.1, kBar = 0.01;
  for (double at = -kHalf; at < kHalf; at += kGap) {
    for (const double side : {-kHalf, kHalf}) {
      addBox(raw, {at, -0.2, side}, {at + kBar, kTop, side + kBar});
      addBox(raw, {side, -0.2, at}, {side + kBar, kTop, at + kBar});
    }
    addBox(raw, {at, kTop, -kHalf}, {at + kBar, kTop + kBar, kHalf});
  }
  return raw;
}

/// Where somebody is tracked from whom the shown body is kept: `at` t seconds later, from rest.
struct SnapTarget {
  const char* name;
  RawScene (*scene)();
  Vector3d (*at)(double t);
};
void PrintTo(const SnapTarget& target, std::ostream* out) {
  *out << target.name;
}

/// Two metres on, within two thirds of a second.
double gone(double t) {
  return -2.0 * std::min(1.0, 1.5 * t);
}

const SnapTarget kSnapTargets[] = {
    {"still", wallAcross, [](double t) { return Vector3d(0, 0, gone(t)); }},
    {"living", wallAcross, [](double t) { return Vector3d(0.03 * std::sin(6.3 * t), 0, gone(t)); }},
    {"pacing", wallAcross, [](double t) { return Vector3d(0.3 * std::sin(6.3 * t), 0, gone(t)); }},
    {"wandering", wallAcross,
     [](double t) {
       return Vector3d(1.2 * t + 0.2 * std::sin(3.0 * t), 0, gone(t) - 0.4 * std::sin(1.7 * t));
     }},
    {"caged", cage, [](double t) { return Vector3d(0.1 * std::sin(4.0 * t), 0, 1.5 * gone(t)); }},
};

class SnapOf : public testing::TestWithParam<SnapTarget> {};

TEST_P(SnapOf, ComesWhenItWasAnnounced) {
  SolidOptions options;
  options.maySnap = true;
  SolidRunner run(GetParam().scene(), options);
  run.follow(run.rest());
  double announced = -1.0;
  int announcements = 0, snapped = -1;
  for (int i = 0; i < 450 && snapped < 0; ++i) {
    Pose pose = run.rest();
    pose.translations[0] += GetParam().at(i * kTickS);
    const SolidTick& tick = run.follow(pose);
    if (tick.state == SolidState::Snapped) {
      snapped = i;
      EXPECT_GE(announced, 0.0) << "without a word";
      EXPECT_LE(announced, kTickS) << "too early";
    }
    if (announced >= 0.0) {
      EXPECT_NEAR(tick.snapInS, std::max(0.0, announced - kTickS), 1e-9) << i;
    } else if (tick.snapInS >= 0.0) {
      ++announcements;
      EXPECT_GT(tick.snapInS, options.snapNotice - 2 * kTickS);
    }
    announced = tick.snapInS;
  }
  EXPECT_EQ(announcements, 1);
  EXPECT_GT(snapped, 90);
  EXPECT_LT(snapped, 250);
  EXPECT_EQ(run.violations(), 0u);
}
INSTANTIATE_TEST_SUITE_P(SolidFeel, SnapOf, testing::ValuesIn(kSnapTargets),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(SolidFeel, ASnapIntoSomethingIsWithdrawn) {
  SolidOptions options;
  options.maySnap = true;
  RawScene raw = wallAcross();
  addBox(raw, {-0.4, 0.8, -3.4}, {0.4, 1.6, -2.9});
  SolidRunner run(raw, options);
  run.follow(run.rest());
  int told = 0, withdrawn = 0, snapped = 0;
  double announced = -1.0;
  for (int i = 0; i < 900; ++i) {
    Pose pose = run.rest();
    // Behind the wall it goes in and out of a box, faster than a notice lasts.
    pose.translations[0].z() -= i % 18 < 9 ? 2.0 : 3.0;
    const SolidTick& tick = run.follow(pose);
    if (tick.state == SolidState::Snapped) {
      ++snapped;
      break;
    }
    told += tick.snapInS >= 0.0 ? 1 : 0;
    if (announced >= 0.0 && tick.snapInS < 0.0) ++withdrawn;
    if (announced >= 0.0 && tick.snapInS >= 0.0) {
      EXPECT_LT(tick.snapInS, announced);
    }
    announced = tick.snapInS;
  }
  EXPECT_GT(told, 0);
  EXPECT_GT(withdrawn, 0);
  EXPECT_EQ(snapped, 0);
}

}  // namespace
}  // namespace foretouch::test
