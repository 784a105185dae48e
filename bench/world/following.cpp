#include "bench/world/following.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "bench/machine.h"
#include "bench/solid/cells.h"
#include "bench/timing.h"
#include "bench/world/meeting.h"
#include "bench/world/timed_world.h"
#include "middleware/events/world_follower.h"

namespace foretouch::tools {
namespace {

constexpr std::int64_t kMeetingUs = 800'000, kWindowUs = 200'000;
constexpr double kUsPerMs = 1e3;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// From when to when two links touch, microseconds; before the first instant: -infinity, after the
/// last one: infinity.
struct TouchTime {
  double from = 0.0, to = 0.0;
};
using TouchTimes = std::vector<std::vector<TouchTime>>;  // per pair, by time

/// What is true, and between which instants the promise allows it to be reported.
struct TrueEvent {
  std::size_t pair = 0, touch = 0;
  bool isEnter = true;
  double us = 0.0, earliest = 0.0, latest = 0.0;
};

/// The judge's own scan. Two touches with less than kScanUs of freedom between them count as one.
class Truth {
 public:
  explicit Truth(const Meeting& two) : two_(two) {
    touches_.resize(two.pairs());
    isKnown_.assign(two.pairs(), true);
    std::vector<bool> may(two.pairs(), false);
    for (std::int64_t from = 0; from < kMeetingUs; from += kWindowUs) {
      const auto these = two.judge().mayTouch(0, 1, from, from + kWindowUs);
      for (std::size_t i = 0; i < may.size(); ++i) may[i] = may[i] || these[i];
    }
    for (std::size_t i = 0; i < may.size(); ++i) {
      if (may[i]) scan(i);
    }
  }

  [[nodiscard]] const TouchTimes& touches() const { return touches_; }
  [[nodiscard]] bool isKnown(std::size_t pair) const { return isKnown_[pair]; }

  /// The events of touches that begin and end within the meeting, in order of time.
  [[nodiscard]] std::vector<TrueEvent> events() const {
    std::vector<TrueEvent> events;
    for (std::size_t i = 0; i < touches_.size(); ++i) {
      for (std::size_t k = 0; k < touches_[i].size(); ++k) {
        const TouchTime& touch = touches_[i][k];
        if (touch.from > -kNever) events.push_back(eventOf(i, k, true, touch.from));
        if (touch.to < kNever) events.push_back(eventOf(i, k, false, touch.to));
      }
    }
    std::sort(events.begin(), events.end(),
              [](const TrueEvent& x, const TrueEvent& y) { return x.us < y.us; });
    return events;
  }

 private:
  static constexpr std::int64_t kScanUs = 250;
  static constexpr double kTouching = 1e-9;  // m: the judge's own

  [[nodiscard]] double gap(std::size_t pair, double us) const { return two_.gapAt(pair, 0, us); }

  void scan(std::size_t pair) {
    for (std::int64_t from = 0; from < kMeetingUs;) {
      const auto touch = two_.firstTouch(pair, from, kMeetingUs);
      if (touch.outcome == oracle::OracleOutcome::Uncertain) isKnown_[pair] = false;
      if (touch.outcome != oracle::OracleOutcome::Touch) return;
      const double begin = static_cast<double>(from) + static_cast<double>(touch.time);
      auto us = static_cast<std::int64_t>(std::ceil(begin)) + 1;
      while (us < kMeetingUs && gap(pair, static_cast<double>(us)) <= kTouching) us += kScanUs;
      const bool goesOn = us >= kMeetingUs;
      const bool isAtStart = begin <= 0.0;
      touches_[pair].push_back(
          {isAtStart ? -kNever : begin, goesOn ? kNever : endBefore(pair, begin, us)});
      if (goesOn) return;
      from = us;
    }
  }

  /// The last touch before `freeUs`.
  [[nodiscard]] double endBefore(std::size_t pair, double begin, std::int64_t freeUs) const {
    double low = std::max(begin, static_cast<double>(freeUs - kScanUs));
    double high = static_cast<double>(freeUs);
    constexpr double kEnough = 1e-3;  // us
    while (high - low > kEnough) {
      const double middle = 0.5 * (low + high);
      (gap(pair, middle) <= kTouching ? low : high) = middle;
    }
    return high;
  }

  [[nodiscard]] TrueEvent eventOf(std::size_t pair, std::size_t touch, bool isEnter,
                                  double us) const {
    constexpr double kLookUs = 50.0;
    TrueEvent event{pair, touch, isEnter, us, us, us};
    const double within = isEnter ? kBenchWorldTolerance : 2.0 * kBenchWorldTolerance;
    double& place = isEnter ? event.earliest : event.latest;
    const double step = isEnter ? -kLookUs : kLookUs;
    const auto isLooked = [&] { return place > 0.0 && place < static_cast<double>(kMeetingUs); };
    while (isLooked() && gap(pair, place) <= within) place += step;
    return event;
  }

