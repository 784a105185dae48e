#include "bench/ask/player_shots.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/ask/asked_times.h"
#include "bench/machine.h"
#include "bench/solid/cells.h"
#include "bench/timing.h"
#include "middleware/ask/ask.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

constexpr int kPlayers = 60, kTickHz = 128, kWarmSeconds = 1;
constexpr double kPlayersApartM = 4.0, kKiBPerMiB = 1024.0;
constexpr std::int64_t kKeptUs = 1'000'000, kTickUs = 1'000'000 / kTickHz;
/// How far thinning may move a point (mm); 0: nothing is thinned. And every so many ticks.
constexpr double kThinnedMm[] = {0.0, 1.0, 5.0, 10.0};
constexpr std::int64_t kTicksPerThinning = 32;

/// The players, and a world that keeps a second of them.
class PlayedWorld {
 public:
  PlayedWorld(const std::vector<Person>& people, double thinnedMm)
      : people_(people), thinnedM_(1e-3 * thinnedMm) {
    for (const Person& person : people_) {
      static_cast<void>(world.add(person.clip->actor->avatar).value());
    }
  }
  void tick() {
    for (std::size_t i = 0; i < people_.size(); ++i) {
      static_cast<void>(world.push(static_cast<BodyId>(i), nowUs(), people_[i].pose(ticks_)));
    }
    ++ticks_;
    world.forgetBefore(nowUs() - kKeptUs);
    if (thinnedM_ == 0.0 || ticks_ % kTicksPerThinning != 0) return;
    thinnings.time([&] { static_cast<void>(world.thinBefore(nowUs(), thinnedM_)); });
  }
  /// The instant of the next tick.
  [[nodiscard]] std::int64_t nowUs() const { return kTickUs * ticks_; }

  World world = World::build(std::nullopt).value();
  AskedTimes thinnings;

 private:
  std::vector<Person> people_;
  double thinnedM_;
  std::int64_t ticks_ = 0;
};

WorldQuestion shotOf(const std::vector<Vector3d>& places, std::int64_t lastUs,
                     PortableRandom& random) {
  const auto shooter = static_cast<std::size_t>(random.next() % kPlayers);
  const auto target = static_cast<std::size_t>(random.next() % kPlayers);
  const Vector3d from = places[shooter] + Vector3d(0.0, 0.5, 0.0);
  const Vector3d aim =
      places[target] + random.inBox(Vector3d(-0.3, -0.5, -0.3), Vector3d(0.3, 0.6, 0.3));
  const Vector3d way = shooter == target ? Vector3d(1.0, 0.0, 0.0) : Vector3d(aim - from);
  WorldQuestion shot = WorldQuestion::ray(from, way, 200.0, {lastUs, 0.0});
  shot.without = {{static_cast<BodyId>(shooter)}};
  for (BodyId body = 0; body < kPlayers; ++body) {
    const double agoUs = random.uniform(5e4, 15e4) + 2.0 * static_cast<double>(kTickUs);
    shot.instants.push_back({body, {lastUs - static_cast<std::int64_t>(agoUs), 0.5}});
  }
  return shot;
}

bool areAlike(const WorldAnswer& x, const WorldAnswer& y) {
  if (x.hits.size() != y.hits.size()) return false;
  for (std::size_t i = 0; i < x.hits.size(); ++i) {
    const WorldHit &one = x.hits[i], &other = y.hits[i];
    if (one.what.body != other.what.body || one.what.link != other.what.link ||
        one.distance != other.distance || one.what.p_W != other.what.p_W) {
      return false;
    }
  }
  return true;
}

/// What shots cost in a world that is thinned so far, and what they hit.
struct Played {
  std::vector<double> us;
  double kib = 0.0, posesKib = 0.0, thinUs = 0.0;
  std::uint64_t hits = 0, otherInReplay = 0;
  std::vector<WorldAnswer> answers;
};

