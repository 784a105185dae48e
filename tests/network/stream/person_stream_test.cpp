// What is said of a stream's person: the answers of the query itself, at the pose that allows them;
// nothing where nothing is claimed; never a touch before the instant until which none was possible.
#include "network/stream/person_stream.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/bracket/bracket.h"
#include "network/stream/stream_solver.h"
#include "network/wire/codec.h"
#include "tests/network/small_stream.h"

namespace foretouch {
namespace {

using test::farWall;
using test::hipsAt;
using test::kStepUs;
using test::skeletonMessage;
using test::smallAvatar;
using test::smallSkeleton;

constexpr double kAcceleration = 800.0, kAheadAcceleration = 60.0, kSpeed = 3.0;
constexpr std::int64_t kAheadUs = 200'000;

/// Of poses at any rate, unless one is given.
BoundsFile bounds(double rateHz = 0.0) {
  BoundEntry entry;
  entry.part = "all";
  entry.rateHz = rateHz;
  entry.bound.acceleration = kAcceleration;
  entry.bound.speed = kSpeed;
  entry.bound.aheadAcceleration = kAheadAcceleration;
  return {"", "", {entry}};
}

/// Where the hips are at the nth pose: nearly to the wall and back, then into it.
double swing(std::int64_t n) {
  const auto x = static_cast<double>(n);
  return 0.6 + (0.335 + 0.002 * x) * std::sin(0.3 * x);
}

class PersonStreams : public testing::Test {
 protected:
  void begin(MotionModel model, const BoundsFile& file = bounds(),
             std::int64_t aheadUs = kAheadUs) {
    solver_.emplace(StreamSolver::make(0, smallAvatar(), farWall(), {}, {}).value());
    EXPECT_EQ(solver_->take(skeletonMessage(smallSkeleton())), Reject::None);
    person_.emplace(
        PersonStream::make(0, solver_->avatar(), farWall(), {file, model, aheadUs, {}}).value());
    poses_.clear();
  }
  void follow(const PoseMessage& message) {
    ASSERT_EQ(solver_->take(message, answer_), Reject::None);
    poses_.push_back(*solver_->lastStep().to);
    person_->follow(solver_->lastStep());
    Bytes bytes;
    for (std::size_t i = 0; i < person_->numSaid(); ++i) {
      encode(person_->said(i), bytes);
      PersonMessage read;
      ASSERT_EQ(decode(bytes, read), Reject::None);
    }
  }
  /// About the pose itself: what is said of links that are known again comes after it.
  [[nodiscard]] const PersonMessage& last() {
    std::size_t i = person_->numSaid() - 1;
    while (i > 0 && person_->said(i).isOfFoundLinks()) --i;
    return person_->said(i);
  }
  std::vector<BrokenBound> brokenInGap() {
    std::vector<BrokenBound> broken = last().broken;
    const auto isAhead = [](const BrokenBound& one) {
      return one.claim == BrokenBound::Claim::Ahead;
    };
    broken.erase(std::remove_if(broken.begin(), broken.end(), isAhead), broken.end());
    return broken;
  }
  void followWithoutArm(double x, std::int64_t n) {
    PoseMessage pose = hipsAt(x, n);
    pose.joints[1].flags = 0;
    follow(pose);
  }