  const Meeting& two_;
  TouchTimes touches_;
  std::vector<bool> isKnown_;
};

TouchTimes byTicks(const Meeting& two) {
  TouchTimes seen(two.pairs());
  std::vector<bool> before(two.pairs(), false), now;
  for (std::int64_t us = 0; us <= kMeetingUs; us += kGameTickUs) {
    two.overlapsAt(us, now);
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i] && !before[i]) seen[i].push_back({us == 0 ? -kNever : double(us), kNever});
      if (!now[i] && before[i]) seen[i].back().to = static_cast<double>(us);
    }
    before.swap(now);
  }
  return seen;
}

TouchTimes byFollower(const Meeting& two) {
  World world = World::build(std::nullopt, {kBenchWorldTolerance}).value();
  for (const MetWalker* walker : {&two.one(), &two.other()}) {
    const BodyId body = world.add(walker->avatar()).value();
    for (std::size_t k = 0; k < walker->samples.size(); ++k) {
      static_cast<void>(world.push(body, walker->instant(k), walker->samples[k]).value());
    }
  }
  WorldFollower follower = WorldFollower::start(0).value();
  WorldEvents answer;
  static_cast<void>(follower.follow(world, kMeetingUs, answer).value());
  TouchTimes seen(two.pairs());
  for (const WorldEvent& event : answer.events) {
    auto& ofPair = seen[two.pairOf(event.a.link, event.b.link)];
    const double us = microsecondsAfter(0, event.time);
    if (event.kind == EventKind::StartsInside) ofPair.push_back({-kNever, kNever});
    if (event.kind == EventKind::Enter) ofPair.push_back({us, kNever});
    if (event.kind == EventKind::Leave) ofPair.back().to = us;
  }
  return seen;
}

struct EventTally {
  std::uint64_t touches = 0, missed = 0, invented = 0, ordered = 0, wrongOrder = 0, late = 0;
  std::vector<double> offMs;

  /// `slackUs`: so far off a stretch is still taken for the touch.
  void add(const Meeting& two, const Truth& truth, const TouchTimes& seen, double slackUs) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!truth.isKnown(i)) continue;
      for (const TouchTime& touch : truth.touches()[i]) {
        ++touches;
        missed += nearTo(touch, seen[i], slackUs) == nullptr ? 1U : 0U;
      }
      for (const TouchTime& stretch : seen[i]) {
        if (nearTo(stretch, truth.touches()[i], slackUs) != nullptr) continue;
        invented += isGraze(two, i, stretch) ? 0U : 1U;
      }
    }
    addOrder(truth, seen, slackUs);
  }

  [[nodiscard]] std::vector<BenchCell> row(const char* name) const {
    const Percentiles off = percentilesOf(offMs);
    return {std::string(name), cell(touches), cell(missed), cell(invented), cell(ordered),
            cell(wrongOrder),  cell(late),    off.p50,      off.p90,        off.p99};
  }

 private:
  /// The first that overlaps it, or nearly so; null: none.
  static const TouchTime* nearTo(const TouchTime& touch, const std::vector<TouchTime>& others,
                                 double slackUs) {
    for (const TouchTime& other : others) {
      if (other.from <= touch.to + slackUs && other.to >= touch.from - slackUs) return &other;
    }
    return nullptr;
  }
  /// The two come within the tolerance where it is said to begin: legal, and nothing invented.
  static bool isGraze(const Meeting& two, std::size_t pair, const TouchTime& stretch) {
    if (!(stretch.from > -kNever)) return false;
    return two.gapAt(pair, 0, stretch.from) <= kBenchWorldTolerance * (1.0 + 1e-9);
  }

  /// When an event is reported; not finite: it is not.
  static double toldAt(const TrueEvent& event, const Truth& truth, const TouchTimes& seen,
                       double slackUs) {
    const TouchTime* const found =
        nearTo(truth.touches()[event.pair][event.touch], seen[event.pair], slackUs);
    if (found == nullptr) return kNever;
    return event.isEnter ? found->from : found->to;
  }

  /// Adds neighbours in time whose order the tolerance leaves no doubt about.
  void addOrder(const Truth& truth, const TouchTimes& seen, double slackUs) {
    const std::vector<TrueEvent> events = truth.events();
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (!truth.isKnown(events[i].pair)) continue;
      const double told = toldAt(events[i], truth, seen, slackUs);
      if (!std::isfinite(told)) continue;
      offMs.push_back(std::abs(told - events[i].us) / kUsPerMs);
      constexpr double kJudgeUs = 2e-3;  // its own bisection
      const double lateUs = events[i].isEnter ? told - events[i].us : events[i].us - told;
      late += lateUs > kJudgeUs ? 1U : 0U;
      if (i == 0 || !(events[i - 1].latest < events[i].earliest)) continue;
      const double before = toldAt(events[i - 1], truth, seen, slackUs);
      if (!std::isfinite(before)) continue;
      ++ordered;
      wrongOrder += before > told ? 1U : 0U;
    }
  }
};

/// What a world that is asked, and one that is followed, cost for the same people.
struct CrowdCost {
  double askUs = 0.0, followUs = 0.0;
  EventCounters counters;
  std::uint64_t events = 0;
};

