#include "bench/ask/shots.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bench/solid/cells.h"
#include "bench/world/judged_world.h"
#include "judge/cast_oracle.h"
#include "middleware/ask/ask.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using oracle::OraclePart;
using oracle::Real;

constexpr double kRunMps = 3.0, kNearestShotM = 5.0, kFarthestShotM = 30.0, kReachM = 100.0;
constexpr std::int64_t kSecondUs = 1'000'000, kMsUs = 1'000;
constexpr int kTicks[] = {20, 30, 60}, kLatenciesMs[] = {50, 100, 150};
/// Shots at one person; then comes the next one.
constexpr int kShotsPerPerson = 25;
/// A ray that passes so near to a surface (m) is not judged: who is right is rounding.
constexpr Real kGrazing = 1e-8L;

/// Link that a ray hits first; -1: none.
using Struck = int;

/// Of parts in W, by the judge.
Struck struckOf(const std::vector<OraclePart>& parts, const oracle::CastShape& ray,
                bool* isGrazing = nullptr) {
  Struck struck = -1;
  Real first = kReachM;
  for (const OraclePart& part : parts) {
    if (isGrazing != nullptr && std::abs(oracle::leastGap(ray, kReachM, part, 0)) < kGrazing) {
      *isGrazing = true;
    }
    const Real touch = oracle::firstTouch(ray, kReachM, part);
    if (touch < 0 || touch >= first) continue;
    first = touch;
    struck = part.link;
  }
  return struck;
}

std::vector<OraclePart> movedBy(std::vector<OraclePart> parts, const oracle::Vec3d& by) {
  for (OraclePart& part : parts) {
    for (oracle::Vec3d& corner : part.corners) corner = corner + by;
  }
  return parts;
}

/// Somebody who runs: in a world, and as the judge knows him.
class Runner {
 public:
  Runner(const ClipPoses& clip, int n) {
    Person person;
    person.clip = &clip;
    person.phase = static_cast<std::size_t>(37 * n);
    const double turn = 2.4 * n;
    const Vector3d speed = kRunMps * Vector3d(std::cos(turn), 0.0, std::sin(turn));
    const Avatar& avatar = clip.actor->avatar;
    static_cast<void>(world_.add(avatar).value());
    truth_.bodies.push_back(judgedBody(avatar));
    for (std::int64_t k = 0; clip.periodUs * k <= 2 * kSecondUs; ++k) {
      Pose pose = person.pose(k);
      pose.translations[0] += 1e-6 * static_cast<double>(clip.periodUs * k) * speed;
      static_cast<void>(world_.push(0, clip.periodUs * k, pose));
      pushJudged(truth_.bodies.front(), clip.periodUs * k, pose);
    }
  }

  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] std::vector<OraclePart> partsAt(Real us) const {
    return truth_.partsAt(0, -1, 0, us);
  }
  [[nodiscard]] oracle::Vec3d rootAt(Real us) const {
    return truth_.frameAt(0, 0, 0, us, false).p.as<double>();
  }

 private:
  World world_ = World::build(std::nullopt).value();
  oracle::OracleWorld truth_;
};

struct Shot {
  WorldTime seen;
  Vector3d from, aim;
};

/// At a point in a link, or a little beside it, when the shooter sees him there.
Shot shotAt(const Runner& runner, PortableRandom& random) {
  Shot shot;
  shot.seen = {static_cast<std::int64_t>(random.uniform(0.5e6, 1.5e6)), random.uniform(0.0, 1.0)};
  const auto parts =
      runner.partsAt(static_cast<Real>(shot.seen.us) + static_cast<Real>(shot.seen.fraction));
  const OraclePart& part = parts[static_cast<std::size_t>(random.next() % parts.size())];
  const double share = random.uniform(0.0, 1.0);
  shot.aim = (1.0 - share) * rich(part.corners[0]) + share * rich(part.corners[1]) +
             part.radius * random.inBox(1.5);
  const double turn = random.uniform(0.0, 6.28),
               away = random.uniform(kNearestShotM, kFarthestShotM);
  shot.from = shot.aim + away * Vector3d(std::cos(turn), 0.05, std::sin(turn));
  return shot;
}

/// Where the others take him to be.
enum class RewindWay { NotRewound, LastTick, OriginOnly, Between, Count };

std::vector<OraclePart> seenBy(RewindWay way, const Runner& runner, Real seenUs, Real nowUs,
                               Real tickUs) {
  const auto tickAt = [&](Real us) { return tickUs * std::floor(us / tickUs); };
  const Real tick = tickAt(seenUs);
  const auto share = static_cast<double>((seenUs - tick) / tickUs);
  switch (way) {
    case RewindWay::NotRewound: return runner.partsAt(tickAt(nowUs));
    case RewindWay::LastTick: return runner.partsAt(tick);
    case RewindWay::OriginOnly: {
      const oracle::Vec3d before = runner.rootAt(tick), after = runner.rootAt(tick + tickUs);
      const oracle::Vec3d root = before + share * (after - before);
      return movedBy(runner.partsAt(tickAt(nowUs)), root - runner.rootAt(tickAt(nowUs)));
    }
    default: break;
  }
  // Each bone from its place at one tick to that at the next, straight on.
  std::vector<OraclePart> parts = runner.partsAt(tick);
  const std::vector<OraclePart> after = runner.partsAt(tick + tickUs);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      oracle::Vec3d& corner = parts[i].corners[k];
      corner = corner + share * (after[i].corners[k] - corner);
    }
  }
  return parts;
}

