// tests/middleware/solid/solid_laws_test.cpp: the laws that a solid avatar keeps whatever it is
// asked, judged from what it shows.
#include <cmath>
#include <limits>
#include <thread>

#include "articulated/motion.h"
#include "lss/index.h"
#include "tessellation/swept_lss.h"
#include "tests/middleware/balls.h"
#include "tests/middleware/solid/solid_runner.h"

namespace foretouch::test {
namespace {

/// A floor, a wall, a table and a pole about the figure, which stands free among them.
RawScene furniture() {
  RawScene raw = wallAt(-0.6);
  addSheet(raw, {-3, -0.1, -3}, {6, 0, 0}, {0, 0, 6});
  addBox(raw, {0.45, 0.7, -0.5}, {1.4, 0.74, 0.5});
  addBox(raw, {-0.75, -0.1, -0.35}, {-0.7, 2.2, -0.3});
  return raw;
}

/// A hostile walk: calm targets, jumps, noise, a target that stays.
Pose nextTarget(const SolidRunner& run, Random& random, const Pose& last) {
  switch (random.below(4)) {
    case 0: return randomPose(run, random, 0.8, 0.3);
    case 1: return randomPose(run, random, 3.1, 2.0);
    case 2: {
      Pose near = last;
      for (Quaternion& q : near.rotations) q = (q * random.turn(0.02)).normalized();
      return near;
    }
    default: return last;
  }
}

TEST(SolidLaws, NothingIsEverPassedThroughAndNoWayIsBroken) {
  std::uint64_t moved = 0, notEqual = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    SolidRunner run(furniture());
    Pose target = run.rest();
    for (int i = 0; i < 60; ++i) {
      notEqual += run.follow(target).state != SolidState::Equal;
      target = nextTarget(run, random, target);
    }
    EXPECT_EQ(run.violations(), 0u) << seed;
    EXPECT_EQ(run.audit.tally().uncertified, 0u) << seed;
    EXPECT_EQ(run.audit.tally().appeared, 1u) << seed;
    moved += run.audit.tally().moved;
  }
  EXPECT_GT(moved, 300u);
  EXPECT_GT(notEqual, 200u);
}

TEST(SolidLaws, WhereTheDirectWayIsFreeItIsTakenBitForBit) {
  SolidOptions options;
  options.catchUp = 1e3;
  constexpr double kLongTick = 0.1;  // in which that speed is reached
  int free = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(100 + seed);
    SolidRunner run(furniture(), options);
    Pose target = run.follow(run.rest()).shown;
    for (int i = 0; i < 60; ++i) {
      target = nextTarget(run, random, target);
      const Pose from = run.tick.shown;
      const bool isFree = run.isFree(from, target, options.tolerance * 1.01);
      run.follow(target, kLongTick);
      if (!isFree) continue;
      ++free;
      EXPECT_TRUE(isSame(run.tick.shown, target)) << seed << ", tick " << i;
      EXPECT_EQ(run.tick.state, SolidState::Equal) << seed << ", tick " << i;
    }
  }
  EXPECT_GT(free, 100);
}

TEST(SolidLaws, AStillTargetIsFollowedByAStillBody) {
  for (const double depth : {0.02, 0.1, 0.25}) {
    SolidRunner run(wallAt(-0.65 + depth));
    for (int i = 0; i <= 45; ++i) run.follow(reaching(run, kPi / 2 * i / 45));
    EXPECT_FALSE(run.isFree(reaching(run, kPi / 2))) << depth;
    for (int i = 0; i < 30; ++i) run.follow(reaching(run, kPi / 2));
    const Pose rests = run.tick.shown;
    for (int i = 0; i < 60; ++i) {
      EXPECT_EQ(difference(run.follow(reaching(run, kPi / 2)).shown, rests), 0.0)
          << depth << " m deep, tick " << i << ", " << toString(run.tick.state);
    }
    EXPECT_EQ(run.violations(), 0u);
  }
}

/// How far the contact is from where an end of the LSS's axis is right above the wall at `z`.
double offFromEnd(const SolidRunner& run, const SolidContact& contact, double z) {
  std::vector<LinkState> states;
  ChainMotion still;
  still.assign(run.avatar.skeleton(), run.tick.shown, run.tick.shown);
  still.statesAt(0.0, states);
  const Lss& lss = run.avatar.lss(contact.link)[slotOf(contact.lss)];
  const AxisEnds ends = axisEnds(lss, states[slotOf(contact.link)]);
  double off = std::numeric_limits<double>::infinity();
  for (const Vector3d& end : {ends.a, ends.b}) {
    const double gap = end.z() - z - lss.radius;
    const double aside = (Vector3d(end.x(), end.y(), z) - contact.p_W).norm();
    off = std::min(off, std::max(aside, std::abs(gap - contact.gap)));
  }
  return off;
}

