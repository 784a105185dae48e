#include "bench/solid/feel_tables.h"

#include <utility>

#include "bench/solid/cells.h"
#include "bench/timing.h"

namespace foretouch::tools {
namespace {

std::vector<BenchColumn> withRun(std::vector<BenchColumn> columns) {
  columns.insert(columns.begin(),
                 {{"scene", "scene"}, {"rate_hz", "Hz", 0}, {"follower", "shown by"}});
  return columns;
}

std::vector<BenchCell> begin(const FeelRow& row) {
  return {row.scene, row.rateHz, row.follower};
}

}  // namespace

FeelTables::FeelTables()
    : feel_{"feel",
            "How far the shown body is from the tracked one",
            withRun({{"places", "places", 0},
                     {"ticks", "ticks", 0},
                     {"inside_percent", "tracked inside %", 0},
                     {"deviation_mean_mm", "all links mean mm", 1},
                     {"deviation_p90_mm", "p90", 1},
                     {"deviation_p99_mm", "p99", 0},
                     {"hands_mean_mm", "hands mean mm", 1},
                     {"hands_p90_mm", "p90", 1},
                     {"hands_alone_p90_mm", "p90, hands and trunk free", 1},
                     {"lift_mean_mm", "lift mean mm", 1},
                     {"head_mean_mm", "head mean mm", 1},
                     {"head_p90_mm", "p90", 1},
                     {"head_alone_p90_mm", "p90, trunk free", 1},
                     {"equal_percent", "equal % of free", 1},
                     {"away_percent", "away % of free", 1},
                     {"late", "late ticks", 0}}),
            {}},
      motion_{"motion",
              "How it moves",
              withRun({{"returns", "returns", 0},
                       {"back_mean", "back, ticks mean", 1},
                       {"back_p90", "p90", 0},
                       {"never_back", "never back", 0},
                       {"acceleration_p50", "m/s^2 p50", 1},
                       {"acceleration_p90", "p90", 0},
                       {"acceleration_p99", "p99", 0},
                       {"tracked_p99", "tracked p99", 0},
                       {"fastest_mps", "fastest m/s", 1}}),
              {}},
      cost_{"cost",
            "What a tick costs (processor time of the thread)",
            withRun({{"mean_us", "mean us", 1},
                     {"p50_us", "p50", 1},
                     {"p99_us", "p99", 0},
                     {"max_us", "max", 0},
                     {"contact_mean_us", "contact tick mean us", 1},
                     {"contact_p50_us", "p50", 1},
                     {"contact_p99_us", "p99", 0},
                     {"free_p50_us", "free tick p50 us", 2},
                     {"over_p50_us", "beyond its query p50 us", 2},
                     {"bare_mean_us", "bare query mean us", 2},
                     {"ratio", "whole over bare", 1},
                     {"queries_mean", "queries mean", 2},
                     {"queries_p99", "p99", 0},
                     {"around_mean", "of them around", 2},
                     {"iterations_mean", "steps mean", 2}}),
            {}},
      promise_{"promise",
               "What the judge finds on the whole shown way",
               withRun({{"moved", "ticks moved", 0},
                        {"instants", "instants", 0},
                        {"penetrations", "penetrations", 0},
                        {"least_m", "least separation m", -1},
                        {"broken", "discontinuous", 0},
                        {"overclaimed", "clearance too high", 0},
                        {"uncertified", "uncertified", 0},
                        {"appeared", "appeared", 0},
                        {"equal", "equal", 0},
                        {"following", "following", 0},
                        {"sliding", "sliding", 0},
                        {"held", "held", 0},
                        {"around", "around", 0},
                        {"budget", "budget spent", 0}}),
               {}} {}

void FeelTables::add(const FeelRow& row, const FeelTally& tally) {
  const Percentiles all = percentilesOf(tally.deviation), hands = percentilesOf(tally.hands),
                    head = percentilesOf(tally.head), alone = percentilesOf(tally.headAlone),
                    back = percentilesOf(tally.back), moves = percentilesOf(tally.acceleration),
                    tracked = percentilesOf(tally.trackedAcceleration),
                    us = percentilesOf(tally.us), contact = percentilesOf(tally.contactUs),
                    free = percentilesOf(tally.freeUs), over = percentilesOf(tally.overBareUs),
                    bare = percentilesOf(tally.bareUs), queries = percentilesOf(tally.queries);
  const auto append = [&](BenchTable& table, std::vector<BenchCell> cells) {
    std::vector<BenchCell> whole = begin(row);
    whole.insert(whole.end(), cells.begin(), cells.end());
    table.rows.push_back(std::move(whole));
  };
  append(feel_, {std::int64_t{row.places}, cell(tally.ticks), percent(tally.inside, tally.ticks),
                 all.mean * kMm, all.p90 * kMm, all.p99 * kMm, hands.mean * kMm, hands.p90 * kMm,
                 percentilesOf(tally.handsAlone).p90 * kMm, percentilesOf(tally.lift).mean * kMm,
                 head.mean * kMm, head.p90 * kMm, alone.p90 * kMm, percent(tally.equal, tally.free),
                 percent(tally.away, tally.free), cell(tally.late)});
  append(motion_,
         {static_cast<std::int64_t>(tally.back.size()), back.mean, back.p90, cell(tally.neverBack),
          moves.p50, moves.p90, moves.p99, tracked.p99, tally.fastest});
  append(cost_, {us.mean, us.p50, us.p99, us.max, contact.mean, contact.p50, contact.p99, free.p50,
                 over.p50, bare.mean, us.mean / bare.mean, queries.mean, queries.p99,
                 percentilesOf(tally.aroundQueries).mean, percentilesOf(tally.iterations).mean});
  const auto state = [&](SolidState one) {
    return cell(tally.way.states[static_cast<std::size_t>(one)]);
  };
  append(promise_,
         {cell(tally.way.moved), cell(tally.way.instants), cell(tally.way.inside), tally.way.least,
          cell(tally.way.broken), cell(tally.way.overclaimed), cell(tally.way.uncertified),
          cell(tally.way.appeared), state(SolidState::Equal), state(SolidState::Following),
          state(SolidState::Sliding), state(SolidState::Held), state(SolidState::Around),
          cell(tally.way.limits[static_cast<std::size_t>(SolidLimit::Budget)])});
}

void FeelTables::appendTo(BenchReport& report) const {
  for (const BenchTable& table : {feel_, motion_, cost_, promise_}) report.tables.push_back(table);
  report.notes.insert(
      report.notes.begin(),
      {"Free: the judge finds the tracked pose's separation above zero. Equal: bit for bit.",
       "Late: the judge finds the way from the shown pose to the tracked one free by more than the "
       "tolerance, and it is within the catch-up speed, but the avatar does not take it.",
       "The tracked body is meant as the floor policy lifts it; the lift is told apart.",
       "Away: a link is more than 5 cm from a free tracked pose. Back: ticks after the tracked "
       "pose "
       "came free until shown is equal; \"never back\" counts as long as it was free.",
       "Hold: the limb that touches stays, and the rest is asked again; skin 4 mm."});
}

}  // namespace foretouch::tools
