// What a world remembers and lets go of. Thinned worlds against the judge's own, which keeps every
// pose that was pushed: carriers, clocks and all.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/ask/ask.h"
#include "middleware/events/world_follower.h"
#include "middleware/world/world_parts.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/world/random_worlds.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::BothWorlds;
using test::OracleBody;
using test::OracleEpisode;
using test::OraclePart;
using test::OracleWorld;
using test::Random;
using test::Real;

/// Corners in the judge's world are rounded to doubles.
constexpr Real kJudged = 1e-12L;
constexpr std::int64_t kEndUs = 1'000'000;

/// A walker whose joints swing.
struct Swinger {
  test::Walker walker;
  std::vector<Vector3d> axes;
  double rate;

  static Swinger drawn(Random& random, const Vector3d& place) {
    Swinger made{test::randomWalker(random, place, 0.5), {}, random.uniform(2.0, 15.0)};
    for (std::size_t j = 0; j < made.walker.turns.size(); ++j) {
      made.axes.push_back(random.direction());
    }
    return made;
  }
  [[nodiscard]] Pose at(std::int64_t us) const {
    Pose pose = restPose(walker.avatar.skeleton());
    const double seconds = 1e-6 * static_cast<double>(us);
    for (std::size_t j = 0; j < axes.size(); ++j) {
      const double half = 0.3 * std::sin(rate * (seconds + static_cast<double>(j)));
      const Vector3d v = std::sin(half) * axes[j];
      pose.rotations[j] = pose.rotations[j] * Quaternion(std::cos(half), v.x(), v.y(), v.z());
    }
    pose.translations[0] += seconds * walker.drift;
    return pose;
  }
};

