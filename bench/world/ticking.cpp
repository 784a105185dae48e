#include "bench/world/ticking.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bench/solid/cells.h"
#include "bench/timing.h"
#include "bench/world/meeting.h"
#include "bench/world/timed_world.h"

namespace foretouch::tools {
namespace {

constexpr std::int64_t kTickingWindowUs = 200'000, kWindowsPerMeeting = 4;
constexpr double kMillisecond = 1e3, kSlowHz = 30.0, kQuickHz = 90.0;

/// What was first for two links, in microseconds after the window's begin; below 0: nothing.
struct FirstSeen {
  double us = -1.0;
  [[nodiscard]] bool isThere() const { return us >= 0.0; }
};
/// Per link of the one and of the other, row after row.
using SeenPairs = std::vector<FirstSeen>;

/// A meeting, and a world that gets its poses.
class SeenMeeting {
 public:
  explicit SeenMeeting(Meeting two) : two_(std::move(two)) {
    for (const MetWalker* walker : {&two_.one(), &two_.other()}) {
      const BodyId body = world_.world().add(walker->avatar()).value();
      for (std::size_t k = 0; k < walker->samples.size(); ++k) {
        world_.push(body, walker->instant(k), walker->samples[k]);
      }
    }
  }
  [[nodiscard]] const Meeting& two() const { return two_; }

  /// Leaves out a pair that touches where the window begins, or that the judge gives up.
  [[nodiscard]] std::vector<bool> truth(std::int64_t fromUs, SeenPairs& seen) const {
    const std::int64_t toUs = fromUs + kTickingWindowUs;
    const std::vector<bool> may = two_.judge().mayTouch(0, 1, fromUs, toUs);
    std::vector<bool> counts(two_.pairs(), true);
    seen.assign(two_.pairs(), {});
    for (std::size_t i = 0; i < may.size(); ++i) {
      if (!may[i]) continue;
      const auto touch = two_.firstTouch(i, fromUs, toUs);
      counts[i] = touch.outcome != oracle::OracleOutcome::Uncertain && touch.time > 0;
      if (touch.outcome == oracle::OracleOutcome::Touch) {
        seen[i].us = static_cast<double>(touch.time);
      }
    }
    return counts;
  }

  void byTicks(std::int64_t fromUs, SeenPairs& seen) const {
    seen.assign(two_.pairs(), {});
    std::vector<bool> overlaps;
    for (std::int64_t us = fromUs; us <= fromUs + kTickingWindowUs; us += kGameTickUs) {
      two_.overlapsAt(us, overlaps);
      for (std::size_t i = 0; i < overlaps.size(); ++i) {
        if (overlaps[i] && !seen[i].isThere()) seen[i].us = static_cast<double>(us - fromUs);
      }
    }
  }

  void byWorld(std::int64_t fromUs, SeenPairs& seen) {
    seen.assign(two_.pairs(), {});
    world_.ask(fromUs, fromUs + kTickingWindowUs, true);
    for (const WorldContact& contact : world_.answer().contacts) {
      seen[two_.pairOf(contact.a.link, contact.b.link)].us =
          microsecondsAfter(fromUs, contact.time);
    }
  }

 private:
  Meeting two_;
  TimedWorld world_;
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

}  // namespace

JudgedTable tickingTable(const Cast& cast, int windows) {
  JudgedTable result;
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
    SeenMeeting two(meetingOf(slow, quick, meeting, kWindowsPerMeeting * kTickingWindowUs));
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
        const double gap = two.two().gapAt(i, w * kTickingWindowUs, byWorld[i].us);
        result.violations += gap > kBenchWorldTolerance * (1.0 + 1e-9);
      }
    }
  }
  result.violations += world.missed + world.late;
  result.table.rows = {ticks.row("ticks at 90 Hz, newest samples"), world.row("World, 1 mm")};
  return result;
}

}  // namespace foretouch::tools