  std::optional<StreamSolver> solver_;
  std::optional<PersonStream> person_;
  ContactsMessage answer_;
  std::vector<Pose> poses_;
};

/// The step from the ith of these poses, as the query has it.
StepBrackets asked(const std::vector<Pose>& poses, std::size_t i, MotionModel model) {
  const auto query = BracketQuery::build(smallAvatar(), farWall()).value();
  const double seconds = static_cast<double>(kStepUs) / 1e6;
  PosedStep step;
  step.from = &poses[i];
  step.to = &poses[i + 1];
  step.seconds = step.secondsBefore = step.secondsAfter = seconds;
  if (i > 0) step.before = &poses[i - 1];
  if (model == MotionModel::CubicLate && i + 2 < poses.size()) step.after = &poses[i + 2];
  Scratch scratch;
  StepBrackets brackets;
  const std::vector<LinkBound> all(4, bounds().entries[0].bound);
  EXPECT_TRUE(query.answer(step, model, all, scratch, brackets).ok());
  return brackets;
}

void expectSaid(const PersonMessage& message, const StepBrackets& brackets) {
  std::size_t told = 0;
  ASSERT_EQ(message.verdicts.size(), brackets.links.size());
  for (std::size_t link = 0; link < brackets.links.size(); ++link) {
    const LinkBracket& bracket = brackets.links[link];
    EXPECT_EQ(message.verdicts[link], bracket.verdict);
    if (bracket.verdict == BracketVerdict::Excluded) continue;
    ASSERT_LT(told, message.brackets.size());
    const ToldBracket& one = message.brackets[told++];
    EXPECT_EQ(one.bracket.link, bracket.link);
    EXPECT_EQ(one.bracket.possibleFrom, bracket.possibleFrom);
    EXPECT_EQ(one.bracket.possibleUntil, bracket.possibleUntil);
    EXPECT_EQ(one.bracket.certainFrom, bracket.certainFrom);
    EXPECT_EQ(one.bracket.growth, bracket.growth);
    EXPECT_EQ(one.linkName, smallSkeleton().joints[link].name);
    EXPECT_EQ(one.otherName, "wall");
  }
  EXPECT_EQ(told, message.brackets.size());
}

TEST_F(PersonStreams, SayWhatTheQuerySaysOnceItsPosesAreKnown) {
  for (const MotionModel model :
       {MotionModel::ConstantRate, MotionModel::Cubic, MotionModel::CubicLate}) {
    SCOPED_TRACE(toString(model));
    begin(model);
    std::vector<PersonMessage> said;
    for (std::int64_t n = 1; n <= 60; ++n) {
      follow(hipsAt(swing(n), n));
      ASSERT_EQ(person_->numSaid(), 1U);
      if (last().kind == StepKind::Consecutive) said.push_back(last());
    }
    const std::size_t waits = model == MotionModel::CubicLate ? 1 : 0;
    ASSERT_EQ(said.size(), 59 - waits);
    std::size_t certain = 0, possible = 0;
    for (std::size_t i = 0; i < said.size(); ++i) {
      SCOPED_TRACE(i);
      const auto n = static_cast<std::int64_t>(i) + 1;
      EXPECT_EQ(said[i].sequenceFrom, n);
      EXPECT_EQ(said[i].sequenceTo, n + 1);
      EXPECT_EQ(said[i].sequence, n + 1 + static_cast<std::int64_t>(waits));
      expectSaid(said[i], asked(poses_, i, model));
      for (const ToldBracket& told : said[i].brackets) {
        ++(told.bracket.verdict == BracketVerdict::Certain ? certain : possible);
      }
    }
    EXPECT_GT(certain, 10U);
    EXPECT_GE(possible, 1U);
  }
}

TEST_F(PersonStreams, EndTheWaitWhereNoPoseCanCome) {
  begin(MotionModel::CubicLate);
  for (std::int64_t n = 1; n <= 5; ++n) follow(hipsAt(swing(n), n));
  follow(hipsAt(swing(9), 9));  // three are lost
  ASSERT_EQ(person_->numSaid(), 2U);
  EXPECT_EQ(person_->said(0).kind, StepKind::Consecutive);
  EXPECT_EQ(person_->said(0).sequenceFrom, 4);
  EXPECT_EQ(person_->said(0).sequence, 9);
  EXPECT_EQ(person_->said(1).kind, StepKind::AcrossGap);
  EXPECT_EQ(person_->said(1).sequenceFrom, 5);
  EXPECT_EQ(person_->said(1).sequenceTo, 9);
  follow(hipsAt(swing(10), 10));
  follow(hipsAt(swing(1), 1, 2));  // another session
  ASSERT_EQ(person_->numSaid(), 2U);
  EXPECT_EQ(person_->said(0).sequenceFrom, 9);
  EXPECT_EQ(person_->said(0).session, 2);
  EXPECT_EQ(person_->said(1).kind, StepKind::First);
  EXPECT_EQ(person_->said(1).sequenceFrom, 1);
  for (const BracketVerdict verdict : person_->said(1).verdicts) {
    EXPECT_EQ(verdict, BracketVerdict::Unclaimed);
  }
}

TEST_F(PersonStreams, SayTheLastStepWhenTheWaitEnds) {
  begin(MotionModel::CubicLate);
  for (std::int64_t n = 1; n <= 5; ++n) follow(hipsAt(swing(n), n));
  PersonMessage other = last();
  EXPECT_FALSE(person_->isEndOfWait(other));
  person_->endWait();
  ASSERT_EQ(person_->numSaid(), 1U);
  const PersonMessage ended = last();
  EXPECT_EQ(ended.kind, StepKind::Consecutive);
  EXPECT_EQ(ended.sequenceFrom, 4);
  EXPECT_EQ(ended.sequenceTo, 5);
  EXPECT_EQ(ended.sequence, 5);
  expectSaid(ended, asked(poses_, 3, MotionModel::CubicLate));
  Bytes bytes;
  encode(ended, bytes);
  ASSERT_EQ(decode(bytes, other), Reject::None);
  person_->endWait();
  EXPECT_EQ(person_->numSaid(), 0U);  // it is said
  EXPECT_FALSE(person_->isEndOfWait(ended));
  follow(hipsAt(swing(6), 6));  // it came after all
  ASSERT_EQ(person_->numSaid(), 1U);
  EXPECT_EQ(last().kind, StepKind::First);
  follow(hipsAt(swing(7), 7));
  ASSERT_EQ(person_->numSaid(), 1U);
  EXPECT_EQ(last().sequenceFrom, 5);
  EXPECT_EQ(last().sequenceTo, 6);
  begin(MotionModel::Cubic);
  for (std::int64_t n = 1; n <= 3; ++n) follow(hipsAt(swing(n), n));
  person_->endWait();
  EXPECT_EQ(person_->numSaid(), 0U);
}

/// What was recorded decides when a wait ended; what is said then follows from the poses.
TEST_F(PersonStreams, KnowAnEndOfAWaitThatWasRecorded) {
  begin(MotionModel::CubicLate);
  for (std::int64_t n = 1; n <= 4; ++n) follow(hipsAt(swing(n), n));
  person_->endWait();
  const PersonMessage ended = last();
  begin(MotionModel::CubicLate);
  for (std::int64_t n = 1; n <= 4; ++n) {
    EXPECT_FALSE(person_->isEndOfWait(ended));
    follow(hipsAt(swing(n), n));
  }
  EXPECT_TRUE(person_->isEndOfWait(ended));
  follow(hipsAt(swing(5), 5));
  EXPECT_FALSE(person_->isEndOfWait(ended));
}

TEST_F(PersonStreams, AskTheClockOfUncountedPosesWithItsError) {
  begin(MotionModel::Cubic);
  // 100 us at 3 m/s are nothing, and with 4 ms of a clock that is off 12 mm.
  constexpr double kFar = 0.015, kNear = 0.011;
  const auto at = [](double x, std::int64_t sequence, std::int64_t us) {
    PoseMessage message = hipsAt(x, 0);
    message.sequence = sequence;
    message.utimeUs = us;
    return message;
  };
  follow(at(0.0, kFirstUncounted, 1000));
  follow(at(kNear, kFirstUncounted + 1, 1100));
  EXPECT_EQ(last().kind, StepKind::AcrossGap);
  EXPECT_EQ(last().verdicts[0], BracketVerdict::Excluded);
  EXPECT_TRUE(last().broken.empty());
  follow(at(kNear + kFar, kFirstUncounted + 2, 1200));
  EXPECT_FALSE(last().broken.empty());
  // Without a clock nothing is claimed, and so nothing is broken.
  follow(at(-1.0, kFirstUntimed, 1300));
  EXPECT_EQ(last().kind, StepKind::AcrossGap);
  EXPECT_EQ(last().verdicts[0], BracketVerdict::Unclaimed);
  EXPECT_TRUE(last().broken.empty());
}

TEST_F(PersonStreams, ExcludeAcrossAGapWhatTheSpeedExcludes) {
  begin(MotionModel::Cubic);
  follow(hipsAt(0.0, 1));
  follow(hipsAt(0.0, 2));
  follow(hipsAt(0.0, 12));  // 0.1 s at 3 m/s: at most 15 cm of the metre, there and back
  ASSERT_EQ(last().kind, StepKind::AcrossGap);
  EXPECT_EQ(last().verdicts[0], BracketVerdict::Excluded);
  EXPECT_TRUE(last().broken.empty());
  follow(hipsAt(0.8, 62));  // half a second: 75 cm beyond either
  EXPECT_EQ(last().verdicts[0], BracketVerdict::Possible);
  EXPECT_TRUE(last().broken.empty());
  follow(hipsAt(-1.0, 72));  // 1.8 m in 0.1 s
  ASSERT_EQ(last().broken.size(), 4U);
  for (const BrokenBound& broken : last().broken) {
    EXPECT_EQ(broken.claim, BrokenBound::Claim::InGap);
    EXPECT_NEAR(broken.beyond, 1.8 - 0.1 * kSpeed, 1e-9);
  }
}

// A pose without the arm: nothing is claimed of the arm and the hand on it, in any step whose curve
// that pose bends.
TEST_F(PersonStreams, ClaimNothingOfLinksThatAPoseDoesNotKnow) {
  constexpr std::int64_t kLost = 6;
  begin(MotionModel::CubicLate);
  int unclaimed = 0;
  for (std::int64_t n = 1; n <= 14; ++n) {
    PoseMessage pose = hipsAt(0.3, n);
    if (n == kLost) pose.joints[1].flags = 0;
    follow(pose);
    if (last().kind != StepKind::Consecutive) continue;
    const bool bends = last().sequenceFrom - 1 <= kLost && kLost <= last().sequenceTo + 1;
    SCOPED_TRACE(last().sequenceFrom);
    EXPECT_EQ(last().verdicts[0], BracketVerdict::Excluded);
    EXPECT_EQ(last().verdicts[3], BracketVerdict::Excluded);
    for (const std::size_t link : {std::size_t{1}, std::size_t{2}}) {
      EXPECT_EQ(last().verdicts[link] == BracketVerdict::Unclaimed, bends);
      unclaimed += bends ? 1 : 0;
    }
    const bool isKnown = last().sequence != kLost && last().sequence != kLost + 1;
    EXPECT_EQ(last().notBeforeUs[2] >= 0, isKnown);
    EXPECT_GE(last().notBeforeUs[0], 0);
  }
  EXPECT_EQ(unclaimed, 2 * 4);
}

/// The arm and the hand on it, once they are known again: of the metre to the wall a second at
/// 3 m/s is enough, 60 ms are not.
TEST_F(PersonStreams, ExcludeOfLostLinksWhatTheirSpeedExcludes) {
  for (const auto& [model, bends] :
       {std::pair(MotionModel::CubicLate, 1), std::pair(MotionModel::Cubic, 0)}) {
    SCOPED_TRACE(toString(model));
    begin(model);
    std::vector<PersonMessage> found;
    for (std::int64_t n = 1; n <= 140; ++n) {
      const bool isLost = (n >= 6 && n <= 8) || (n >= 20 && n < 120);
      isLost ? followWithoutArm(0.0, n) : follow(hipsAt(0.0, n));
      for (std::size_t i = 0; i < person_->numSaid(); ++i) {
        if (person_->said(i).isOfFoundLinks()) found.push_back(person_->said(i));
      }
      EXPECT_TRUE(last().broken.empty());
    }
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].sequenceFrom, 5 - bends);
    EXPECT_EQ(found[0].sequenceTo, 10);
    EXPECT_EQ(found[1].sequenceFrom, 19 - bends);
    EXPECT_EQ(found[1].sequenceTo, 121);
    for (const std::size_t link : {std::size_t{1}, std::size_t{2}}) {
      EXPECT_EQ(found[0].verdicts[link], BracketVerdict::Excluded);
      EXPECT_EQ(found[1].verdicts[link], BracketVerdict::Possible);
    }
    for (const std::size_t link : {std::size_t{0}, std::size_t{3}}) {
      EXPECT_EQ(found[0].verdicts[link], BracketVerdict::Unclaimed) << "it was never lost";
      EXPECT_EQ(found[1].verdicts[link], BracketVerdict::Unclaimed);
    }
    EXPECT_TRUE(found[0].brackets.empty());
    EXPECT_EQ(found[1].brackets.size(), 2U);
  }
}