TEST(SolidLaws, ContactsAreToldWhereTheShownPoseHasThem) {
  SolidRunner run(wallAt(-0.5));
  int sliding = 0;
  for (int i = 0; i < 120; ++i) {
    const double t = i / 90.0;
    run.follow(reaching(run, 0.5 * kPi * std::min(1.0, t / 0.45) + 0.4 * std::sin(4.5 * t)));
    for (const SolidContact& contact : run.tick.contacts) {
      if (contact.other != kNoParent) continue;  // of the own body
      EXPECT_LT(offFromEnd(run, contact, -0.5), 1e-6) << "tick " << i;
      sliding += contact.slipSpeed > 0.1 ? 1 : 0;
    }
  }
  EXPECT_GT(sliding, 20);
}

Pose turned(const Pose& pose, const Quaternion& turn, const Vector3d& by) {
  Pose moved = pose;
  moved.rotations[0] = turn * pose.rotations[0];
  moved.translations[0] = turn * pose.translations[0] + by;
  return moved;
}

/// Both hands in a wall at one instant are a tie, which rounding decides: here the left one comes
/// later.
Pose reachingRightFirst(const SolidRunner& run, double yaw) {
  Pose pose = reaching(run, yaw);
  Quaternion& left = pose.rotations[run.joint("LeftArm")];
  left = Quaternion(Eigen::AngleAxisd(-0.05, Vector3d::UnitY())) * left;
  return pose;
}

TEST(SolidLaws, SceneAndTargetsMovedAlikeGiveTheSameWay) {
  const Quaternion turn(Eigen::AngleAxisd(0.7, Vector3d::UnitY()));
  const Vector3d by(3.0, 0.5, -2.0);
  RawScene there = furniture();
  for (Triangle& triangle : there.triangles) {
    for (Vector3d& v : triangle.vertices) v = turn * v + by;
  }
  SolidRunner here(furniture()), run(there);
  int touching = 0;
  for (int i = 0; i < 90; ++i) {
    const Pose target = reachingRightFirst(here, 0.5 * kPi * std::min(1.0, i / 45.0));
    const Pose shown = here.follow(target).shown;
    EXPECT_LT(difference(run.follow(turned(target, turn, by)).shown, turned(shown, turn, by)), 1e-8)
        << i;
    touching += here.tick.contacts.empty() ? 0 : 1;
  }
  EXPECT_GT(touching, 20);
}

/// By arithmetic of its own: each coordinate of a joint's turn, as half an angle from the first
/// turn, against all that was tracked.
TEST(SolidLaws, SurfacesTurnNoJointFarBeyondWhatWasSeen) {
  constexpr double kMargin = 0.7, kMissed = 0.05;
  int touching = 0, atAnEnd = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Random random(seed);
    SolidRunner run(furniture());
    const std::size_t n = run.rest().rotations.size();
    std::vector<Quaternion> first;
    std::vector<Vector3d> least(n, Vector3d::Zero()), most(n, Vector3d::Zero());
    const auto halvesOf = [&](const Pose& pose, std::size_t j) {
      Eigen::Quaterniond turn(first[j].conjugate() * pose.rotations[j]);
      if (turn.w() < 0.0) turn.coeffs() *= -1.0;
      return Vector3d(turn.vec().array().max(-1.0).min(1.0).asin());
    };
    Pose target = run.rest();
    for (int i = 0; i < 240; ++i) {
      if (i % 30 == 0) target = randomPose(run, random, 0.8, 0.6);
      if (first.empty()) first = target.rotations;
      const SolidTick& tick = run.follow(target);
      touching += tick.contacts.empty() ? 0 : 1;
      for (std::size_t j = 1; j < n; ++j) {
        const Vector3d tracked = halvesOf(target, j), shown = halvesOf(tick.shown, j);
        least[j] = least[j].cwiseMin(tracked);
        most[j] = most[j].cwiseMax(tracked);
        for (int k = 0; k < 3; ++k) {
          const double beyond = std::max(shown[k] - most[j][k], least[j][k] - shown[k]);
          EXPECT_LT(2.0 * beyond, kMargin + kMissed) << seed << ", tick " << i << ", joint " << j;
          atAnEnd += 2.0 * beyond > 0.9 * kMargin ? 1 : 0;
        }
      }
    }
    EXPECT_EQ(run.violations(), 0u) << seed;
  }
  EXPECT_GT(touching, 200);
  EXPECT_GT(atAnEnd, 20);
}

