#include "bench/world/ticking.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench/solid/cells.h"
#include "bench/timing.h"
#include "bench/world/judged_world.h"
#include "bench/world/timed_world.h"
#include "lss/index.h"
#include "tools/portable_random.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kTickingWindowUs = 200'000, kWindowsPerMeeting = 4;
constexpr double kMillisecond = 1e3, kSlowHz = 30.0, kQuickHz = 90.0;

/// Of two segments, in doubles [Ericson05] 5.1.9.
double segmentDistance(const Vector3d& p1, const Vector3d& q1, const Vector3d& p2,
                       const Vector3d& q2) {
  const Vector3d d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r), c = d1.dot(r);
  constexpr double kPoint = 1e-18;
  double s = 0.0, t = 0.0;
  if (a <= kPoint && e > kPoint) {
    t = std::clamp(f / e, 0.0, 1.0);
  } else if (a > kPoint && e <= kPoint) {
    s = std::clamp(-c / a, 0.0, 1.0);
  } else if (a > kPoint) {
    const double b = d1.dot(d2), denominator = a * e - b * b;
    s = denominator > 0.0 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
    t = (b * s + f) / e;
    if (t < 0.0) s = std::clamp(-c / a, 0.0, 1.0);
    if (t > 1.0) s = std::clamp((b - c) / a, 0.0, 1.0);
    t = std::clamp(t, 0.0, 1.0);
  }
  return (p1 + s * d1 - p2 - t * d2).norm();
}

/// What was first for two links, in microseconds after the window's begin; below 0: nothing.
struct FirstSeen {
  double us = -1.0;
  [[nodiscard]] bool isThere() const { return us >= 0.0; }
};
/// Per link of the one and of the other, row after row.
using SeenPairs = std::vector<FirstSeen>;

/// One of the two, with all of his samples.
struct Walker {
  const ClipPoses* clip = nullptr;
  std::int64_t offsetUs = 0;
  std::vector<Pose> samples;

  [[nodiscard]] const Avatar& avatar() const { return clip->actor->avatar; }
  [[nodiscard]] std::int64_t instant(std::size_t k) const {
    return offsetUs + clip->periodUs * static_cast<std::int64_t>(k);
  }
  [[nodiscard]] const Pose& newestAt(std::int64_t us) const {
    const auto k =
        static_cast<std::size_t>(std::max<std::int64_t>(us - offsetUs, 0) / clip->periodUs);
    return samples[std::min(k, samples.size() - 1)];
  }
};

class Meeting {
 public:
  Meeting(Walker one, Walker other) : one_(std::move(one)), other_(std::move(other)) {
    for (const Walker* walker : {&one_, &other_}) {
      const BodyId body = world_.world().add(walker->avatar()).value();
      judge_.bodies.push_back(judgedBody(walker->avatar()));
      for (std::size_t k = 0; k < walker->samples.size(); ++k) {
        world_.push(body, walker->instant(k), walker->samples[k]);
        pushJudged(judge_.bodies.back(), walker->instant(k), walker->samples[k]);
      }
    }
  }
  [[nodiscard]] std::size_t pairs() const {
    return countOf(one_.avatar().numLinks()) * countOf(other_.avatar().numLinks());
  }

  /// Nothing in a pair that touches where the window begins, or that the judge gives up.
  [[nodiscard]] std::vector<bool> truth(std::int64_t fromUs, SeenPairs& seen) const {
    const std::int64_t toUs = fromUs + kTickingWindowUs;
    const std::vector<bool> may = judge_.mayTouch(0, 1, fromUs, toUs);
    std::vector<bool> counts(pairs(), true);
    seen.assign(pairs(), {});
    for (std::size_t i = 0; i < may.size(); ++i) {
      if (!may[i]) continue;
      const auto links = countOf(other_.avatar().numLinks());
      const auto touch = judge_.firstTouch(0, static_cast<int>(i / links), 1,
                                           static_cast<int>(i % links), fromUs, toUs);
      counts[i] = touch.outcome != oracle::OracleOutcome::Uncertain && touch.time > 0;
      if (touch.outcome == oracle::OracleOutcome::Touch) {
        seen[i].us = static_cast<double>(touch.time);
      }
    }
    return counts;
  }

  void byTicks(std::int64_t fromUs, SeenPairs& seen) const {
    seen.assign(pairs(), {});
    const auto periodUs = static_cast<std::int64_t>(1e6 / kQuickHz);
    for (std::int64_t us = fromUs; us <= fromUs + kTickingWindowUs; us += periodUs) {
      const Pose &a = one_.newestAt(us), &b = other_.newestAt(us);
      lookAt(a, b, static_cast<double>(us - fromUs), seen);
    }
  }

  void byWorld(std::int64_t fromUs, SeenPairs& seen) {
    seen.assign(pairs(), {});
    world_.ask(fromUs, fromUs + kTickingWindowUs, true);
    for (const WorldContact& contact : world_.answer().contacts) {
      const std::size_t i =
          slotOf(contact.a.link) * countOf(other_.avatar().numLinks()) + slotOf(contact.b.link);
      seen[i].us = microsecondsAfter(fromUs, contact.time);
    }
  }
  [[nodiscard]] double gapAt(std::size_t pair, std::int64_t fromUs, double us) const {
    const auto links = countOf(other_.avatar().numLinks());
    return static_cast<double>(judge_.separationAt(0, static_cast<int>(pair / links), 1,
                                                   static_cast<int>(pair % links), fromUs,
                                                   static_cast<oracle::Real>(us)));
  }

