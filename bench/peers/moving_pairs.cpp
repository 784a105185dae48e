#include "bench/peers/moving_pairs.h"

#include <cmath>

#include "bench/judged.h"
#include "judge/world_judge.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

constexpr double kPairRadius = 0.04, kPairLength = 0.25, kPairBox = 0.4, kPairTravel = 0.4,
                 kPairTurn = 1.2, kPairClear = 0.01;
constexpr std::int64_t kPairUs = 1'000'000;
constexpr double kRingRadius = 0.105, kRingThickness = 0.015, kRingTurn = 6.283185307179586;
constexpr int kRingAround = 24, kRingAcross = 8;

Vector3d onRing(int i, int j) {
  const double u = kRingTurn * i / kRingAround, v = kRingTurn * j / kRingAcross;
  const double out = kRingRadius + kRingThickness * std::cos(v);
  return {out * std::cos(u), out * std::sin(u), kRingThickness * std::sin(v)};
}

Lss diameterOfRing() {
  const double reach = kRingRadius + kRingThickness;
  return {Vector3d(-reach, 0.0, 0.0), Vector3d(reach, 0.0, 0.0), 0.0};
}

RigidSweep drawnSweep(PortableRandom& random, const Lss& lss_L) {
  RigidSweep sweep;
  sweep.lss_L = lss_L;
  const Vector3d axis = random.inBox(1.0).normalized();
  sweep.rotation = Quaternion(Eigen::AngleAxisd(random.uniform(0.0, 3.0), axis));
  sweep.from = random.inBox(kPairBox);
  sweep.to = sweep.from + random.inBox(kPairTravel);
  sweep.turn = random.uniform(0.0, kPairTurn) * random.inBox(1.0).normalized();
  return sweep;
}

oracle::OracleBody judgedSweep(const RigidSweep& sweep, bool isRing) {
  oracle::OracleBody body;
  body.parents = {-1};
  const Lss& lss = sweep.lss_L;
  if (isRing) {
    for (const Triangle& t : movingRing()) {
      body.parts.push_back(
          {0, 3, {plain(t.vertices[0]), plain(t.vertices[1]), plain(t.vertices[2])}, 0.0});
    }
  } else {
    body.parts = {{0, 2, {plain(lss.a), plain(lss.b), plain(lss.b)}, lss.radius}};
  }
  const RigidPose from = poseAt(sweep, 0.0), to = poseAt(sweep, 1.0);
  body.episodes.push_back(
      {0,
       -1,
       0,
       {0, kPairUs},
       {{{plain(from.rotation), plain(from.pivot)}}, {{plain(to.rotation), plain(to.pivot)}}}});
  return body;
}

}  // namespace

Lss movingLss() {
  return {Vector3d::Zero(), Vector3d(kPairLength, 0.0, 0.0), kPairRadius};
}

const std::vector<Triangle>& movingRing() {
  static const std::vector<Triangle> ring = [] {
    std::vector<Triangle> triangles;
    for (int i = 0; i < kRingAround; ++i) {
      for (int j = 0; j < kRingAcross; ++j) {
        triangles.push_back({{onRing(i, j), onRing(i + 1, j), onRing(i + 1, j + 1)}});
        triangles.push_back({{onRing(i, j), onRing(i + 1, j + 1), onRing(i, j + 1)}});
      }
    }
    return triangles;
  }();
  return ring;
}

std::vector<MovingPair> drawnPairs(PairKind kind, int count, std::uint64_t seed) {
  const bool isRing = kind == PairKind::RingAndCapsule;
  PortableRandom random(seed);
  std::vector<MovingPair> pairs;
  int touching = 0;
  while (static_cast<int>(pairs.size()) < count) {
    MovingPair pair{drawnSweep(random, isRing ? diameterOfRing() : movingLss()),
                    drawnSweep(random, movingLss())};
    oracle::OracleWorld world;
    world.bodies = {judgedSweep(pair.one, isRing), judgedSweep(pair.other, false)};
    if (world.separationAt(0, 0, 1, 0, 0, 0) < static_cast<oracle::Real>(kPairClear)) continue;
    const auto truth = world.firstTouch(0, 0, 1, 0, 0, kPairUs);
    if (truth.outcome == oracle::OracleOutcome::Uncertain) continue;
    pair.touches = truth.outcome == oracle::OracleOutcome::Touch;
    if (pair.touches) pair.toi = static_cast<double>(truth.time) / static_cast<double>(kPairUs);
    if ((pair.touches ? touching : static_cast<int>(pairs.size()) - touching) >= (count + 1) / 2) {
      continue;
    }
    touching += pair.touches;
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace foretouch::tools