TEST_F(PersonStreams, SayWhatLostLinksDidWhenTheWaitEnds) {
  begin(MotionModel::CubicLate);
  for (std::int64_t n = 1; n <= 5; ++n) {
    n == 2 ? followWithoutArm(0.0, n) : follow(hipsAt(0.0, n));
    EXPECT_EQ(person_->numSaid(), 1U);
  }
  person_->endWait();
  ASSERT_EQ(person_->numSaid(), 2U);
  EXPECT_EQ(person_->said(0).kind, StepKind::Consecutive);
  EXPECT_TRUE(person_->said(1).isOfFoundLinks());
  EXPECT_EQ(person_->said(1).sequenceFrom, 1);
  EXPECT_EQ(person_->said(1).sequenceTo, 4);
}

TEST_F(PersonStreams, SayNothingOfLostLinksWithoutASpeedOrAKnownPose) {
  const auto numFound = [&](const BoundsFile& file, std::int64_t firstLost,
                            std::int64_t firstKnown) {
    begin(MotionModel::Cubic, file);
    std::size_t found = 0;
    for (std::int64_t n = 1; n < firstKnown + 5; ++n) {
      const bool isLost = n >= firstLost && n < firstKnown;
      isLost ? followWithoutArm(0.0, n) : follow(hipsAt(0.0, n));
      for (std::size_t i = 0; i < person_->numSaid(); ++i) {
        found += person_->said(i).isOfFoundLinks() ? 1 : 0;
      }
    }
    return found;
  };
  BoundsFile without = bounds();
  without.entries[0].bound.speed = LinkBound::kNone;
  EXPECT_EQ(numFound(bounds(), 3, 6), 1U);
  EXPECT_EQ(numFound(without, 3, 6), 0U);
  EXPECT_EQ(numFound(bounds(), 1, 6), 0U) << "nobody knows where they were";
}