TEST(SolidLaws, MoreTrianglesOfTheSameWallChangeNothing) {
  SolidOptions options;
  options.workBudget = 1'000'000;  // more triangles are more work: a budget ends ticks sooner
  for (const double rateHz : {90.0, 30.0, 10.0}) {
    SolidRunner coarse(wallAt(-0.5), options), fine(wallAt(-0.5, 98), options);
    int touching = 0;
    for (int i = 0; i < static_cast<int>(1.3 * rateHz); ++i) {
      const double t = i / rateHz;
      const double yaw =
          0.5 * kPi * std::min(1.0, t / 0.45) + (t > 0.67 ? 0.4 * std::sin(4.5 * t) : 0);
      const Pose target = reachingRightFirst(coarse, yaw);
      const Pose shown = coarse.follow(target, 1.0 / rateHz).shown;
      EXPECT_LT(difference(fine.follow(target, 1.0 / rateHz).shown, shown), 1e-6)
          << rateHz << " Hz, tick " << i;
      touching += coarse.tick.contacts.empty() ? 0 : 1;
    }
    EXPECT_GT(touching, 5) << rateHz;
    EXPECT_EQ(coarse.violations() + fine.violations(), 0u) << rateHz;
  }
}

/// The gap of the figure pressed straight into a wall, once it rests.
double restingGap(double skin) {
  SolidOptions options;
  options.skin = skin;
  options.tolerance = skin / 4;
  SolidRunner run(wallAt(-0.5), options);
  for (int i = 0; i < 150; ++i) run.follow(reaching(run, 0.5 * kPi * std::min(1.0, i / 45.0)));
  EXPECT_EQ(run.violations(), 0u);
  return run.judge.at(tools::plainPose(run.tick.shown), 1.0).least;
}

TEST(SolidLaws, HalfTheSkinIsHalfTheGap) {
  const double whole = restingGap(4e-3), half = restingGap(2e-3);
  EXPECT_GT(half, 0.3 * 2e-3);
  EXPECT_LT(half, 1.1 * 2e-3);
  EXPECT_NEAR(whole, 2 * half, 0.25 * whole);
}

std::vector<Pose> shownOf(std::uint64_t seed) {
  Random random(seed);
  SolidRunner run(furniture());
  std::vector<Pose> shown;
  Pose target = run.rest();
  for (int i = 0; i < 50; ++i) {
    shown.push_back(run.follow(target).shown);
    target = nextTarget(run, random, target);
  }
  return shown;
}

TEST(SolidLaws, TheSameTargetsGiveTheSameBitsOnAnyThread) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const std::vector<Pose> once = shownOf(seed);
    std::vector<Pose> here, there;
    std::thread other([&] { there = shownOf(seed); });
    here = shownOf(seed);
    other.join();
    ASSERT_EQ(here.size(), once.size());
    for (std::size_t i = 0; i < once.size(); ++i) {
      EXPECT_TRUE(isSame(once[i], here[i]) && isSame(once[i], there[i])) << seed << " " << i;
    }
  }
}

TEST(SolidLaws, AnyBudgetKeepsThePromiseAndSaysWhatItCosts) {
  std::uint64_t spent = 0;
  for (const std::uint64_t budget : {1u, 30u, 300u, 3000u}) {
    SolidOptions options;
    options.workBudget = budget;
    Random random(budget);
    SolidRunner run(furniture(), options);
    Pose target = run.rest();
    for (int i = 0; i < 80; ++i) {
      run.follow(target);
      target = nextTarget(run, random, target);
    }
    EXPECT_EQ(run.violations(), 0u) << budget;
    spent += run.audit.tally().limits[static_cast<std::size_t>(SolidLimit::Budget)];
  }
  EXPECT_GT(spent, 30u);
}

