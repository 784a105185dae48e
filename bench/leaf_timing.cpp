#include "bench/leaf_timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/machine.h"
#include "lss/assert.h"

namespace foretouch::tools {
namespace {

using Clock = std::chrono::steady_clock;

double usBetween(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::micro>(to - from).count();
}

LeafGroup groupOf(const TimedSet& set, bool positive) {
  LeafGroup group;
  group.name = set.name;
  group.kind = set.kind;
  group.positive = positive;
  std::vector<double> us;
  for (const TimedLeaf& leaf : set.leaves) {
    if (leaf.truth.value_or(leaf.hits) != positive) continue;
    group.labelled = leaf.truth.has_value();
    group.falseNegatives += positive && !leaf.hits ? 1 : 0;
    group.falsePositives += !positive && leaf.hits ? 1 : 0;
    us.push_back(leaf.us);
    const auto stage = static_cast<std::size_t>(leaf.stage);
    ++group.decided[stage];
    group.decidedMeanUs[stage] += leaf.us;
  }
  group.count = us.size();
  group.time = figuresOf(std::move(us));
  for (std::size_t s = 0; s < kLeafStages; ++s) {
    if (group.decided[s] > 0) group.decidedMeanUs[s] /= static_cast<double>(group.decided[s]);
  }
  return group;
}

}  // namespace

TimeFigures figuresOf(std::vector<double> us) {
  TimeFigures figures;
  if (us.empty()) return figures;
  std::sort(us.begin(), us.end());
  double sum = 0.0;
  for (const double value : us) sum += value;
  const auto rank = [&](double share) {
    const auto place = static_cast<std::size_t>(std::ceil(share * static_cast<double>(us.size())));
    return us[std::max<std::size_t>(place, 1) - 1];
  };
  figures.meanUs = sum / static_cast<double>(us.size());
  figures.medianUs = rank(0.5);
  figures.p99Us = rank(0.99);
  figures.maxUs = us.back();
  return figures;
}

double clockOverheadUs() {
  const auto origin = Clock::now();
  return overheadOf([&] { return usBetween(origin, Clock::now()); });
}

std::vector<TimedLeaf> timeLeaves(std::size_t count, int repeat,
                                  const std::function<LeafAnswer(std::size_t)>& ask) {
  FORETOUCH_ASSERT(repeat >= 1);
  const double overhead = clockOverheadUs();
  std::vector<TimedLeaf> leaves(count);
  for (int pass = 0; pass < repeat; ++pass) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto from = Clock::now();
      const LeafAnswer got = ask(i);
      const double us = std::max(0.0, usBetween(from, Clock::now()) - overhead);
      TimedLeaf& leaf = leaves[i];
      leaf.us = pass == 0 ? us : std::min(leaf.us, us);
      leaf.stage = got.stage;
      leaf.hits = got.hits;
    }
  }
  return leaves;
}

std::vector<LeafGroup> groupsOf(const TimedSet& set) {
  std::vector<LeafGroup> groups;
  for (const bool positive : {true, false}) {
    LeafGroup group = groupOf(set, positive);
    if (group.count > 0) groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<TimedSet> joined(const std::vector<TimedSet>& sets, const std::string& name,
                             const std::function<bool(const TimedSet&)>& take) {
  std::vector<TimedSet> byKind;
  TimedSet all{name, "both", {}};
  for (const TimedSet& set : sets) {
    if (!take(set)) continue;
    auto same = std::find_if(byKind.begin(), byKind.end(),
                             [&](const TimedSet& s) { return s.kind == set.kind; });
    if (same == byKind.end()) same = byKind.insert(same, TimedSet{name, set.kind, {}});
    same->leaves.insert(same->leaves.end(), set.leaves.begin(), set.leaves.end());
    all.leaves.insert(all.leaves.end(), set.leaves.begin(), set.leaves.end());
  }
  if (byKind.size() > 1) byKind.push_back(std::move(all));
  return byKind;
}

}  // namespace foretouch::tools