TEST_F(PersonStreams, SayEachLinkFromWhereItWasLost) {
  begin(MotionModel::Cubic);
  std::vector<PersonMessage> found;
  for (std::int64_t n = 1; n <= 20; ++n) {
    PoseMessage pose = hipsAt(0.0, n);
    if (n >= 4 && n <= 12) pose.joints[2].flags = 0;  // the hand
    if (n >= 7 && n <= 12) pose.joints[3].flags = 0;  // the leg
    follow(pose);
    for (std::size_t i = 0; i < person_->numSaid(); ++i) {
      if (person_->said(i).isOfFoundLinks()) found.push_back(person_->said(i));
    }
  }
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t link = i == 0 ? 2 : 3;
    EXPECT_EQ(found[i].sequenceFrom, i == 0 ? 3 : 6);
    EXPECT_EQ(found[i].sequenceTo, 14);
    for (std::size_t other = 0; other < 4; ++other) {
      EXPECT_EQ(found[i].verdicts[other],
                other == link ? BracketVerdict::Excluded : BracketVerdict::Unclaimed);
    }
  }
}

TEST_F(PersonStreams, FollowLostLinksAcrossLostPoses) {
  begin(MotionModel::Cubic);
  for (std::int64_t n = 1; n <= 3; ++n) follow(hipsAt(0.0, n));
  followWithoutArm(0.0, 4);
  followWithoutArm(0.0, 8);  // three are lost
  ASSERT_EQ(last().kind, StepKind::AcrossGap);
  EXPECT_EQ(last().verdicts[0], BracketVerdict::Excluded);
  EXPECT_EQ(last().verdicts[1], BracketVerdict::Unclaimed);
  follow(hipsAt(0.0, 9));
  follow(hipsAt(0.0, 10));
  follow(hipsAt(0.0, 11));
  ASSERT_EQ(person_->numSaid(), 2U);
  const PersonMessage& found = person_->said(1);
  EXPECT_EQ(found.sequenceFrom, 3);
  EXPECT_EQ(found.sequenceTo, 10);
  EXPECT_EQ(found.verdicts[1], BracketVerdict::Excluded);
  // Another timeline knows nothing of them.
  followWithoutArm(0.0, 12);
  follow(hipsAt(0.0, 1, 2));
  for (std::int64_t n = 2; n < 6; ++n) {
    follow(hipsAt(0.0, n, 2));
    EXPECT_EQ(person_->numSaid(), 1U);
  }
}