 private:
  void lookAt(const Pose& a, const Pose& b, double us, SeenPairs& seen) const {
    std::vector<LinkState> ofOne, ofOther;
    ChainMotion(one_.avatar().skeleton(), a, a).statesAt(0.0, ofOne);
    ChainMotion(other_.avatar().skeleton(), b, b).statesAt(0.0, ofOther);
    std::size_t pair = 0;
    for (LinkId i = 0; i < one_.avatar().numLinks(); ++i) {
      for (LinkId j = 0; j < other_.avatar().numLinks(); ++j, ++pair) {
        if (!seen[pair].isThere() && overlap(i, ofOne[slotOf(i)], j, ofOther[slotOf(j)])) {
          seen[pair].us = us;
        }
      }
    }
  }
  [[nodiscard]] bool overlap(LinkId i, const LinkState& atI, LinkId j, const LinkState& atJ) const {
    for (const Lss& x : one_.avatar().lss(i)) {
      for (const Lss& y : other_.avatar().lss(j)) {
        if (segmentDistance(atI.pointAt(x.a), atI.pointAt(x.b), atJ.pointAt(y.a),
                            atJ.pointAt(y.b)) <= x.radius + y.radius) {
          return true;
        }
      }
    }
    return false;
  }

  Walker one_, other_;
  TimedWorld world_;
  oracle::OracleWorld judge_;
};

struct TickingTally {
  std::uint64_t touches = 0, missed = 0, invented = 0, late = 0;
  std::vector<double> offMs;

  void add(const FirstSeen& truth, const FirstSeen& seen) {
    touches += truth.isThere();
    missed += truth.isThere() && !seen.isThere();
    invented += !truth.isThere() && seen.isThere();
    if (!truth.isThere() || !seen.isThere()) return;
    // The judge's first instant is within a nanometre of the touch.
    late += seen.us > truth.us + 1e-6;
    offMs.push_back(std::abs(seen.us - truth.us) / kMillisecond);
  }
  [[nodiscard]] std::vector<BenchCell> row(const char* name) const {
    const Percentiles off = percentilesOf(offMs);
    return {std::string(name), cell(touches), cell(missed), cell(invented),
            cell(late),        off.p50,       off.p90,      off.p99};
  }
};

Walker walkerOf(const ClipPoses& clip, const Placement& place, const Vector3d& speed,
                std::size_t phase, std::int64_t offsetUs) {
  Walker walker{&clip, offsetUs, {}};
  Person person;
  person.clip = &clip;
  person.place = place;
  person.phase = phase;
  const std::int64_t untilUs = kWindowsPerMeeting * kTickingWindowUs;
  for (std::int64_t k = 0; k == 0 || offsetUs + clip.periodUs * (k - 1) < untilUs; ++k) {
    Pose pose = person.pose(k);
    pose.translations[0] += 1e-6 * static_cast<double>(offsetUs + clip.periodUs * k) * speed;
    walker.samples.push_back(std::move(pose));
  }
  return walker;
}

}  // namespace

TickingTable tickingTable(const WorldCast& cast, int windows) {
  TickingTable result;
  result.table = {"ticking",
                  "Two people, tracked 30 and 90 times per second: links that first touch within a "
                  "window of 0.2 s, by the judge and as seen",
                  {{"seen_by", "seen by"},
                   {"touches", "touches", 0},
                   {"missed", "missed", 0},
                   {"invented", "invented", 0},
                   {"late", "later than true", 0},
                   {"off_p50_ms", "off by ms p50", 4},
                   {"off_p90_ms", "p90", 4},
                   {"off_p99_ms", "p99", 4}},
                  {}};
  const auto slow = clipPosesOf(cast, kSlowHz), quick = clipPosesOf(cast, kQuickHz);
  TickingTally ticks, world;
  for (int done = 0, meeting = 0; done < windows; ++meeting) {
    PortableRandom random(static_cast<std::uint64_t>(meeting));
    const auto n = static_cast<std::size_t>(meeting);
    Placement beside;
    beside.yawDeg = random.uniform(0.0, 360.0);
    beside.origin = Vector3d(random.uniform(0.4, 0.9), 0.0, random.uniform(-0.3, 0.3));
    const Vector3d speed(random.uniform(-1.5, -0.3), 0.0, random.uniform(-0.4, 0.4));
    Meeting two(walkerOf(slow[n % slow.size()], {}, Vector3d::Zero(), 11 * n, 0),
                walkerOf(quick[(n / slow.size() + n) % quick.size()], beside, speed, 29 * n,
                         -static_cast<std::int64_t>(random.uniform(0.0, 11'000.0))));
    for (std::int64_t w = 0; w < kWindowsPerMeeting && done < windows; ++w, ++done) {
      SeenPairs truth, byTicks, byWorld;
      const std::vector<bool> counts = two.truth(w * kTickingWindowUs, truth);
      two.byTicks(w * kTickingWindowUs, byTicks);
      two.byWorld(w * kTickingWindowUs, byWorld);
      for (std::size_t i = 0; i < counts.size(); ++i) {
        if (!counts[i]) continue;
        ticks.add(truth[i], byTicks[i]);
        world.add(truth[i], byWorld[i]);
        if (!byWorld[i].isThere()) continue;
        const double gap = two.gapAt(i, w * kTickingWindowUs, byWorld[i].us);
        result.violations += gap > kBenchWorldTolerance * (1.0 + 1e-9);
      }
    }
  }
  result.violations += world.missed + world.late;
  result.table.rows = {ticks.row("ticks at 90 Hz, newest samples"), world.row("World, 1 mm")};
  return result;
}

}  // namespace foretouch::tools