TEST(SolidLaws, WhatIsNoPoseIsRefusedAndChangesNothing) {
  SolidRunner run(furniture());
  run.follow(run.rest());
  const Pose before = run.tick.shown;
  std::vector<Pose> wrong(4, run.rest());
  wrong[0].translations[0].x() = std::numeric_limits<double>::quiet_NaN();
  wrong[1].rotations[3].w() = std::numeric_limits<double>::infinity();
  wrong[2].rotations.pop_back();
  wrong[3].translations[0].y() = 1e300;
  for (const Pose& pose : wrong) {
    EXPECT_FALSE(run.solid.follow({pose, 0.01, nullptr}, run.tick).ok());
    EXPECT_TRUE(isSame(run.tick.shown, before));
  }
  for (const double dt : {0.0, -1.0, 11.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(run.solid.follow({run.rest(), dt, nullptr}, run.tick).ok()) << dt;
  }
  EXPECT_EQ(run.follow(run.rest()).state, SolidState::Equal);
  EXPECT_EQ(run.violations(), 0u);
}

TEST(SolidLaws, TeleportsOfTenKilometresAndHalfTurnsPassNothing) {
  SolidRunner run(furniture());
  run.follow(run.rest());
  for (int i = 0; i < 40; ++i) {
    Pose target = run.rest();
    if (i % 4 == 1) target.translations[0].z() = -1e4;
    if (i % 4 == 3) target.rotations[0] = Quaternion(0, 0, 1, 0);
    run.follow(target);
  }
  EXPECT_EQ(run.violations(), 0u);
}

TEST(SolidLaws, ALostHandIsNeverGuessedThroughAWall) {
  SolidRunner run(wallAt(-0.5));
  std::vector<std::uint8_t> isTracked(run.rest().rotations.size(), 1);
  isTracked[run.joint("RightHand")] = 0;
  for (int i = 0; i < 60; ++i) {
    Pose target = reaching(run, 0.5 * kPi * i / 60);
    target.rotations[run.joint("RightHand")] = Quaternion(0, 1, 0, 0);  // means nothing
    ASSERT_TRUE(run.solid.follow({target, 0.011, i < 20 ? nullptr : &isTracked}, run.tick).ok());
    run.audit.look(run.tick);
    if (i < 20) continue;
    EXPECT_EQ(run.tick.joints[run.joint("RightHand")], SolidJointState::Lost) << i;
  }
  EXPECT_EQ(run.violations(), 0u);
}

TEST(SolidLaws, NobodyLeavesACage) {
  RawScene cage;
  addBox(cage, {-0.95, -0.1, -0.5}, {0.95, 2.0, 0.5});
  SolidRunner run(cage);
  Random random(7);
  run.follow(run.rest());
  for (int i = 0; i < 80; ++i) {
    Pose target = randomPose(run, random, 0.5, 0.0);
    target.translations[0] += 5.0 * random.direction();
    run.follow(target);
    EXPECT_LT(std::abs(run.tick.shown.translations[0].x()), 0.95);
    EXPECT_LT(std::abs(run.tick.shown.translations[0].z()), 0.5);
  }
  EXPECT_EQ(run.violations(), 0u);
}

TEST(SolidLaws, ABoardOfFourMillimetresStopsAnySpeed) {
  for (const double speed : {1.0, 3.0, 10.0, 30.0, 100.0}) {
    RawScene board;
    addBox(board, {-1.0, 0.0, -1.004}, {1.0, 2.5, -1.0});
    SolidRunner run(board);
    for (int i = 0; i <= 40; ++i) {
      Pose target = run.rest();
      target.translations[0].z() = -std::min(3.0, speed * i / 90.0);
      run.follow(target);
      EXPECT_GT(run.tick.shown.translations[0].z(), -1.0) << speed;
    }
    EXPECT_EQ(run.violations(), 0u) << speed;
  }
}

TEST(SolidLaws, AFirstPoseInsideIsPlacedOutsideOrTold) {
  SolidRunner run(wallAt(0.0));
  ASSERT_FALSE(run.isFree(run.rest()));
  for (int i = 0; i < 90 && (i == 0 || run.tick.state == SolidState::Placing); ++i) {
    run.follow(run.rest());
    EXPECT_TRUE(run.tick.isCertified || run.tick.state == SolidState::Placing);
  }
  EXPECT_NE(run.tick.state, SolidState::Placing);
  EXPECT_TRUE(run.isFree(run.tick.shown));
  EXPECT_EQ(run.violations(), 0u);
}

TEST(SolidLaws, AFirstPoseThatTouchesItselfIsUnfolded) {
  const Avatar body = figure();
  SolidOptions options;
  options.self = PairRules::derive(body).value();
  for (const bool isWallThere : {false, true}) {
    SolidRunner run(wallAt(isWallThere ? -0.05 : -5.0), options, body);
    Pose folded = run.rest();
    // Both arms through the chest and each other.
    folded.rotations[run.joint("RightForeArm")] =
        Quaternion(Eigen::AngleAxisd(0.95 * kPi, Vector3d::UnitY()));
    folded.rotations[run.joint("LeftForeArm")] =
        Quaternion(Eigen::AngleAxisd(-0.95 * kPi, Vector3d::UnitY()));
    folded.rotations[run.joint("RightUpLeg")] =
        Quaternion(Eigen::AngleAxisd(0.4, Vector3d::UnitZ()));
    folded.rotations[run.joint("LeftUpLeg")] =
        Quaternion(Eigen::AngleAxisd(-0.4, Vector3d::UnitZ()));
    for (int i = 0; i < 30; ++i) {
      run.follow(folded);
      ASSERT_TRUE(run.tick.isCertified) << i << (isWallThere ? ", wall" : "");
      EXPECT_NE(run.tick.state, SolidState::Equal);
    }
    EXPECT_EQ(run.audit.tally().appeared, 1u);
    EXPECT_EQ(run.violations(), 0u);
    // What touched nothing was not turned.
    EXPECT_LT(run.tick.linkDeviation[run.joint("Head")], 0.5);
    for (int i = 0; i < 120; ++i) run.follow(run.rest());
    if (!isWallThere) {
      EXPECT_EQ(run.tick.state, SolidState::Equal);
    }
    EXPECT_EQ(run.violations(), 0u);
  }
}

TEST(SolidLaws, ASceneThatClosesAroundTheBodyIsTold) {
  SolidRunner run(wallAt(-1.5));
  run.follow(run.rest());
  RawScene closed = wallAt(0.0);
  ASSERT_TRUE(run.solid.changeScene(Scene::build(closed).value()).ok());
  const auto done = run.solid.follow({run.rest(), 0.011, nullptr}, run.tick);
  ASSERT_TRUE(done.ok());
  const bool isTold = run.tick.limit == SolidLimit::Inside && !run.tick.isCertified;
  EXPECT_TRUE(isTold || run.tick.hasAppeared);
}

TEST(SolidUsers, WalkingIntoNothingNeverLags) {
  SolidRunner run(wallAt(-50.0));
  for (int i = 0; i < 90; ++i) {
    Pose target = run.rest();
    target.translations[0].x() = 3.0 * i / 90.0;
    EXPECT_EQ(run.follow(target).state, SolidState::Equal) << i;
    EXPECT_TRUE(isSame(run.tick.shown, target)) << i;
    EXPECT_EQ(run.tick.counters.queries, i == 0 ? run.tick.counters.queries : 1u) << i;
  }
}

TEST(SolidUsers, AHandSlidesAlongTheWallInsteadOfStoppingThere) {
  SolidRunner run(wallAt(-0.5));
  for (int i = 0; i <= 60; ++i) run.follow(reaching(run, 0.5 * kPi * std::min(1.0, i / 45.0)));
  const Vector3d from = run.tick.shown.translations[0];
  double moved = 0.0;
  for (int i = 0; i < 90; ++i) {
    Pose target = reaching(run, 0.5 * kPi);
    target.translations[0].x() += 0.5 * i / 90.0;
    run.follow(target);
  }
  moved = run.tick.shown.translations[0].x() - from.x();
  EXPECT_GT(moved, 0.8 * 0.5);
  EXPECT_FALSE(run.tick.contacts.empty());
  EXPECT_EQ(run.violations(), 0u);
}

// Behind the bottom of a box that is open at one side the target never stands still, and no way
// that it goes leads out: the body goes back as it came.
TEST(SolidUsers, WhatIsCaughtComesOutThoughTheTargetGoesOn) {
  RawScene box;
  const double low = -0.2, high = 0.2, bottom = 1.0;
  addSheet(box, {bottom, low, low}, {0, 0, high - low}, {0, high - low, 0}, 4);
  for (const double side : {low, high}) {
    addSheet(box, {0.4, side, low}, {bottom - 0.4, 0, 0}, {0, 0, high - low}, 4);
    addSheet(box, {0.4, low, side}, {bottom - 0.4, 0, 0}, {0, high - low, 0}, 4);
  }
  SolidRunner run(box, {}, ball(0.05));
  const auto targetAt = [&](int i) {
    Pose target = run.rest();
    const double t = i / 90.0, beyond = std::max(0.0, t - 2.0);
    target.translations[0] = {std::min(2.0, t) + 0.3 * std::sin(3.0 * beyond), 0.0,
                              0.3 * std::sin(2.0 * beyond)};
    return target;
  };
  int held = 0, around = 0;
  for (int i = 0; i <= 90 * 6; ++i) {
    run.follow(targetAt(i));
    held += run.tick.state == SolidState::Held ? 1 : 0;
    around += run.tick.state == SolidState::Around ? 1 : 0;
  }
  EXPECT_GT(held, 5);
  EXPECT_GT(around, 5);
  EXPECT_TRUE(isSame(run.tick.shown, targetAt(90 * 6))) << run.tick.deviation;
  EXPECT_EQ(run.violations(), 0u);
}

}  // namespace
}  // namespace foretouch::test