TEST_F(PersonStreams, SayWhichSpeedALostLinkBreaks) {
  begin(MotionModel::Cubic);
  for (std::int64_t n = 1; n <= 3; ++n) follow(hipsAt(0.0, n));
  followWithoutArm(0.0, 4);
  follow(hipsAt(0.3, 5));  // 20 ms, then one more step that the lost pose bends
  follow(hipsAt(0.3, 6));
  EXPECT_TRUE(brokenInGap().empty());
  follow(hipsAt(0.3, 7));
  std::vector<LinkId> links;
  for (const BrokenBound& broken : brokenInGap()) {
    links.push_back(broken.link);
    EXPECT_NEAR(broken.beyond, 0.3 - 0.03 * kSpeed, 1e-9);
  }
  EXPECT_EQ(links, (std::vector<LinkId>{1, 2}));
}

/// Wherever a walk at random below the speed takes the lost arm, what it touches is not excluded.
TEST_F(PersonStreams, NeverExcludeWhatALostLinkTouched) {
  int touched = 0, excluded = 0;
  for (int run = 0; run < 200; ++run) {
    SCOPED_TRACE(run);
    begin(run % 2 == 0 ? MotionModel::CubicLate : MotionModel::Cubic);
    const std::int64_t firstLost = 4 + run % 3, numLost = 1 + run % 40;
    double x = 0.3;
    bool hasTouched = false, wasFound = false;
    for (std::int64_t n = 1; n < firstLost + numLost + 6; ++n) {
      const bool isLost = n >= firstLost && n < firstLost + numLost;
      isLost ? followWithoutArm(x, n) : follow(hipsAt(x, n));
      const bool isInGap = n >= firstLost - 1 && n <= firstLost + numLost;
      hasTouched = hasTouched || (isInGap && x + 0.05 >= 1.0);
      const double phase = static_cast<double>(n) / static_cast<double>(5 + run % 11);
      x += 0.99 * kSpeed * static_cast<double>(kStepUs) / 1e6 * std::sin(phase);
      for (std::size_t i = 0; i < person_->numSaid(); ++i) {
        const PersonMessage& said = person_->said(i);
        if (!said.isOfFoundLinks()) continue;
        wasFound = true;
        EXPECT_TRUE(brokenInGap().empty());
        const bool isExcluded = said.verdicts[1] == BracketVerdict::Excluded;
        EXPECT_FALSE(isExcluded && hasTouched);
        touched += hasTouched ? 1 : 0;
        excluded += isExcluded ? 1 : 0;
      }
    }
    EXPECT_TRUE(wasFound);
  }
  EXPECT_GT(touched, 10);
  EXPECT_GT(excluded, 10);
}

