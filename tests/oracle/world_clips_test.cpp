// Real clips in one world, each held against the judge's own: everybody against everybody at rates
// of their own, a ring thrown through them, a sword in the hand.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/middleware/world/both_worlds.h"
#include "tests/oracle/sweep_inputs.h"
#include "tests/support/random_geometry.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// Those that move; one more than a person has links is left to other tests.
const char* const kClips[] = {"bandai1_dance-short_normal_001.bvh",
                              "bandai1_kick_normal_001.bvh",
                              "bandai1_slash_normal_001.bvh",
                              "cmu_01_01_playground_jumps.bvh",
                              "fair_dab.bvh",
                              "cmu_cgspeed_walk_crlf.bvh"};

/// Where somebody walks while he dances.
struct Walk {
  Placement place;
  Vector3d speed = Vector3d::Zero();  // m/s
};

/// The clip's poses from its middle on, at about `rateHz`, from `offsetUs` on.
void dance(BothWorlds& both, BodyId body, const SweepClip& clip, double rateHz,
           std::int64_t offsetUs, std::int64_t untilUs, const Walk& walk) {
  const int stride = strideFor(clip.clip, rateHz);
  const auto periodUs =
      static_cast<std::int64_t>(std::llround(1e6 * clip.clip.frameTimeS * stride));
  std::size_t frame = clip.clip.frames.size() / 2;
  for (std::int64_t us = offsetUs; us < untilUs + periodUs; us += periodUs) {
    Pose pose = clip.clip.frames[frame];
    pose.translations[0] -= clip.standsAt;
    Placement place = walk.place;
    place.position += 1e-6 * static_cast<double>(us) * walk.speed;
    both.push(body, us, placed(clip.avatar.skeleton(), pose, place));
    frame = std::min(frame + static_cast<std::size_t>(stride), clip.clip.frames.size() - 1);
  }
}

/// A ring of `segments` quads about y.
Scene ring(double radius, double height, int segments) {
  RawScene raw;
  raw.objectNames = {"ring"};
  for (int i = 0; i < segments; ++i) {
    const auto at = [&](int k, double y) {
      const double angle = 2.0 * std::acos(-1.0) * k / segments;
      return Vector3d(radius * std::cos(angle), y, radius * std::sin(angle));
    };
    raw.triangles.push_back({{at(i, 0), at(i + 1, 0), at(i + 1, height)}});
    raw.triangles.push_back({{at(i, 0), at(i + 1, height), at(i, height)}});
    raw.objectOf.insert(raw.objectOf.end(), 2, 0);
  }
  return Scene::build(std::move(raw)).value();
}

Scene sword() {
  RawScene raw;
  raw.objectNames = {"sword"};
  const Vector3d tip(0.8, 0, 0), one(0.05, 0.02, 0), other(0.05, -0.02, 0), back(0.05, 0, 0.004);
  raw.triangles = {{{tip, one, other}}, {{tip, one, back}}, {{tip, other, back}}};
  raw.objectOf = {0, 0, 0};
  return Scene::build(std::move(raw)).value();
}

struct Total {
  WorldTally tally;
  std::size_t windows = 0;

  void add(const BothWorlds& both) {
    for (const std::string& problem : both.problems) ADD_FAILURE() << problem;
    tally.clear += both.tally.clear;
    tally.contact += both.tally.contact;
    tally.start += both.tally.start;
    tally.undecided += both.tally.undecided;
    tally.grazing += both.tally.grazing;
  }
  void expectKept(int contacts) const {
    std::cout << windows << " windows: " << tally.clear << " clear, " << tally.contact
              << " contacts, " << tally.start << " in contact from the start, " << tally.grazing
              << " too slow for the judge\n";
    EXPECT_GT(tally.contact, contacts);
    EXPECT_EQ(tally.undecided, 0);
    EXPECT_LE(tally.grazing, tally.contact / 50);
  }
};