/// Three who swing, of whom the second is carried by the first from 400 ms on and moves there; and
/// two things: the one is held by the second from 250 ms to 700 ms, the other flies about. So for a
/// while one holds what is held by one who is carried.
class Remembered {
 public:
  explicit Remembered(std::uint64_t seed) : random(seed), both(1e-3) {
    for (int i = 0; i < 3; ++i) {
      swingers_.push_back(Swinger::drawn(random, random.inBox(0.5)));
      BodyOptions options;
      const Avatar& avatar = swingers_.back().walker.avatar;
      if (random.chance(0.4)) options.surface = test::randomSurface(avatar, random);
      EXPECT_EQ(both.add(avatar, options), i);
      periods_.push_back(4000 + random.below(8000));
    }
    for (int i = 3; i < 5; ++i) {
      both.add(test::randomMesh(random));
      periods_.push_back(5000 + random.below(20'000));
    }
  }

  /// All poses until then, of each by its own clock.
  void play(std::int64_t untilUs) {
    for (BodyId body = 0; body < 5; ++body) {
      std::int64_t& next = next_[slotOf(body)];
      while (next <= untilUs) {
        if (body == 3 && isHeld_ && next > kLetGoUs) letGo();
        if (body != 3 || !isHeld_) push(body, next);
        next += periods_[slotOf(body)];
      }
    }
    const LinkId last = swingers_[1].walker.avatar.numLinks() - 1;
    if (!isCarried_ && untilUs >= kCarriedUs + 20'000) {
      both.attach(1, {0, 0, true}, kCarriedUs, swingers_[1].at(kCarriedUs));
      next_[1] = std::max(next_[1], kCarriedUs + 1);
      isCarried_ = true;
    }
    if (!isHeld_ && !wasHeld_ && untilUs >= kHeldUs + 40'000) {
      both.attach(3, {1, last, false}, kHeldUs, RigidPose{random.rotation(), random.inBox(0.4)});
      isHeld_ = wasHeld_ = true;
    }
  }

  /// The judge's world of the poses that are left.
  [[nodiscard]] OracleWorld left() const {
    OracleWorld world = both.oracle;
    const internal::WorldParts& parts = both.world.parts();
    for (BodyId body = 0; body < 5; ++body) {
      for (std::size_t e = 0; e < parts.body(body).episodes.size(); ++e) {
        const Track& track = parts.body(body).episodes[e].track;
        OracleEpisode &all = world.bodies[slotOf(body)].episodes[e], kept = all;
        kept.times.clear();
        kept.poses.clear();
        for (std::size_t k = 0; k < all.times.size(); ++k) {
          if (track.pieceAt(all.times[k]).beginUs != all.times[k]) continue;
          kept.times.push_back(all.times[k]);
          kept.poses.push_back(all.poses[k]);
        }
        EXPECT_EQ(kept.times.size(), track.numKnots());
        all = kept;
      }
    }
    return world;
  }

  [[nodiscard]] std::size_t numPushed() const {
    std::size_t sum = 0;
    for (const OracleBody& body : both.oracle.bodies) {
      for (const OracleEpisode& episode : body.episodes) sum += episode.times.size();
    }
    return sum;
  }
  [[nodiscard]] std::size_t numLeft() const {
    std::size_t sum = 0;
    for (const internal::WorldBody& body : both.world.parts().bodies) {
      for (const internal::Episode& episode : body.episodes) sum += episode.track.numKnots();
    }
    return sum;
  }

  static constexpr std::int64_t kCarriedUs = 400'000, kHeldUs = 250'000, kLetGoUs = 700'000;
  Random random;
  BothWorlds both;

 private:
  void push(BodyId body, std::int64_t us) {
    if (body < 3) {
      both.push(body, us, swingers_[slotOf(body)].at(us));
      return;
    }
    const double seconds = 1e-6 * static_cast<double>(us);
    const double half = 1.5 * std::sin(7.0 * seconds + body);
    both.push(body, us,
              RigidPose{Quaternion(std::cos(half), 0.0, std::sin(half), 0.0),
                        Vector3d(std::sin(3.0 * seconds), 0.2 * body, seconds * seconds)});
  }
  void letGo() {
    both.detach(3, kLetGoUs, RigidPose{random.rotation(), random.inBox(1.0)});
    isHeld_ = false;
  }

  std::vector<Swinger> swingers_;
  std::vector<std::int64_t> periods_;
  std::vector<std::int64_t> next_ = std::vector<std::int64_t>(5, 0);
  bool isCarried_ = false, isHeld_ = false, wasHeld_ = false;
};

/// The farthest that any corner of any body is from where it is in the other world.
Real farthest(const OracleWorld& one, const OracleWorld& other, Random& random, int draws) {
  Real worst = 0;
  for (int i = 0; i < draws; ++i) {
    const Real us = static_cast<Real>(random.uniform(0.0, static_cast<double>(kEndUs)));
    for (int body = 0; body < 5; ++body) {
      const std::vector<OraclePart> then = one.partsAt(body, -1, 0, us);
      const std::vector<OraclePart> now = other.partsAt(body, -1, 0, us);
      EXPECT_EQ(then.size(), now.size());
      for (std::size_t p = 0; p < then.size(); ++p) {
        for (std::size_t c = 0; c < 3; ++c) {
          worst =
              std::max(worst, norm(then[p].corners[c].as<Real>() - now[p].corners[c].as<Real>()));
        }
      }
    }
  }
  return worst;
}

TEST(WorldHistory, ThinningMovesNoPointFartherThanSaid) {
  Real tightest = 0;
  std::size_t left = 0, pushed = 0;
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Remembered past(static_cast<std::uint64_t>(seed));
    const double metres = past.random.magnitude(1e-5, 5e-2);
    const std::int64_t stepUs = 20'000 + past.random.below(400'000);
    for (std::int64_t us = 0; us < kEndUs + stepUs; us += stepUs) {
      past.play(us + 60'000);
      ASSERT_TRUE(past.both.world.thinBefore(us, metres).ok());
    }
    const Real moved = farthest(past.both.oracle, past.left(), past.random, 60);
    ASSERT_LE(moved, static_cast<Real>(metres) + kJudged);
    tightest = std::max(tightest, moved / static_cast<Real>(metres));
    left += past.numLeft();
    pushed += past.numPushed();
  }
  EXPECT_GT(tightest, 0.2L);
  EXPECT_LT(left, 4 * pushed / 5);
}

/// What a world was told, asked at instants of its past: the distance of a point from each body.
std::vector<double> distancesIn(const World& world, std::uint64_t seed) {
  Random random(seed);
  Scratch scratch;
  WorldAnswer answer;
  std::vector<double> distances;
  for (int i = 0; i < 100; ++i) {
    const Vector3d from = random.inBox(2.0);
    WorldQuestion question =
        WorldQuestion::nearest({from, from, 0.0}, 50.0, {random.below(kEndUs), 0.5});
    question.only = {{random.below(5), kEveryLink, kEveryObject}};
    EXPECT_TRUE(askWorld(world, question, scratch, answer).ok());
    distances.push_back(answer.hits.empty() ? 100.0 : answer.hits.front().distance);
  }
  return distances;
}

TEST(WorldHistory, AnswersAboutThePastMoveByNoMoreThanSaid) {
  double most = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Remembered all(seed), thinned(seed);
    const double metres = 0.01;
    for (std::int64_t us = 0; us <= kEndUs; us += 50'000) {
      all.play(us + 60'000);
      thinned.play(us + 60'000);
      ASSERT_TRUE(thinned.both.world.thinBefore(us, metres).ok());
    }
    const std::vector<double> then = distancesIn(all.both.world, seed);
    const std::vector<double> now = distancesIn(thinned.both.world, seed);
    for (std::size_t i = 0; i < then.size(); ++i) {
      ASSERT_LE(std::abs(then[i] - now[i]), metres + kAskTolerance);
      most = std::max(most, std::abs(then[i] - now[i]));
    }
  }
  EXPECT_GT(most, 1e-4);
}

/// Everything that is told of one who follows it, to the bit, and the contacts of a window.
std::string toldBy(World& world, WorldFollower& follower, std::int64_t untilUs) {
  WorldEvents events;
  std::string told;
  EXPECT_TRUE(follower.follow(world, untilUs, events).ok());
  for (const WorldEvent& event : events.events) {
    char line[200];
    std::snprintf(line, sizeof line, "%d %d.%d %d.%d %lld %a %a\n", static_cast<int>(event.kind),
                  event.a.body, event.a.link, event.b.body, event.b.link,
                  static_cast<long long>(event.time.us), event.time.fraction, event.a.p_W.x());
    told += line;
  }
  return told;
}

TEST(WorldHistory, WhoFollowsIsToldTheSame) {
  std::size_t events = 0, dropped = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Remembered all(seed), thinned(seed);
    WorldFollower ofAll = WorldFollower::start(0).value();
    WorldFollower ofThinned = WorldFollower::start(0).value();
    for (std::int64_t us = 30'000; us <= kEndUs; us += 30'000) {
      all.play(us + 60'000);
      thinned.play(us + 60'000);
      const std::string told = toldBy(all.both.world, ofAll, us);
      ASSERT_EQ(told, toldBy(thinned.both.world, ofThinned, us));
      events += static_cast<std::size_t>(std::count(told.begin(), told.end(), '\n'));
      ASSERT_TRUE(thinned.both.world.thinBefore(us, 0.05).ok());
    }
    dropped += thinned.numPushed() - thinned.numLeft();
  }
  EXPECT_GT(events, 200u);
  EXPECT_GT(dropped, 2000u);
}

// What a question or a window keeps of the past is no longer true once poses have gone: whoever
// has asked before is told what somebody is told who asks for the first time.
TEST(WorldHistory, WhoHasAskedBeforeIsToldTheSame) {
  std::size_t contacts = 0, hits = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Remembered past(seed);
    World& world = past.both.world;
    for (std::int64_t us = 0; us <= kEndUs; us += 50'000) past.play(us);
    Scratch before;
    for (const double metres : {0.0, 0.003, 0.03}) {
      ASSERT_TRUE(world.thinBefore(900'000, metres).ok());
      for (std::int64_t us = 0; us < 900'000; us += 30'000) {
        Scratch anew;
        WorldContacts one, other;
        ASSERT_TRUE(world.contacts(us, us + 30'000, before, one).ok());
        ASSERT_TRUE(world.contacts(us, us + 30'000, anew, other).ok());
        ASSERT_EQ(one.contacts.size(), other.contacts.size());
        for (std::size_t i = 0; i < one.contacts.size(); ++i) {
          EXPECT_EQ(one.contacts[i].time, other.contacts[i].time);
          EXPECT_EQ(one.contacts[i].a.p_W, other.contacts[i].a.p_W);
        }
        contacts += one.contacts.size();
        WorldAnswer first, second;
        for (int i = 0; i < 4; ++i) {
          const Vector3d from = past.random.inBox(2.0), to = past.random.inBox(1.0);
          const auto ray = WorldQuestion::ray(from, to - from, 10.0, {us, 0.25});
          ASSERT_TRUE(askWorld(world, ray, before, first).ok());
          ASSERT_TRUE(askWorld(world, ray, anew, second).ok());
          ASSERT_EQ(first.hits.size(), second.hits.size());
          if (first.hits.empty()) continue;
          EXPECT_EQ(first.hits[0].distance, second.hits[0].distance);
          EXPECT_EQ(first.hits[0].what.p_W, second.hits[0].what.p_W);
          ++hits;
        }
      }
    }
  }
  EXPECT_GT(contacts, 1000u);
  EXPECT_GT(hits, 300u);
}

// Of one link that carries another body's whole arm, as of a hand with a long tool.
TEST(WorldHistory, WhatIsCarriedCountsToTheReach) {
  const auto keptWith = [](double length) {
    World world = World::build(std::nullopt).value();
    RawSkeleton raw;
    raw.joints = {{"root", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
    const Avatar hand =
        Avatar::build(Skeleton::build(raw).value(), {{{Vector3d::Zero(), Vector3d::Zero(), 0.05}}})
            .value();
    EXPECT_EQ(world.add(hand).value(), 0);
    EXPECT_EQ(world.add(hand).value(), 1);
    for (int i = 0; i <= 100; ++i) {
      const double half = 0.3 * std::sin(0.1 * i);
      EXPECT_TRUE(
          world
              .push(0, 10'000 * i,
                    RigidPose{Quaternion(std::cos(half), 0, std::sin(half), 0), Vector3d::Zero()})
              .ok());
    }
    const RigidPose atEnd{Quaternion::Identity(), Vector3d(length, 0, 0)};
    if (length > 0.0) {
      EXPECT_TRUE(world.push(1, 0, atEnd).ok());
      EXPECT_TRUE(world.push(1, 1, atEnd).ok());
      EXPECT_TRUE(world.attach(1, {0, 0, false}, 1, atEnd).ok());
    }
    EXPECT_TRUE(world.thinBefore(1'000'000, 1e-3).ok());
    return world.parts().body(0).episodes.front().track.numKnots();
  };
  const std::size_t alone = keptWith(0.0), tool = keptWith(1.0), pole = keptWith(100.0);
  EXPECT_LT(alone, tool);
  EXPECT_LT(tool, pole);
}

TEST(WorldHistory, RefusesByName) {
  Remembered past(1);
  past.play(300'000);
  World& world = past.both.world;
  for (const double metres : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto refused = world.thinBefore(100'000, metres);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(describe(refused.error()).find("metres"), std::string::npos);
  }
  ASSERT_TRUE(world.thinBefore(150'000, 0.01).ok());
  const RigidPose anywhere;
  const auto late = world.attach(4, {0, 0, false}, 149'999, anywhere);
  ASSERT_FALSE(late.ok());
  EXPECT_NE(describe(late.error()).find("all before 150000 us is thinned"), std::string::npos)
      << describe(late.error());
  EXPECT_TRUE(world.attach(4, {0, 0, false}, 150'000, anywhere).ok());
}

TEST(WorldHistory, KeepsAsManyBytesAsItIsTold) {
  Remembered past(2);
  for (std::int64_t us = 0; us <= kEndUs; us += 50'000) past.play(us);
  World& world = past.both.world;
  const std::size_t all = world.poseBytes();
  EXPECT_EQ(world.forgetBeyond(all), -kMostUtimeUs) << "all of it may stay";
  EXPECT_EQ(world.poseBytes(), all);
  std::int64_t before = 0;
  for (const std::size_t share : {2, 4, 8}) {
    const std::int64_t us = world.forgetBeyond(all / share);
    EXPECT_LE(world.poseBytes(), all / share);
    EXPECT_GT(world.poseBytes(), all / share - all / 40);
    EXPECT_GT(us, before);
    before = us;
  }
  // Windows from there on are answered, those that begin before are not.
  Scratch scratch;
  WorldContacts answer;
  EXPECT_TRUE(world.contacts(before, before + 1000, scratch, answer).ok());
  EXPECT_FALSE(world.contacts(before - 1, before + 1000, scratch, answer).ok());
  // The last poses stay, however little is allowed.
  EXPECT_EQ(world.forgetBeyond(0), *world.knownUntilUs());
  EXPECT_GT(world.poseBytes(), 0u);
}

}  // namespace
}  // namespace foretouch