struct ShotTally {
  std::uint64_t missed = 0, invented = 0, elsewhere = 0;

  void add(Struck truth, Struck seen) {
    missed += truth >= 0 && seen < 0;
    invented += truth < 0 && seen >= 0;
    elsewhere += truth >= 0 && seen >= 0 && truth != seen;
  }
};

struct ShotRow {
  ShotTally ofWay[static_cast<std::size_t>(RewindWay::Count)], ofWorld;
  std::uint64_t shots = 0, hits = 0;
};

void shoot(const Runner& runner, const Shot& shot, Real tickUs, Real latencyUs, Scratch& scratch,
           ShotRow& row) {
  const Vector3d way = shot.aim - shot.from;
  const oracle::CastShape ray{plain(shot.from), plain(shot.from), 0.0, plain(way)};
  const Real seenUs = static_cast<Real>(shot.seen.us) + static_cast<Real>(shot.seen.fraction);
  bool isGrazing = false;
  const Struck truth = struckOf(runner.partsAt(seenUs), ray, &isGrazing);
  if (isGrazing) return;
  ++row.shots;
  row.hits += truth >= 0;
  // It arrives when what he saw was two ticks old, and his way to the server is behind it.
  const Real nowUs = seenUs + 2 * tickUs + latencyUs;
  for (std::size_t i = 0; i < static_cast<std::size_t>(RewindWay::Count); ++i) {
    const auto parts = seenBy(static_cast<RewindWay>(i), runner, seenUs, nowUs, tickUs);
    row.ofWay[i].add(truth, struckOf(parts, ray));
  }
  WorldAnswer answer;
  static_cast<void>(askWorld(runner.world(), WorldQuestion::ray(shot.from, way, kReachM, shot.seen),
                             scratch, answer));
  row.ofWorld.add(truth, answer.hits.empty() ? -1 : answer.hits.front().what.link);
}

void appendTally(const ShotTally& tally, std::uint64_t shots, std::vector<BenchCell>& row) {
  for (const std::uint64_t count : {tally.missed, tally.invented, tally.elsewhere}) {
    row.emplace_back(percent(count, shots));
  }
}

std::vector<BenchColumn> shotColumns() {
  std::vector<BenchColumn> columns{{"ticks_hz", "ticks", 0},
                                   {"latency_ms", "latency ms", 0},
                                   {"shots", "shots", 0},
                                   {"hits_percent", "that hit %", 1}};
  const std::pair<const char*, const char*> ways[] = {{"not_rewound", "not rewound"},
                                                      {"last_tick", "last tick"},
                                                      {"origin_only", "origin only"},
                                                      {"between", "between ticks"},
                                                      {"world", "World"}};
  for (const auto& [key, title] : ways) {
    columns.push_back({std::string(key) + "_missed_percent", std::string(title) + ": missed %", 1});
    columns.push_back({std::string(key) + "_invented_percent", "invented %", 1});
    columns.push_back({std::string(key) + "_elsewhere_percent", "another link %", 1});
  }
  return columns;
}

}  // namespace

ShotsTable shotsTable(const WorldCast& cast, int shots, std::uint64_t seed) {
  ShotsTable result;
  result.table = {"shots", "Shots at a person who is seen late", shotColumns(), {}};
  const auto clips = clipPosesOf(cast, kShotRateHz);
  Scratch scratch;
  for (const int ticks : kTicks) {
    for (const int latencyMs : kLatenciesMs) {
      ShotRow row;
      PortableRandom random(seed);
      for (int n = 0; n * kShotsPerPerson < shots; ++n) {
        const Runner runner(clips[static_cast<std::size_t>(n) % clips.size()], n);
        const int last = std::min(shots - n * kShotsPerPerson, kShotsPerPerson);
        for (int i = 0; i < last; ++i) {
          shoot(runner, shotAt(runner, random), static_cast<Real>(kSecondUs) / ticks,
                static_cast<Real>(latencyMs * kMsUs), scratch, row);
        }
      }
      const ShotTally& world = row.ofWorld;
      result.violations += world.missed + world.invented + world.elsewhere;
      std::vector<BenchCell> cells{std::int64_t{ticks}, std::int64_t{latencyMs}, cell(row.shots),
                                   percent(row.hits, row.shots)};
      for (const ShotTally& way : row.ofWay) appendTally(way, row.shots, cells);
      appendTally(world, row.shots, cells);
      result.table.rows.push_back(std::move(cells));
    }
  }
  return result;
}

}  // namespace foretouch::tools
