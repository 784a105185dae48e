// What brackets say of two bodies that both move: two balls in closed form, and random bodies by
// samples of the judge's own motion.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "middleware/bracket/bracket.h"
#include "tests/middleware/balls.h"
#include "tests/middleware/own_body.h"
#include "tests/support/random_motion.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

LinkBound boundOf(double most, double seconds, double error = 0.0) {
  LinkBound bound;
  bound.acceleration = 8.0 * most / (seconds * seconds);
  bound.error = error;
  return bound;
}

Pose ballAt(double x) {
  Pose pose;
  pose.rotations = {Quaternion::Identity()};
  pose.translations = {Vector3d(x, 0.0, 0.0)};
  return pose;
}

double rhoAt(double most, double u) {
  return 4.0 * most * u * (1.0 - u);
}

/// Two balls of 10 cm; one comes at 1 m/s from 1 m away, the other stands.
class TwoBalls : public testing::Test {
 protected:
  static constexpr double kRadius = 0.1, kMost = 0.01;
  static constexpr double kOneS = 1.2, kOtherS = 0.4;
  const Pose oneFrom_ = ballAt(-1.0), oneTo_ = ballAt(0.2), other_ = ballAt(0.0);
  const std::vector<LinkBound> ofOne_{boundOf(kMost, kOneS)}, ofOther_{boundOf(kMost, kOtherS)};
  PersonStep one_{
      {nullptr, &oneFrom_, &oneTo_, nullptr, 0.0, kOneS, 0.0}, MotionModel::ConstantRate, &ofOne_};
  PersonStep standing_{{nullptr, &other_, &other_, nullptr, 0.0, kOtherS, 0.0},
                       MotionModel::ConstantRate,
                       &ofOther_};
  PairBracketQuery query_ =
      PairBracketQuery::build(test::ball(kRadius), test::ball(kRadius), {}).value();
  Scratch scratch_;
  StepBrackets brackets_;
};

TEST_F(TwoBalls, PartsOfALongStepAreAskedWithTheGrowthThatTheyHave) {
  // The other's third step, from 0.8 to 1.2 s: the balls meet at 0.8 s but for the growths.
  one_.begin = 2.0 / 3.0;
  const auto gap = [](double t) { return 1.0 - (0.8 + 0.4 * t) - 2.0 * kRadius; };
  const auto growth = [](double t) {
    return rhoAt(kMost, (0.8 + 0.4 * t) / kOneS) + rhoAt(kMost, t);
  };
  ASSERT_TRUE(query_.answer(one_, standing_, scratch_, brackets_).ok());
  EXPECT_TRUE(brackets_.links.empty());
  ASSERT_EQ(brackets_.pairs.size(), 1u);
  const LinkBracket& bracket = brackets_.pairs[0];
  EXPECT_EQ(bracket.verdict, BracketVerdict::Certain);
  EXPECT_EQ(bracket.possibleFrom, 0.0);  // 8.9 mm of growth, and no gap
  double surely = 0.0;
  while (gap(surely) > -growth(surely)) surely += 1e-6;
  EXPECT_NEAR(bracket.certainFrom, surely, 1e-4);
  EXPECT_NEAR(bracket.growth, 2.0 * kMost, 1e-9);

  one_.begin = 1.0 / 3.0;
  one_.end = 2.0 / 3.0;  // the second step, from 0.4 to 0.8 s
  ASSERT_TRUE(query_.answer(one_, standing_, scratch_, brackets_).ok());
  ASSERT_EQ(brackets_.pairs.size(), 1u);
  double first = 0.0;
  const auto before = [&](double t) {
    return 1.0 - (0.4 + 0.4 * t) - 2.0 * kRadius - rhoAt(kMost, (0.4 + 0.4 * t) / kOneS) -
           rhoAt(kMost, t);
  };
  while (before(first) > 0.0) first += 1e-6;
  EXPECT_NEAR(brackets_.pairs[0].possibleFrom, first, 1e-4);

  one_.begin = 0.0;
  one_.end = 1.0 / 3.0;
  ASSERT_TRUE(query_.answer(one_, standing_, scratch_, brackets_).ok());
  EXPECT_TRUE(brackets_.pairs.empty());
}

TEST_F(TwoBalls, WithoutTheBoundOfEitherNothingIsClaimed) {
  const std::vector<LinkBound> none{LinkBound{}};
  one_.bounds = &none;
  ASSERT_TRUE(query_.answer(one_, standing_, scratch_, brackets_).ok());
  ASSERT_EQ(brackets_.pairs.size(), 1u);
  EXPECT_EQ(brackets_.pairs[0].verdict, BracketVerdict::Unclaimed);
}

TEST_F(TwoBalls, RefusesPartsThatAreNoneAndBoundsOfNobody) {
  for (const auto& [begin, end] : {std::pair{0.5, 0.5}, {-0.1, 1.0}, {0.0, 1.1}, {0.0, NAN}}) {
    one_.begin = begin;
    one_.end = end;
    const auto refused = query_.answer(one_, standing_, scratch_, brackets_);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().file, "one");
  }
  one_.begin = 0.0;
  one_.end = 1.0;
  const std::vector<LinkBound> nobodys;
  standing_.bounds = &nobodys;
  const auto refused = query_.answer(one_, standing_, scratch_, brackets_);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().file, "other");
}

// ---- Random bodies ----

Vector3d placed(const oracle::PreciseFrame& frame, const Vector3d& p_L) {
  const auto p = frame.at(p_L);
  return {test::asDouble(p.x), test::asDouble(p.y), test::asDouble(p.z)};
}

