// A server of a shooter: sixty players of 22 links, 128 ticks per second, and a memory of one
// second. Each shot is judged at what its player saw: every other player at an instant of his own,
// between ticks too. Everything that came in is kept as a log; a replay of it has the same
// verdicts, to the bit. Exits with 1 if it has not.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <foretouch/foretouch.hpp>
#include <foretouch/middleware/ask/ask.h>
#include <string>
#include <utility>
#include <vector>

#include "stage.h"

using namespace foretouch;
using stage::checked;

constexpr int kPlayers = 60, kLinks = 22, kTicksPerSecond = 128, kSeconds = 6;
constexpr std::int64_t kSecondUs = 1'000'000, kTickUs = kSecondUs / kTicksPerSecond;

/// A pelvis, and five limbs of links 25 cm long: a spine with the head, two arms, two legs.
Avatar player() {
  struct Limb {
    Eigen::Vector3d from, along;
    int links;
  };
  const Limb limbs[] = {{{0, 0.1, 0}, {0, 0.14, 0}, 5},
                        {{0.2, 0.55, 0}, {0.16, 0, 0}, 4},
                        {{-0.2, 0.55, 0}, {-0.16, 0, 0}, 4},
                        {{0.1, 0, 0}, {0, -0.21, 0}, 4},
                        {{-0.1, 0, 0}, {0, -0.21, 0}, 4}};
  RawSkeleton bones;
  bones.joints.push_back({"pelvis", kNoParent, {0, 0.9, 0}, Quaternion::Identity()});
  std::vector<std::vector<Lss>> lss = {{{{-0.1, 0, 0}, {0.1, 0, 0}, 0.12}}};
  for (const Limb& limb : limbs) {
    for (int i = 0; i < limb.links; ++i) {
      const JointId parent = i == 0 ? 0 : static_cast<JointId>(bones.joints.size()) - 1;
      const std::string name = "link" + std::to_string(bones.joints.size());
      bones.joints.push_back(
          {name, parent, i == 0 ? limb.from : limb.along, Quaternion::Identity()});
      lss.push_back({{{0, 0, 0}, limb.along, 0.07}});
    }
  }
  return checked(Avatar::build(checked(Skeleton::build(bones)), lss));
}

/// Where a player is at a tick: he runs in a circle and swings his limbs. Yours: what clients send.
Pose poseOf(int player, int tick, const Skeleton& skeleton) {
  const double s = static_cast<double>(tick) / kTicksPerSecond + 0.37 * player;
  Pose pose = restPose(skeleton);
  const double x = 4.0 * (player % 8), z = 4.0 * (player / 8);
  pose.translations[0] = {x + std::cos(s), 0.9 + 0.05 * std::sin(9.0 * s), z + std::sin(s)};
  pose.rotations[0] = {std::cos(0.5 * s), 0.0, -std::sin(0.5 * s), 0.0};
  for (std::size_t joint = 1; joint < pose.rotations.size(); ++joint) {
    const double half = 0.2 * std::sin(6.0 * s + static_cast<double>(joint));
    pose.rotations[joint] = {std::cos(half), std::sin(half), 0.0, 0.0};
  }
  return pose;
}

/// What came in.
struct Shot {
  int tick = 0;
  WorldQuestion question;
  WorldAnswer verdict;
};

/// A shot at a tick, by a player at another one, who is seen 50 to 150 ms late.
WorldQuestion shotAt(int tick, int number) {
  const BodyId shooter = number % kPlayers, target = (7 * number + 13) % kPlayers;
  const auto placeOf = [&](BodyId body) {
    const double s = static_cast<double>(tick) / kTicksPerSecond + 0.37 * body;
    return Eigen::Vector3d(4.0 * (body % 8) + std::cos(s), 1.1, 4.0 * (body / 8) + std::sin(s));
  };
  const Eigen::Vector3d muzzle = placeOf(shooter) + Eigen::Vector3d(0, 0.4, 0);
  const Eigen::Vector3d aim =
      placeOf(target) + Eigen::Vector3d(0.15 * std::sin(number), 0.5 * std::cos(3.0 * number), 0);
  const std::int64_t nowUs = kTickUs * tick;
  WorldQuestion shot = WorldQuestion::ray(muzzle, aim - muzzle, 200.0, {nowUs});
  shot.without = {{shooter}};
  for (BodyId body = 0; body < kPlayers; ++body) {
    const std::int64_t lateUs = 50'000 + (number * 7919LL + body * 1543LL) % 100'000;
    shot.instants.push_back({body, {nowUs - lateUs}});
  }
  return shot;
}

World emptyWorld(const Avatar& avatar) {
  World world = checked(World::build(std::nullopt));
  for (int i = 0; i < kPlayers; ++i) checked(world.add(avatar));
  return world;
}

void playTick(World& world, int tick, const Skeleton& skeleton) {
  for (BodyId body = 0; body < kPlayers; ++body) {
    checked(world.push(body, kTickUs * tick, poseOf(body, tick, skeleton)));
  }
  world.forgetBefore(kTickUs * tick - kSecondUs);
}

bool isSame(const WorldAnswer& x, const WorldAnswer& y) {
  if (x.verdict() != y.verdict() || x.hits.size() != y.hits.size()) return false;
  if (x.hits.empty()) return true;
  const WorldHit &one = x.hits.front(), &other = y.hits.front();
  return one.what.body == other.what.body && one.what.link == other.what.link &&
         one.distance == other.distance && one.what.p_W == other.what.p_W;
}

int main() {
  const Avatar avatar = player();
  const Skeleton& skeleton = avatar.skeleton();
  std::vector<Shot> log;
  int hits = 0;
  double us = 0.0;

  World world = emptyWorld(avatar);
  Scratch scratch;
  for (int tick = 0; tick < kTicksPerSecond * kSeconds; ++tick) {
    playTick(world, tick, skeleton);
    if (tick < kTicksPerSecond) continue;  // a shot per tick, once there is a past
    Shot shot{tick, shotAt(tick, tick), {}};
    const auto begin = std::chrono::steady_clock::now();
    checked(askWorld(world, shot.question, scratch, shot.verdict));
    us +=
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
    hits += shot.verdict.verdict() == AskVerdict::Hit ? 1 : 0;
    log.push_back(std::move(shot));
  }

  // The same poses again: a world and a memory of its own, that are asked nothing else.
  World replay = emptyWorld(avatar);
  int same = 0;
  std::size_t next = 0;
  for (int tick = 0; tick < kTicksPerSecond * kSeconds; ++tick) {
    playTick(replay, tick, skeleton);
    for (; next < log.size() && log[next].tick == tick; ++next) {
      Scratch anew;
      WorldAnswer verdict;
      checked(askWorld(replay, log[next].question, anew, verdict));
      same += isSame(verdict, log[next].verdict) ? 1 : 0;
    }
  }

  std::printf("%zu shots at %d players of %d links, %d hits\n", log.size(), kPlayers, kLinks, hits);
  std::printf("%d of them have the same verdict in a replay\n", same);
  std::fprintf(stderr, "%.1f us per shot\n", us / static_cast<double>(log.size()));
  return hits > 0 && static_cast<std::size_t>(same) == log.size() ? 0 : 1;
}