Played playedWith(const std::vector<Person>& people, double thinnedMm, int shots,
                  std::uint64_t seed) {
  std::vector<Vector3d> places;
  for (const Person& person : people) places.push_back(person.pose(0).translations[0]);
  PortableRandom random(seed);
  Scratch scratch;
  Played result;
  AskedTimes times;
  const double before = heapMiB();
  PlayedWorld played(people, thinnedMm);
  for (int i = 0; i < kTickHz * kWarmSeconds; ++i) played.tick();
  constexpr double kOfEach = kPlayers * kWarmSeconds;
  result.kib = (heapMiB() - before) * kKiBPerMiB / kOfEach;
  result.posesKib = static_cast<double>(played.world.poseBytes()) / (kKiBPerMiB * kOfEach);
  // A replay, from the same poses: asked in another order, with its own memory.
  PlayedWorld replay(people, thinnedMm);
  for (int i = 0; i < kTickHz * kWarmSeconds; ++i) replay.tick();
  Scratch anew;
  WorldAnswer again;
  for (int i = 0; i < shots; ++i) {
    // A shot per tick: the world changes before each.
    played.tick();
    replay.tick();
    const WorldQuestion shot = shotOf(places, played.nowUs() - kTickUs, random);
    WorldAnswer answer;
    times.time([&] { static_cast<void>(askWorld(played.world, shot, scratch, answer)); });
    result.hits += !answer.hits.empty();
    if (i % 16 == 0) anew = Scratch();
    static_cast<void>(askWorld(replay.world, shot, anew, again));
    result.otherInReplay += !areAlike(answer, again);
    result.answers.push_back(answer);
  }
  result.us = times.us;
  for (const double us : played.thinnings.us) result.thinUs += us;
  result.thinUs /= static_cast<double>(shots + kTickHz * kWarmSeconds);
  return result;
}

/// Shots that hit another body or link, or nothing, or something instead of nothing.
std::uint64_t othersIn(const Played& all, const Played& thinned) {
  std::uint64_t others = 0;
  for (std::size_t i = 0; i < all.answers.size(); ++i) {
    const std::vector<WorldHit>&then = all.answers[i].hits, &now = thinned.answers[i].hits;
    others += then.empty() != now.empty() ||
              (!then.empty() && (then.front().what.body != now.front().what.body ||
                                 then.front().what.link != now.front().what.link));
  }
  return others;
}

}  // namespace

JudgedTable playersTable(const Cast& cast, int shots, std::uint64_t seed) {
  const auto clips = clipPosesOf(cast, kTickHz);
  const auto people = crowdOf(clips, kPlayers, kPlayersApartM);
  JudgedTable result;
  result.table = {"players",
                  "Shots on a server: a shot per tick, each player at an instant of its own",
                  {{"players", "players", 0},
                   {"ticks_hz", "ticks per second", 0},
                   {"thinned_mm", "thinned to within, mm", 0},
                   {"kib_per_player_and_second", "KiB per player and second", 0},
                   {"poses_kib", "after thinning, at 56 n + 256 bytes a pose", 0},
                   {"thin_us", "us per tick to thin", 0},
                   {"p50_us", "us per shot p50", 1},
                   {"p90_us", "p90", 1},
                   {"p99_us", "p99", 1},
                   {"hit_percent", "with a hit %", 1},
                   {"other_percent", "another link than with all poses %", 2},
                   {"other_in_replay", "another answer in a replay", 0}},
                  {}};
  const auto count = static_cast<std::uint64_t>(shots);
  std::optional<Played> all;
  for (const double mm : kThinnedMm) {
    const Played played = playedWith(people, mm, shots, seed);
    if (!all) all = played;
    const Percentiles us = percentilesOf(played.us);
    result.violations += played.otherInReplay;
    result.table.rows.push_back(
        {std::int64_t{kPlayers}, std::int64_t{kTickHz}, mm, played.kib, played.posesKib,
         played.thinUs, us.p50, us.p90, us.p99, percent(played.hits, count),
         percent(othersIn(*all, played), count), cell(played.otherInReplay)});
  }
  return result;
}

}  // namespace foretouch::tools
