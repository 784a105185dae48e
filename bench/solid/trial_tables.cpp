#include "bench/solid/trial_tables.h"

#include <algorithm>

#include "articulated/try.h"
#include "bench/solid/board_trial.h"
#include "bench/solid/cells.h"
#include "bench/solid/clutter_trial.h"
#include "bench/solid/engine_hands.h"
#include "bench/solid/finger_trials.h"
#include "bench/solid/followers.h"
#include "bench/solid/solid_hand.h"
#include "bench/solid/touch_trials.h"
#include "bench/timing.h"

namespace foretouch::tools {
namespace {

constexpr int kFineWall = 98;
/// One of so many hands led through a board looks for a way around it.
constexpr std::uint64_t kTrialsPerAround = 20;
constexpr std::uint64_t kOtherSeeds = 1'000;

constexpr const char *kSolid = "Foretouch, solid", *kPlain = "Foretouch, solid, no way around";

SolidOptions withoutWays(SolidOptions options) {
  options.aroundPerTick = 0;
  return options;
}

double valueAt(std::vector<double> values, double rank) {
  std::sort(values.begin(), values.end());
  return valueAtRank(values, rank);
}

/// The rows of the board: per speed and hand, with a cell per depth.
class BoardRows {
 public:
  BoardRows(std::uint64_t trials, std::uint64_t seed, BenchTable& table)
      : trials_(trials), seed_(seed), table_(table) {}

  void add(HandFollower& hand) {
    const std::vector<BoardCell> cells = boardCells();
    for (std::size_t first = 0; first < cells.size();) {
      std::vector<BenchCell> row{cells[first].speedMps, hand.name(), cell(trials_)};
      std::size_t i = first;
      for (; i < cells.size() && cells[i].speedMps == cells[first].speedMps; ++i) {
        row.emplace_back(cell(tryBoard(hand, cells[i], trials_, seed_ + i).through));
      }
      table_.rows.push_back(std::move(row));
      first = i;
    }
  }

 private:
  std::uint64_t trials_, seed_;
  BenchTable& table_;
};

std::vector<BenchCell> boardsRow(HandFollower& hand, double thickness,
                                 const TrialRequest& request) {
  std::vector<BenchCell> row{kMm * thickness, hand.name(), cell(request.engineTrials)};
  BoardTally whole;
  for (const double speedMps : {1.0, 5.0, 10.0, 20.0}) {
    const auto one = tryBoard(hand, {speedMps, 0.3, thickness}, request.engineTrials,
                              request.seed + static_cast<std::uint64_t>(speedMps));
    row.emplace_back(percent(one.through, one.trials));
    whole.add(one);
  }
  row.emplace_back(kMm * valueAt(whole.sunk, 0.9));
  row.emplace_back(kMm * valueAt(whole.trembles, 0.9));
  row.emplace_back(whole.us / static_cast<double>(whole.ticks));
  return row;
}

double largestDifference(const std::vector<Pose>& one, const std::vector<Pose>& other) {
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i) {
    most = std::max(most, difference(one[i], other[i]));
  }
  return most;
}

}  // namespace

Result<JudgedTable> boardTable(const TrialRequest& request) {
  JudgedTable result;
  result.table = {"board",
                  "Hands led through a board of 4 mm: trials that end behind it",
                  {{"speed_mps", "m/s", 0},
                   {"hand", "hand"},
                   {"trials", "trials per depth", 0},
                   {"through_100_mm", "through, led 0.1 m beyond", 0},
                   {"through_500_mm", "0.5 m", 0},
                   {"through_2000_mm", "2 m", 0}},
                  {}};
  const RawScene raw = board();
  const std::uint64_t perCell =
      std::max<std::uint64_t>(1, request.boardTrials / boardCells().size());
  // A hand behind whose board the target rests looks for a way around, in vain: that takes ten
  // times as long as to follow it there, and most hands are spared it.
  const std::uint64_t around = (perCell + kTrialsPerAround - 1) / kTrialsPerAround;
  FORETOUCH_TRY(const auto solid, SolidHand::build(kSolid, raw, request.options));
  BoardRows(around, request.seed, result.table).add(*solid);
  FORETOUCH_TRY(const auto plain, SolidHand::build(kPlain, raw, withoutWays(request.options)));
  BoardRows(std::max<std::uint64_t>(1, perCell - around), request.seed + kOtherSeeds, result.table)
      .add(*plain);
  result.violations = solid->way().violations() + plain->way().violations();
  const EngineHands engine(raw.triangles);
  for (const auto& hand : engine.of(handLss())) {
    BoardRows(request.engineTrials, request.seed, result.table).add(*hand);
  }
  std::stable_sort(
      result.table.rows.begin(), result.table.rows.end(),
      [](const auto& a, const auto& b) { return std::get<double>(a[0]) < std::get<double>(b[0]); });
  return result;
}

