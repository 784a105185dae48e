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

/// The link that a ray hits first, and those that it hits there, too: LSS of neighbours have a
/// ball at their joint in common. Empty: none.
using Struck = std::vector<int>;

/// What the ray strikes of parts in W, by the judge.
Struck struckOf(const std::vector<OraclePart>& parts, const oracle::CastShape& ray,
                bool* isGrazing = nullptr) {
  std::vector<Real> touches;
  Real first = kReachM;
  for (const OraclePart& part : parts) {
    if (isGrazing != nullptr &&
        std::abs(oracle::leastGap(ray, kReachM, part, kGrazing)) < kGrazing) {
      *isGrazing = true;
    }
    const Real touch = oracle::firstTouch(ray, kReachM, part);
    touches.push_back(touch);
    if (touch >= 0) first = std::min(first, touch);
  }
  Struck struck;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (touches[i] < 0 || touches[i] > first + kGrazing) continue;
    struck.insert(touches[i] == first ? struck.begin() : struck.end(), parts[i].link);
  }
  return struck;
}

std::vector<OraclePart> movedBy(std::vector<OraclePart> parts, const oracle::Vec3d& by) {
  for (OraclePart& part : parts) {
    for (oracle::Vec3d& corner : part.corners) corner = corner + by;
  }
  return parts;
}

/// A running person: in a world, and as the judge knows him.
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

/// A shot at a point in a link, or a little beside it, when the shooter sees him there.
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

/// Where the other ways take him to be.
enum class RewindWay { NotRewound, LastTick, OriginOnly, Between };

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

  void add(const Struck& truth, const Struck& seen) {
    missed += !truth.empty() && seen.empty();
    invented += truth.empty() && !seen.empty();
    if (truth.empty() || seen.empty()) return;
    elsewhere += std::find(truth.begin(), truth.end(), seen.front()) == truth.end();
  }
};

/// A way, and its latency; 0: it does not depend on that.
struct RewindRow {
  RewindWay way;
  const char* name;
  int latencyMs;
  ShotTally tally = {};
};

/// The rows of one tick rate.
struct TickRows {
  std::vector<RewindRow> rows;
  ShotTally ofWorld;
  std::uint64_t shots = 0, hits = 0;

  TickRows() {
    rows = {{RewindWay::LastTick, "the last tick", 0}, {RewindWay::Between, "between ticks", 0}};
    for (const int latencyMs : kLatenciesMs) {
      rows.push_back({RewindWay::OriginOnly, "between ticks, the origin alone", latencyMs});
    }
    for (const int latencyMs : kLatenciesMs) {
      rows.push_back({RewindWay::NotRewound, "not rewound", latencyMs});
    }
  }
};

void shoot(const Runner& runner, const Shot& shot, Real tickUs, Scratch& scratch, TickRows& ticks) {
  const Vector3d way = shot.aim - shot.from;
  const oracle::CastShape ray{plain(shot.from), plain(shot.from), 0.0, plain(way)};
  const Real seenUs = static_cast<Real>(shot.seen.us) + static_cast<Real>(shot.seen.fraction);
  bool isGrazing = false;
  const Struck truth = struckOf(runner.partsAt(seenUs), ray, &isGrazing);
  if (isGrazing) return;
  ++ticks.shots;
  ticks.hits += !truth.empty();
  for (RewindRow& row : ticks.rows) {
    // It arrives when what he saw was two ticks old, and his way to the server is behind it.
    const Real nowUs = seenUs + 2 * tickUs + static_cast<Real>(row.latencyMs * kMsUs);
    row.tally.add(truth, struckOf(seenBy(row.way, runner, seenUs, nowUs, tickUs), ray));
  }
  WorldAnswer answer;
  static_cast<void>(askWorld(runner.world(), WorldQuestion::ray(shot.from, way, kReachM, shot.seen),
                             scratch, answer));
  ticks.ofWorld.add(truth, answer.hits.empty() ? Struck{} : Struck{answer.hits.front().what.link});
}

std::vector<BenchCell> shotCells(int hz, const char* name, int latencyMs, const TickRows& ticks,
                                 const ShotTally& tally) {
  const std::string latency = latencyMs > 0 ? std::to_string(latencyMs) : "any";
  return {std::int64_t{hz},
          std::string(name),
          latency,
          cell(ticks.shots),
          percent(ticks.hits, ticks.shots),
          percent(tally.missed, ticks.shots),
          percent(tally.invented, ticks.shots),
          percent(tally.elsewhere, ticks.shots)};
}

TickRows shootAll(const std::vector<ClipPoses>& clips, int hz, int shots, std::uint64_t seed) {
  TickRows ticks;
  PortableRandom random(seed);
  Scratch scratch;
  const Real tickUs = static_cast<Real>(1e6) / hz;
  for (int n = 0; n * kShotsPerPerson < shots; ++n) {
    const Runner runner(clips[static_cast<std::size_t>(n) % clips.size()], n);
    const int last = std::min(shots - n * kShotsPerPerson, kShotsPerPerson);
    for (int i = 0; i < last; ++i) {
      shoot(runner, shotAt(runner, random), tickUs, scratch, ticks);
    }
  }
  return ticks;
}

}  // namespace

JudgedTable shotsTable(const Cast& cast, int shots, std::uint64_t seed) {
  JudgedTable result;
  result.table = {"shots",
                  "Shots at a person who is seen late, by where a server takes him to be",
                  {{"ticks_hz", "ticks per second", 0},
                   {"way", "taken to be"},
                   {"latency_ms", "latency ms"},
                   {"shots", "shots", 0},
                   {"hits_percent", "that hit %", 1},
                   {"missed_percent", "missed %", 1},
                   {"invented_percent", "invented %", 1},
                   {"elsewhere_percent", "another link %", 1}},
                  {}};
  const auto clips = clipPosesOf(cast, kShotRateHz);
  for (const int hz : kTicks) {
    const TickRows ticks = shootAll(clips, hz, shots, seed);
    const ShotTally& world = ticks.ofWorld;
    result.violations += world.missed + world.invented + world.elsewhere;
    result.table.rows.push_back(shotCells(hz, "where the motion has him (World)", 0, ticks, world));
    for (const RewindRow& row : ticks.rows) {
      result.table.rows.push_back(shotCells(hz, row.name, row.latencyMs, ticks, row.tally));
    }
  }
  return result;
}

}  // namespace foretouch::tools