std::vector<SweepClip> loadedClips() {
  std::vector<SweepClip> clips;
  for (const char* const name : kClips) {
    const auto path = sharedData(std::string("mocap/") + name);
    if (!path) continue;
    auto clip = loadClip(*path);
    EXPECT_TRUE(clip.ok()) << describe(clip.error());
    if (clip.ok()) clips.push_back(std::move(clip).value());
  }
  return clips;
}

constexpr std::int64_t kWindowUs = 150'000, kWindows = 4;

TEST(WorldOfClips, ProvesEveryClipAgainstEveryOther) {
  FORETOUCH_REQUIRE_SHARED(any, std::string("mocap/") + kClips[0]);
  const std::vector<SweepClip> clips = loadedClips();
  const double rates[] = {30.0, 90.0, 120.0, 10.0};
  Total total;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    for (std::size_t j = i; j < clips.size(); ++j) {
      SCOPED_TRACE(clips[i].name + " and " + clips[j].name);
      Random random(100 * i + j);
      BothWorlds both(random.chance(0.5) ? 1e-3 : 1e-5);
      const BodyId one = both.add(clips[i].avatar), other = both.add(clips[j].avatar);
      Walk beside;
      beside.place.yaw = random.uniform(-3.0, 3.0);
      beside.place.position = Vector3d(random.uniform(0.5, 0.9), 0.0, random.uniform(-0.3, 0.3));
      beside.speed = Vector3d(random.uniform(-2.0, -0.5), 0.0, random.uniform(-0.5, 0.5));
      dance(both, one, clips[i], rates[random.below(4)], 0, kWindows * kWindowUs, Walk{});
      dance(both, other, clips[j], rates[random.below(4)], -random.below(5000),
            kWindows * kWindowUs, beside);
      for (std::int64_t from = 0; from < kWindows * kWindowUs; from += kWindowUs) {
        both.judgeAll(from, from + kWindowUs);
        ++total.windows;
      }
      total.add(both);
    }
  }
  total.expectKept(100);
}

TEST(WorldOfClips, ProvesRingsThatAreThrownAndSwordsThatAreHeld) {
  FORETOUCH_REQUIRE_SHARED(any, std::string("mocap/") + kClips[0]);
  const std::vector<SweepClip> clips = loadedClips();
  Total total;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    SCOPED_TRACE(clips[i].name);
    Random random(i);
    BothWorlds both(random.chance(0.5) ? 1e-3 : 1e-5);
    const BodyId body = both.add(clips[i].avatar);
    const BodyId thrown = both.add(ring(0.12, 0.02, 24)), held = both.add(sword());
    dance(both, body, clips[i], 30.0, 0, kWindows * kWindowUs, Walk{});
    const std::int64_t periodUs = 11'111;
    RigidPose pose{random.rotation(), Vector3d(-0.6, -0.1, random.uniform(-0.2, 0.2))};
    const Quaternion turn = random.turn(8.0 * 1e-6 * static_cast<double>(periodUs));
    for (std::int64_t us = 0; us < kWindows * kWindowUs + periodUs; us += periodUs) {
      both.push(thrown, us, pose);
      pose.translation.x() += 3.5e-6 * static_cast<double>(periodUs);
      pose.rotation = (pose.rotation * turn).normalized();
    }
    const auto hand = clips[i].avatar.skeleton().find("RightHand");
    const LinkId holding = hand ? *hand : clips[i].avatar.numLinks() - 1;
    both.attach(held, {body, holding}, 0, {random.rotation(), Vector3d::Zero()});
    for (std::int64_t from = 0; from < kWindows * kWindowUs; from += kWindowUs) {
      both.judge(body, thrown, from, from + kWindowUs);
      both.judge(body, held, from, from + kWindowUs);
      ++total.windows;
    }
    total.add(both);
  }
  total.expectKept(20);
}

}  // namespace
}  // namespace foretouch::test