Result<JudgedTable> boardsTable(const TrialRequest& request) {
  JudgedTable result;
  result.table = {"boards",
                  "Hands led through boards, 0.3 m beyond them, at 90 Hz",
                  {{"board_mm", "board, mm", 0},
                   {"hand", "hand"},
                   {"trials", "trials per speed", 0},
                   {"through_1_mps", "through, % at 1 m/s", 1},
                   {"through_5_mps", "5 m/s", 1},
                   {"through_10_mps", "10 m/s", 1},
                   {"through_20_mps", "20 m/s", 1},
                   {"sunk_p90_mm", "others rest in it by, p90 mm", 2},
                   {"trembles_p90_mm", "move per tick at rest, p90 mm", 3},
                   {"mean_us", "tick mean us", 1}},
                  {}};
  for (const double thickness : {1e-3, 4e-3, 1e-2, 4e-2}) {
    const RawScene raw = board(thickness);
    FORETOUCH_TRY(const auto solid, SolidHand::build(kSolid, raw, request.options));
    FORETOUCH_TRY(const auto plain, SolidHand::build(kPlain, raw, withoutWays(request.options)));
    const EngineHands engine(raw.triangles);
    const HandFollowers hands = engine.of(handLss());
    std::vector<HandFollower*> all{solid.get(), plain.get()};
    for (const auto& hand : hands) all.push_back(hand.get());
    for (HandFollower* const hand : all) {
      result.table.rows.push_back(boardsRow(*hand, thickness, request));
    }
    result.violations += solid->way().violations() + plain->way().violations();
  }
  return result;
}

Result<JudgedTable> clutterTable(const TrialRequest& request) {
  JudgedTable result;
  result.table = {"clutter",
                  "An arm among shelves: free places reached within a second",
                  {{"follower", "shown by"},
                   {"goals", "goals", 0},
                   {"straight_percent", "straight way free %", 1},
                   {"reached_percent", "reached %", 1},
                   {"untold", "not reached and not told", 0},
                   {"mean_us", "tick mean us", 1},
                   {"p99_us", "p99", 0},
                   {"penetrations", "penetrations", 0},
                   {"least_m", "least separation m", -1}},
                  {}};
  RawScene raw = clutter();
  FORETOUCH_TRY(const auto scene, Scene::build(std::move(raw)));
  FORETOUCH_TRY(auto hold, holdingFollower(figure(), scene, kHoldSkin));
  FORETOUCH_TRY(auto sliding, solidFollower(figure(), scene, withoutWays(request.options)));
  FORETOUCH_TRY(auto solid, solidFollower(figure(), scene, request.options));
  struct Case {
    const char* name;
    Follower* follower;
  };
  for (const Case& one : {Case{"hold", hold.get()}, Case{"solid, no way around", sliding.get()},
                          Case{"solid", solid.get()}}) {
    FORETOUCH_TRY(const auto tally, tryClutter(*one.follower, request.goals, request.seed));
    const Percentiles us = percentilesOf(tally.us);
    result.table.rows.push_back({std::string(one.name), cell(tally.goals),
                                 percent(tally.straight, tally.goals),
                                 percent(tally.reached, tally.goals), cell(tally.untold), us.mean,
                                 us.p99, cell(tally.way.inside), tally.way.least});
    result.violations += tally.way.violations();
  }
  return result;
}

Result<JudgedTable> slideTable(const TrialRequest& request) {
  JudgedTable result;
  result.table = {"slide",
                  "A hand led along a wall, 10 cm inside: its speed along the wall, shown by "
                  "tracked, per tick",
                  {{"rate_hz", "Hz", 0},
                   {"triangles", "triangles", 0},
                   {"ticks", "ticks in contact", 0},
                   {"p10", "p10", 3},
                   {"p50", "p50", 3},
                   {"p90", "p90", 3},
                   {"difference_m", "most beside 2 triangles, m", -1},
                   {"penetrations", "penetrations", 0}},
                  {}};
  for (const double rateHz : {90.0, 30.0, 10.0}) {
    std::vector<Pose> coarse;
    for (const int fineness : {1, kFineWall}) {
      FORETOUCH_TRY(const auto tally, trySlide(request.options, rateHz, fineness));
      if (fineness == 1) coarse = tally.shown;
      result.table.rows.push_back({rateHz, std::int64_t{2} * fineness * fineness,
                                   static_cast<std::int64_t>(tally.ratio.size()),
                                   valueAt(tally.ratio, 0.1), valueAt(tally.ratio, 0.5),
                                   valueAt(tally.ratio, 0.9),
                                   largestDifference(coarse, tally.shown), cell(tally.way.inside)});
      result.violations += tally.way.violations();
    }
  }
  return result;
}

