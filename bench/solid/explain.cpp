#include "bench/solid/explain.h"

#include <algorithm>
#include <utility>

#include "articulated/try.h"
#include "bench/machine.h"
#include "bench/solid/cells.h"
#include "lss/index.h"
#include "middleware/solid/solid_avatar.h"

namespace foretouch::tools {
namespace {

/// The share of all ticks in contact, the slowest, that are taken apart.
constexpr double kSlowest = 0.01;
/// A link that is nearer than this (m) to where it is tracked is there.
constexpr double kIsThere = 1e-4;

constexpr const char* kHeldBy[kNumHeldBy] = {
    "itself inside something", "the trunk inside something", "another limb inside something",
    "free: catching up",       "free: on a way around",      "free: no way found yet"};

/// Which links of the tracked body are inside something.
class TrackedLinks {
 public:
  TrackedLinks(const SolidStage& stage, const SolidActor& actor)
      : links_(solidLinks(actor.avatar)) {
    for (LinkId link = 0; link < actor.avatar.numLinks(); ++link) {
      std::vector<bool> alone(countOf(actor.avatar.numLinks()), false);
      alone[slotOf(link)] = true;
      judges_.emplace_back(stage.judged, plainBody(actor.avatar, alone));
    }
    isInside_.assign(judges_.size(), false);
  }
  void look(const oracle::PlainPose& tracked) {
    isAny_ = isTrunk_ = false;
    for (std::size_t link = 0; link < judges_.size(); ++link) {
      isInside_[link] = judges_[link].at(tracked, 0.0).link >= 0;
      isAny_ = isAny_ || isInside_[link];
      isTrunk_ = isTrunk_ || (isInside_[link] && links_.trunk[link]);
    }
  }
  [[nodiscard]] bool isAny() const { return isAny_; }
  [[nodiscard]] HeldBy whyOf(std::size_t link) const {
    if (isInside_[link]) return HeldBy::Itself;
    return isTrunk_ ? HeldBy::Trunk : HeldBy::Limb;
  }

 private:
  SolidLinks links_;
  std::vector<oracle::WayJudge> judges_;
  std::vector<bool> isInside_;
  bool isAny_ = false, isTrunk_ = false;
};

class Explainer {
 public:
  Explainer(const SolidStage& stage, const SolidActor& actor, double tolerance)
      : links_(stage, actor),
        whole_(stage.judged, plainBody(actor.avatar)),
        tolerance_(tolerance) {}

  void look(const Pose& tracked, const SolidTick& tick, ExplainTally& tally) {
    const oracle::PlainPose wanted = plainPose(tracked);
    links_.look(wanted);
    const HeldBy free = whyFree(wanted, tick);
    for (std::size_t link = 0; link < tick.linkDeviation.size(); ++link) {
      ++tally.allLinks;
      const double off = tick.linkDeviation[link];
      if (!(off > kIsThere)) continue;
      const auto why = static_cast<std::size_t>(links_.isAny() ? links_.whyOf(link) : free);
      tally.off[why] += off;
      ++tally.links[why];
    }
    last_ = plainPose(tick.shown);
  }

 private:
  HeldBy whyFree(const oracle::PlainPose& wanted, const SolidTick& tick) {
    if (links_.isAny()) return HeldBy::Itself;
    if (tick.state == SolidState::Around) return HeldBy::OnWay;
    const bool isDirect =
        !last_.rotations.empty() && whole_.along(last_, wanted, 1.01 * tolerance_).link < 0;
    return isDirect ? HeldBy::CatchUp : HeldBy::NoWay;
  }