TEST_F(PersonStreams, ClaimNothingAtRatesThatNoBoundIsAbout) {
  begin(MotionModel::Cubic, bounds(100.0));
  follow(hipsAt(0.0, 1));
  follow(hipsAt(0.0, 2));
  EXPECT_EQ(last().verdicts[0], BracketVerdict::Excluded);
  PoseMessage late = hipsAt(0.0, 3);
  late.utimeUs += kStepUs;  // 20 ms after the last one
  follow(late);
  EXPECT_EQ(last().kind, StepKind::Consecutive);
  EXPECT_EQ(last().verdicts[0], BracketVerdict::Unclaimed);
  EXPECT_EQ(last().notBeforeUs[0], -1);
  // Of a gap the rate is that of the lost poses.
  PoseMessage across = hipsAt(0.0, 13);
  across.utimeUs = late.utimeUs + 10 * kStepUs;
  follow(across);
  EXPECT_EQ(last().kind, StepKind::AcrossGap);
  EXPECT_EQ(last().verdicts[0], BracketVerdict::Excluded);
}

// A person who keeps the bounds: brakes and accelerates at random, within what is claimed.
TEST_F(PersonStreams, TouchNothingBeforeTheySay) {
  for (int run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    begin(MotionModel::Cubic);
    double x = 0.2, previous = 0.2 - 0.004 * (run % 5);
    std::vector<std::int64_t> notBefore(4, 0);
    std::optional<std::int64_t> touchedUs;
    for (std::int64_t n = 1; n < 200 && !touchedUs; ++n) {
      follow(hipsAt(x, n));
      ASSERT_TRUE(last().broken.empty());
      for (std::size_t link = 0; link < 4 && n > 1; ++link) {
        EXPECT_GE(last().notBeforeUs[link], notBefore[link]) << "never falls";
        notBefore[link] = last().notBeforeUs[link];
      }
      // Half the acceleration of poses is the half of their second difference.
      const double dt = static_cast<double>(kStepUs) / 1e6;
      const double bend = 0.5 * kAheadAcceleration * dt * dt;
      const double next = 2.0 * x - previous + bend * std::sin(static_cast<double>(n * (run + 3)));
      previous = std::exchange(x, next);
      if (x + 0.05 >= 1.0) touchedUs = (n + 1) * kStepUs;  // at the latest
    }
    if (!touchedUs) continue;
    EXPECT_LE(notBefore[0], *touchedUs);
  }
}