CrowdCost followedCrowd(const std::vector<Person>& people, int windows) {
  CrowdCost cost;
  TimedWorld asked;
  World followed = World::build(std::nullopt, {kBenchWorldTolerance}).value();
  for (const Person& person : people) {
    static_cast<void>(asked.add(person, false));
    static_cast<void>(followed.add(person.clip->actor->avatar).value());
  }
  constexpr std::int64_t kFrameUs = 33'333;
  std::vector<std::int64_t> next(people.size(), 0);
  std::int64_t begin = 0;
  for (const Person& person : people) begin = std::max(begin, person.instant(0));
  FollowOptions options;
  options.cutUs = kFrameUs;
  begin = (begin / kFrameUs + 1) * kFrameUs;
  WorldFollower follower = WorldFollower::start(begin, options).value();
  WorldEvents answer;
  for (int window = 0; window < windows; ++window) {
    const std::int64_t end = begin + kFrameUs;
    for (std::size_t i = 0; i < people.size(); ++i) {
      while (next[i] == 0 || people[i].instant(next[i] - 1) < end) {
        const Pose pose = people[i].pose(next[i]);
        asked.push(static_cast<BodyId>(i), people[i].instant(next[i]), pose);
        static_cast<void>(
            followed.push(static_cast<BodyId>(i), people[i].instant(next[i]), pose).value());
        ++next[i];
      }
    }
    asked.ask(begin, end, true);
    const ThreadStopwatch watch;
    static_cast<void>(follower.follow(followed, end, answer).value());
    cost.followUs += watch.us();
    followed.forgetBefore(end);
    cost.counters.add(answer.counters);
    cost.events += answer.events.size();
    begin = end;
  }
  for (const double us : asked.figures.answerUs) cost.askUs += us;
  return cost;
}

}  // namespace

JudgedTable eventsTable(const Cast& cast, int windows) {
  JudgedTable result;
  result.table = {"events",
                  "Two people, tracked 30 and 90 times per second: touches of their links, from "
                  "enter to leave, by the judge and as told",
                  {{"told_by", "told by"},
                   {"touches", "touches", 0},
                   {"missed", "missed", 0},
                   {"invented", "invented", 0},
                   {"neighbours", "neighbours in time", 0},
                   {"wrong_order", "in wrong order", 0},
                   {"late", "enter late, or leave early", 0},
                   {"off_p50_ms", "off by ms p50", 4},
                   {"off_p90_ms", "p90", 4},
                   {"off_p99_ms", "p99", 4}},
                  {}};
  const auto slow = clipPosesOf(cast, 30.0), quick = clipPosesOf(cast, kGameHz);
  constexpr int kWindowsPerMeeting = static_cast<int>(kMeetingUs / kWindowUs);
  constexpr double kSlackOfTicksUs = 40'000.0;  // more than a tick and the older sample together
  EventTally ticks, world;
  for (int n = 0; n * kWindowsPerMeeting < windows; ++n) {
    const Meeting two = meetingOf(slow, quick, n, kMeetingUs);
    const Truth truth(two);
    ticks.add(two, truth, byTicks(two), kSlackOfTicksUs);
    world.add(two, truth, byFollower(two), 0.0);
  }
  result.violations = world.missed + world.invented + world.wrongOrder + world.late;
  result.table.rows = {ticks.row("ticks at 90 Hz, newest samples"),
                       world.row("WorldFollower, 1 mm")};
  return result;
}

BenchTable followingTable(const Cast& cast) {
  BenchTable table{"following",
                   "Ten people at 30 Hz for two seconds, 1 m apart and 4 m apart: to follow them "
                   "beside asking for their first contacts",
                   {{"crowd", "crowd"},
                    {"events", "events", 0},
                    {"ask_us", "first contacts, us per window", 1},
                    {"follow_us", "followed, us per window", 1},
                    {"ratio", "ratio", 2},
                    {"intervals", "intervals", 0},
                    {"stretches", "stretches of them, each between two poses", 0},
                    {"looks_per_stretch", "looks per such stretch", 2},
                    {"looks", "looks per interval", 2}},
                   {}};
  constexpr int kPeople = 10, kWindows = 60;
  const auto clips = clipPosesOf(cast, 30.0);
  for (const auto& [name, spacing] : {std::pair{"near", 1.0}, std::pair{"far", 4.0}}) {
    const CrowdCost cost = followedCrowd(crowdOf(clips, kPeople, spacing), kWindows);
    const auto looks = static_cast<double>(cost.counters.contactLooks + cost.counters.freeLooks);
    const auto per = [&](std::uint64_t n) {
      return looks / static_cast<double>(std::max<std::uint64_t>(1, n));
    };
    table.rows.push_back({std::string(name), cell(cost.events), cost.askUs / kWindows,
                          cost.followUs / kWindows, cost.followUs / std::max(cost.askUs, 1e-9),
                          cell(cost.counters.contacts), cell(cost.counters.stretches),
                          per(cost.counters.stretches), per(cost.counters.contacts)});
  }
  return table;
}

}  // namespace foretouch::tools
