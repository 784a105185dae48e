// bench/solid/explain.h: what holds a solid avatar from its tracked body, and on what its slowest
// ticks spend their time.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/report.h"
#include "bench/solid/feel.h"
#include "bench/solid/stage.h"
#include "middleware/solid/solid_options.h"
#include "middleware/solid/solid_phases.h"

namespace foretouch::tools {

/// Why a link is not where it is tracked.
enum class HeldBy : std::uint8_t {
  Itself,   ///< The link is tracked inside something.
  Trunk,    ///< It is tracked in the open, and the trunk inside something.
  Limb,     ///< It and the trunk are tracked in the open, and another limb is not.
  CatchUp,  ///< All is tracked in the open, and so is the direct way there.
  OnWay,    ///< All is tracked in the open, and the body is on a way around.
  NoWay,    ///< All is tracked in the open, and no way around is found yet.
};
inline constexpr std::size_t kNumHeldBy = 6;

struct ExplainedTick {
  double us = 0.0;
  std::array<double, internal::kNumSolidPhases> phases{};
  SolidCounters counters;
  SolidLimit limit = SolidLimit::None;
  bool isInContact = false;
};

struct ExplainTally {
  std::vector<ExplainedTick> ticks;
  std::array<double, kNumHeldBy> off{};           ///< Sums over links and ticks (m).
  std::array<std::uint64_t, kNumHeldBy> links{};  ///< Links times ticks that are off.
  std::uint64_t allLinks = 0;                     ///< Links times ticks.
  void add(const ExplainTally& other);
};

/// Follows all of `tracked` once more, with a clock for its phases.
[[nodiscard]] Result<ExplainTally> explain(const SolidStage& stage, const SolidActor& actor,
                                           const std::vector<Pose>& tracked, double rateHz,
                                           const SolidOptions& options);

/// The two tables, for all scenes that were added.
class ExplainTables {
 public:
  ExplainTables();
  void add(const std::string& scene, double rateHz, const ExplainTally& tally);
  void appendTo(BenchReport& report) const;

 private:
  BenchTable tail_, held_;
};

}  // namespace foretouch::tools