TEST_F(PersonStreams, SayWhichBoundTheNextPoseBreaks) {
  begin(MotionModel::Cubic);
  follow(hipsAt(0.0, 1));
  follow(hipsAt(0.0, 2));
  const std::int64_t before = last().notBeforeUs[0];
  follow(hipsAt(0.1, 3));
  ASSERT_EQ(last().broken.size(), 4U);
  EXPECT_EQ(last().broken[0].claim, BrokenBound::Claim::Ahead);
  EXPECT_NEAR(last().broken[0].beyond, 0.1 - 0.5 * kAheadAcceleration * 1e-4, 1e-9);
  EXPECT_LT(last().notBeforeUs[0], before) << "what rested on it is taken back";
}

TEST_F(PersonStreams, DoNotLookAheadUnlessAsked) {
  begin(MotionModel::Cubic, bounds(), 0);
  for (std::int64_t n = 1; n < 5; ++n) {
    follow(hipsAt(0.1 * static_cast<double>(n * n), n));
    EXPECT_EQ(last().aheadUs, 0);
    EXPECT_EQ(last().notBeforeUs, std::vector<std::int64_t>(4, -1));
    EXPECT_TRUE(last().broken.empty());
  }
}

TEST_F(PersonStreams, RepeatEveryByte) {
  const auto bytesOfRun = [&] {
    begin(MotionModel::CubicLate);
    std::vector<Bytes> all;
    for (std::int64_t n = 1; n < 120; ++n) {
      PoseMessage pose = hipsAt(swing(n), n + n / 40);
      if (n % 7 == 3) pose.joints[2].flags = 0;
      follow(pose);
      for (std::size_t i = 0; i < person_->numSaid(); ++i) {
        Bytes bytes;
        encode(person_->said(i), bytes);
        const ByteView repeated = verdictBytes(bytes);
        all.emplace_back(repeated.data, repeated.data + repeated.size);
      }
    }
    return all;
  };
  EXPECT_EQ(bytesOfRun(), bytesOfRun());
}

TEST(PersonStreamOptions, ThatAreRefusedAreNamed) {
  const auto made = [](const PersonStreamOptions& options) {
    return PersonStream::make(0, smallAvatar(), farWall(), options);
  };
  const auto far = made({bounds(), MotionModel::Cubic, kMostAheadUs + 1, {}});
  ASSERT_FALSE(far.ok());
  EXPECT_EQ(far.error().file, "ahead");
  BoundsFile of = bounds(30.0);
  of.entries[0].model = MotionModel::CubicLate;
  const auto other = made({of, MotionModel::Cubic, 0, {}});
  ASSERT_FALSE(other.ok());
  EXPECT_NE(describe(other.error()).find("cubic-late at 30 Hz"), std::string::npos);
  of.entries[0].model = MotionModel::Cubic;
  of.entries[0].part.clear();
  of.entries[0].link = "Hands";
  const auto named = made({of, MotionModel::Cubic, 0, {}});
  ASSERT_FALSE(named.ok());
  EXPECT_NE(describe(named.error()).find("'Hands'"), std::string::npos);
}

}  // namespace
}  // namespace foretouch
