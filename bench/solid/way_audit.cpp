#include "bench/solid/way_audit.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace foretouch::tools {
namespace {

constexpr std::size_t kMostFindings = 20;

oracle::WayBody bodyWith(const Avatar& avatar, const std::vector<std::array<int, 2>>& ownPairs) {
  oracle::WayBody body = plainBody(avatar);
  body.ownPairs = ownPairs;
  return body;
}

}  // namespace

void WayTally::add(const WayTally& other) {
  ticks += other.ticks;
  instants += other.instants;
  moved += other.moved;
  inside += other.inside;
  broken += other.broken;
  overclaimed += other.overclaimed;
  uncertified += other.uncertified;
  appeared += other.appeared;
  for (std::size_t i = 0; i < kNumSolidStates; ++i) states[i] += other.states[i];
  for (std::size_t i = 0; i < kNumSolidLimits; ++i) limits[i] += other.limits[i];
  least = std::min(least, other.least);
  for (const std::string& finding : other.findings) {
    if (findings.size() < kMostFindings) findings.push_back(finding);
  }
}

WayAudit::WayAudit(const oracle::Scene& scene, const Avatar& avatar,
                   const std::vector<std::array<int, 2>>& ownPairs)
    : judge_(scene, bodyWith(avatar, ownPairs)) {}

void WayAudit::begin(std::string name) {
  name_ = std::move(name);
  tickOfRun_ = 0;
  shown_ = {};
}

void WayAudit::find(const std::string& what) {
  if (tally_.findings.size() >= kMostFindings) return;
  tally_.findings.push_back(fmt::format("{}, tick {}: {}", name_, tickOfRun_, what));
}

void WayAudit::lookAlong(const SolidTick& tick) {
  oracle::WayLooks looks;
  looks.instants = (kInstants + static_cast<int>(tick.numWay)) / static_cast<int>(tick.numWay) + 1;
  oracle::WayReading worst;
  worst.least = kLooksFarM;
  std::size_t first = 0;
  oracle::PlainPose from = shown_;
  if (tick.hasAppeared) {
    from = plainPose(tick.way[0]);
    worst = judge_.at(from, kLooksFarM);
    first = 1;
  }
  for (std::size_t i = first; i < tick.numWay; ++i) {
    oracle::PlainPose to = plainPose(tick.way[i]);
    const oracle::WayReading piece = judge_.along(from, to, kLooksFarM, looks);
    tally_.instants += piece.instants;
    if (piece.least < worst.least) worst = piece;
    from = std::move(to);
  }
  leastOfTick_ = worst.link < 0 ? std::numeric_limits<double>::infinity() : worst.least;
  tally_.least = std::min(tally_.least, leastOfTick_);
  const std::string where = fmt::format("{:.9g} m at t {:.3f}, link {} and {} {}", worst.least,
                                        worst.t, worst.link, worst.other < 0 ? "triangle" : "link",
                                        worst.other < 0 ? worst.triangle : worst.other);
  if (leastOfTick_ <= 0.0) {
    ++tally_.inside;
    find("inside: " + where);
  } else if (tick.clearance > leastOfTick_ + kRounding) {
    ++tally_.overclaimed;
    find(fmt::format("clearance {:.9g} above {}", tick.clearance, where));
  }
}

void WayAudit::look(const SolidTick& tick) {
  ++tally_.ticks;
  ++tally_.states[static_cast<std::size_t>(tick.state)];
  ++tally_.limits[static_cast<std::size_t>(tick.limit)];
  tally_.appeared += tick.hasAppeared ? 1 : 0;
  leastOfTick_ = std::numeric_limits<double>::infinity();
  const oracle::PlainPose shown = plainPose(tick.shown);
  const bool isPlaced = tick.state != SolidState::Placing && tick.limit != SolidLimit::Inside;
  if (isPlaced && !tick.isCertified) ++tally_.uncertified;
  if (isPlaced && tick.numWay == 0 && !shown_.rotations.empty() && !(shown == shown_)) {
    ++tally_.broken;
    find("moved without a way");
  }
  if (isPlaced && tick.numWay > 0) {
    ++tally_.moved;
    const bool isFirst = shown_.rotations.empty();
    if ((isFirst && !tick.hasAppeared) || !(plainPose(tick.way[tick.numWay - 1]) == shown)) {
      ++tally_.broken;
      find("its way does not lead from place to place");
    }
    if (!isFirst || tick.hasAppeared) lookAlong(tick);
  }
  if (isPlaced) shown_ = shown;
  ++tickOfRun_;
}

}  // namespace foretouch::tools