/// The least distance of two segments, by a search over one and a foot on the other: convex.
double segmentDistance(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const auto fromOther = [&](double s) {
    const Vector3d p = a + s * (b - a), along = d - c;
    const double square = along.squaredNorm();
    const double t = square > 0.0 ? std::clamp((p - c).dot(along) / square, 0.0, 1.0) : 0.0;
    return (p - c - t * along).norm();
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 80; ++i) {
    const double third = (high - low) / 3.0;
    if (fromOther(low + third) < fromOther(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return fromOther(0.5 * (low + high));
}

double gapOf(const Avatar& one, LinkId link, const oracle::PreciseFrame& frame, const Avatar& other,
             LinkId otherLink, const oracle::PreciseFrame& otherFrame) {
  double least = std::numeric_limits<double>::infinity();
  for (const Lss& x : one.lss(link)) {
    for (const Lss& y : other.lss(otherLink)) {
      const double distance = segmentDistance(placed(frame, x.a), placed(frame, x.b),
                                              placed(otherFrame, y.a), placed(otherFrame, y.b));
      least = std::min(least, distance - x.radius - y.radius);
    }
  }
  return least;
}

/// A body near the origin, at constant rates, and the part of its step that is asked.
struct Walker {
  explicit Walker(test::Random& random) : body(test::randomOwnBody(random)) {
    for (Pose* const pose : {&body.steps.from, &body.steps.to}) {
      pose->translations[0] = random.inBox(0.2);
    }
    body.steps.precise = test::plainJoints(body.avatar.skeleton(), body.steps.from, body.steps.to);
    begin = random.chance(0.3) ? 0.0 : random.uniform(0.0, 0.6);
    end = random.chance(0.3) ? 1.0 : begin + random.uniform(0.05, 0.35);
    most = random.magnitude(1e-4, 0.03);
    bounds.assign(static_cast<std::size_t>(body.avatar.numLinks()), boundOf(most, 1.0));
  }
  [[nodiscard]] double at(double t) const { return begin + t * (end - begin); }
  [[nodiscard]] PersonStep step() const {
    return {{nullptr, &body.steps.from, &body.steps.to, nullptr, 0.0, 1.0, 0.0},
            MotionModel::ConstantRate,
            &bounds,
            begin,
            end};
  }
  [[nodiscard]] std::vector<oracle::PreciseFrame> framesAt(double t) const {
    return oracle::preciseFrames(body.steps.precise, oracle::Precise(at(t)));
  }
  test::OwnBody body;
  double begin, end, most;
  std::vector<LinkBound> bounds;
};

TEST(PairBrackets, HoldOfRandomBodiesWhateverPartOfTheirStepsIsAsked) {
  constexpr double kSlack = 1e-9;
  test::Random random(147);
  int certain = 0, possible = 0, excluded = 0;
  for (int round = 0; round < 20; ++round) {
    const Walker one(random), other(random);
    const Avatar &a = one.body.avatar, &b = other.body.avatar;
    const auto query = PairBracketQuery::build(a, b, {}).value();
    Scratch scratch;
    StepBrackets brackets;
    ASSERT_TRUE(query.answer(one.step(), other.step(), scratch, brackets).ok());
    const auto growthAt = [&](double t) {
      return rhoAt(one.most, one.at(t)) + rhoAt(other.most, other.at(t));
    };
    const auto bracketOf = [&](LinkId link, LinkId otherLink) {
      const auto found = std::find_if(brackets.pairs.begin(), brackets.pairs.end(),
                                      [&](const LinkBracket& bracket) {
                                        return bracket.link == link && bracket.other == otherLink;
                                      });
      LinkBracket none;
      none.verdict = BracketVerdict::Excluded;
      return found == brackets.pairs.end() ? none : *found;
    };
    for (int i = 0; i <= 16; ++i) {
      const double t = i / 16.0;
      const auto frames = one.framesAt(t), otherFrames = other.framesAt(t);
      for (LinkId link = 0; link < a.numLinks(); ++link) {
        for (LinkId otherLink = 0; otherLink < b.numLinks(); ++otherLink) {
          if (a.lss(link).empty() || b.lss(otherLink).empty()) continue;
          const double gap = gapOf(a, link, frames[static_cast<std::size_t>(link)], b, otherLink,
                                   otherFrames[static_cast<std::size_t>(otherLink)]);
          if (gap > growthAt(t) - kSlack) continue;
          const LinkBracket bracket = bracketOf(link, otherLink);
          EXPECT_NE(bracket.verdict, BracketVerdict::Excluded) << round << " at " << t;
          EXPECT_LE(bracket.possibleFrom, t) << round;
          EXPECT_GE(bracket.possibleUntil, t) << round;
        }
      }
    }
    for (const LinkBracket& bracket : brackets.pairs) {
      ++(bracket.verdict == BracketVerdict::Certain ? certain : possible);
      if (bracket.verdict != BracketVerdict::Certain) continue;
      for (const double t : {bracket.certainFrom, bracket.certainUntil}) {
        const double gap =
            gapOf(a, bracket.link, one.framesAt(t)[static_cast<std::size_t>(bracket.link)], b,
                  bracket.other, other.framesAt(t)[static_cast<std::size_t>(bracket.other)]);
        EXPECT_LE(gap, -growthAt(t) + kSlack) << round << " at " << t;
      }
    }
    excluded += a.numLinks() * b.numLinks() - static_cast<int>(brackets.pairs.size());
  }
  EXPECT_GT(certain, 10);
  EXPECT_GT(possible, 10);
  EXPECT_GT(excluded, 100);
}

}  // namespace
}  // namespace foretouch