  TrackedLinks links_;
  oracle::WayJudge whole_;
  double tolerance_;
  oracle::PlainPose last_;
};

ExplainedTick explained(const internal::SolidPhases& phases, const SolidTick& tick, double us) {
  ExplainedTick one;
  one.us = us;
  for (std::size_t phase = 0; phase < internal::kNumSolidPhases; ++phase) {
    one.phases[phase] = phases.microseconds(static_cast<internal::SolidPhase>(phase));
  }
  one.counters = tick.counters;
  one.limit = tick.limit;
  one.isInContact = !isFreeTick(tick);
  return one;
}

template <typename Of>
double meanOf(const std::vector<ExplainedTick>& ticks, const Of& of) {
  double sum = 0.0;
  for (const ExplainedTick& tick : ticks) sum += static_cast<double>(of(tick));
  return sum / static_cast<double>(std::max<std::size_t>(ticks.size(), 1));
}

std::vector<BenchCell> tailCells(const std::vector<ExplainedTick>& ticks) {
  using internal::SolidPhase;
  std::vector<BenchCell> cells;
  const auto append = [&](const auto& of) { cells.emplace_back(meanOf(ticks, of)); };
  cells.emplace_back(cell(ticks.size()));
  append([](const ExplainedTick& tick) { return tick.us; });
  for (const SolidPhase phase : {SolidPhase::Gather, SolidPhase::Solve, SolidPhase::Try,
                                 SolidPhase::Prove, SolidPhase::Around, SolidPhase::Other}) {
    append([phase](const ExplainedTick& tick) {
      return tick.phases[static_cast<std::size_t>(phase)];
    });
  }
  for (const auto count : {&SolidCounters::queries, &SolidCounters::iterations,
                           &SolidCounters::features, &SolidCounters::rows}) {
    append([count](const ExplainedTick& tick) { return tick.counters.*count; });
  }
  append([](const ExplainedTick& tick) { return 1e-3 * static_cast<double>(tick.counters.work); });
  append([](const ExplainedTick& tick) { return tick.limit == SolidLimit::Budget ? 100.0 : 0.0; });
  return cells;
}

}  // namespace

void ExplainTally::add(const ExplainTally& other) {
  ticks.insert(ticks.end(), other.ticks.begin(), other.ticks.end());
  for (std::size_t why = 0; why < kNumHeldBy; ++why) {
    off[why] += other.off[why];
    links[why] += other.links[why];
  }
  allLinks += other.allLinks;
}

Result<ExplainTally> explain(const SolidStage& stage, const SolidActor& actor,
                             const std::vector<Pose>& tracked, double rateHz,
                             const SolidOptions& options) {
  FORETOUCH_TRY(auto solid, SolidAvatar::build(actor.avatar, stage.scene, options));
  internal::SolidPhases phases;
  solid.watch(&phases);
  Explainer explainer(stage, actor, options.tolerance);
  ExplainTally tally;
  SolidTick tick;
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    const ThreadStopwatch watch;
    FORETOUCH_CHECK(solid.follow({tracked[i], 1.0 / rateHz, nullptr}, tick));
    const double us = watch.us();
    if (i > 0) tally.ticks.push_back(explained(phases, tick, us));
    explainer.look(tracked[i], tick, tally);
  }
  return tally;
}

ExplainTables::ExplainTables()
    : tail_{"tail",
            "On what ticks in contact spend their time",
            {{"scene", "scene"},
             {"rate_hz", "Hz", 0},
             {"which", "which"},
             {"ticks", "ticks", 0},
             {"mean_us", "mean us", 1},
             {"gather_us", "gathering", 1},
             {"solve_us", "the step", 1},
             {"try_us", "trying it", 1},
             {"prove_us", "proofs", 1},
             {"around_us", "ways around", 1},
             {"other_us", "else", 1},
             {"queries", "queries", 2},
             {"iterations", "steps", 2},
             {"features", "near features", 0},
             {"rows", "rows", 0},
             {"work", "work, thousands", 1},
             {"budget_percent", "budget spent %", 0}},
            {}},
      held_{"held",
            "What holds links from where they are tracked",
            {{"scene", "scene"},
             {"rate_hz", "Hz", 0},
             {"held_by", "held by"},
             {"links_percent", "of all links %", 1},
             {"mean_mm", "off, mean mm", 1},
             {"share_mm", "of the mean of all links, mm", 2}},
            {}} {}

void ExplainTables::add(const std::string& scene, double rateHz, const ExplainTally& tally) {
  std::vector<ExplainedTick> contact;
  for (const ExplainedTick& tick : tally.ticks) {
    if (tick.isInContact) contact.push_back(tick);
  }
  const auto slower = [](const ExplainedTick& a, const ExplainedTick& b) { return a.us > b.us; };
  std::sort(contact.begin(), contact.end(), slower);
  const auto slowest = static_cast<std::size_t>(kSlowest * static_cast<double>(contact.size()));
  const auto end = contact.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(slowest, 1));
  const auto append = [&](const char* which, const std::vector<ExplainedTick>& ticks) {
    std::vector<BenchCell> cells{scene, rateHz, which};
    for (BenchCell& cell : tailCells(ticks)) cells.push_back(std::move(cell));
    tail_.rows.push_back(std::move(cells));
  };
  if (!contact.empty()) {
    append("all", contact);
    append("slowest 1 %", {contact.begin(), end});
  }
  for (std::size_t why = 0; why < kNumHeldBy; ++why) {
    const auto count = static_cast<double>(std::max<std::uint64_t>(tally.links[why], 1));
    const auto all = static_cast<double>(std::max<std::uint64_t>(tally.allLinks, 1));
    held_.rows.push_back({scene, rateHz, kHeldBy[why], percent(tally.links[why], tally.allLinks),
                          kMm * tally.off[why] / count, kMm * tally.off[why] / all});
  }
}

void ExplainTables::appendTo(BenchReport& report) const {
  if (held_.rows.empty()) return;
  report.tables.push_back(tail_);
  report.tables.push_back(held_);
  report.notes.emplace_back(
      "Phases are by the wall's clock, ticks by the thread's processor time.");
}

}  // namespace foretouch::tools