Result<JudgedTable> pressTable(const TrialRequest& request) {
  FORETOUCH_TRY(const auto tally, tryPress(request.options));
  JudgedTable result;
  result.table = {
      "press",
      "A hand pressed 10 cm into a wall and back, 1 mm per tick",
      {{"ticks", "ticks", 0},
       {"most_push_mm", "largest push mm", 2},
       {"most_jump_percent", "largest change per mm, % of that", 2},
       {"most_slant_deg", "push off the normal, degrees", 4},
       {"untrue", "ticks with an untrue push", 0},
       {"others_mm", "links beyond the arm, mm", 2},
       {"head_mm", "head mm", 2},
       {"penetrations", "penetrations", 0}},
      {{cell(tally.ticks), kMm * tally.mostPush,
        100.0 * tally.mostJump / std::max(tally.mostPush, 1e-300), tally.mostSlantDeg,
        cell(tally.untrue), kMm * tally.otherLinks, kMm * tally.head, cell(tally.way.inside)}}};
  result.violations = tally.way.violations();
  return result;
}

Result<JudgedTable> fingersTable(const TrialRequest& request) {
  FORETOUCH_TRY(const auto tallies, tryFingers(request.options));
  JudgedTable result;
  result.table = {"fingers",
                  "Two hands of 26 joints each, as OpenXR has them, at 90 Hz",
                  {{"task", "task"},
                   {"triangles", "triangles", 0},
                   {"ticks", "ticks", 0},
                   {"equal_percent", "equal %", 1},
                   {"off_p90_mm", "shown off by, p90 mm", 1},
                   {"queries", "queries per tick", 2},
                   {"mean_us", "held ticks: mean us", 0},
                   {"p50_us", "p50", 0},
                   {"p99_us", "p99", 0},
                   {"max_us", "max", 0},
                   {"penetrations", "penetrations", 0}},
                  {}};
  for (const FingerTally& tally : tallies) {
    const Percentiles us = percentilesOf(tally.contactUs);
    result.table.rows.push_back(
        {tally.task, cell(tally.triangles), cell(tally.ticks), percent(tally.equal, tally.ticks),
         kMm * valueAt(tally.offM, 0.9),
         static_cast<double>(tally.queries) / static_cast<double>(tally.ticks), us.mean, us.p50,
         us.p99, us.max, cell(tally.way.inside)});
    result.violations += tally.way.violations();
  }
  return result;
}

BenchTable emptyRestTable() {
  return {"rest",
          "A tracked body that stops inside something, and one that trembles there",
          {{"scene", "scene"},
           {"rate_hz", "Hz", 0},
           {"places", "places", 0},
           {"rest_p50", "ticks until it rests p50", 0},
           {"rest_max", "max", 0},
           {"moving", "places where it moves later than 30 ticks", 0},
           {"most_mm", "most per tick, mm", 3},
           {"queries", "queries per still tick", 3},
           {"noise_p50", "trembling, shown by tracked p50", 3},
           {"noise_max", "max", 3},
           {"worst_p50", "worst end p50", 3},
           {"worst_max", "max", 3}},
          {}};
}

void addRow(const SceneRow& row, const RestTally& tally, BenchTable& table) {
  if (tally.stillStep.empty()) return;
  const auto moving = std::count_if(tally.stillStep.begin(), tally.stillStep.end(),
                                    [](double step) { return step > 0.0; });
  const Percentiles still = percentilesOf(tally.stillStep), rest = percentilesOf(tally.ticksToRest),
                    noise = percentilesOf(tally.noise), worst = percentilesOf(tally.worstEnd);
  table.rows.push_back({row.scene, row.rateHz, static_cast<std::int64_t>(tally.stillStep.size()),
                        rest.p50, rest.max, std::int64_t{moving}, kMm * still.max,
                        static_cast<double>(tally.queries) / static_cast<double>(tally.ticks),
                        noise.p50, noise.max, worst.p50, worst.max});
}

BenchTable emptyHandsTable() {
  return {"hands",
          "Hands beside those of a physics engine, which have no arms",
          {{"scene", "scene"},
           {"rate_hz", "Hz", 0},
           {"hand", "hand"},
           {"ticks", "hands times ticks", 0},
           {"inside_percent", "inside by 0.1 mm, %", 2},
           {"depth_p99_mm", "depth p99 mm", 1},
           {"depth_max_mm", "max", 1},
           {"deviation_mean_mm", "from tracked, mean mm", 1},
           {"deviation_p90_mm", "p90", 1},
           {"deviation_p99_mm", "p99", 1}},
          {}};
}

void addRows(const SceneRow& row, const std::vector<HandsTally>& tallies, BenchTable& table) {
  for (const HandsTally& tally : tallies) {
    const Percentiles depth = percentilesOf(tally.depth), off = percentilesOf(tally.deviation);
    table.rows.push_back({row.scene, row.rateHz, tally.name, cell(tally.ticks),
                          percent(tally.inside, tally.ticks), kMm * depth.p99, kMm * depth.max,
                          kMm * off.mean, kMm * off.p90, kMm * off.p99});
  }
}

}  // namespace foretouch::tools
