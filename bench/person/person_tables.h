// bench/person/person_tables.h: what judges of persons found, as tables.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "articulated/motion_model.h"
#include "bench/person/ahead_trial.h"
#include "bench/person/person_tally.h"
#include "bench/report.h"

namespace foretouch::tools {

enum class Asked : std::uint8_t { Scene, OwnLinks, OtherPerson };
[[nodiscard]] const char* toString(Asked asked);

/// By the question, by falling rate (its negative, in Hz), and by model.
using PersonTallies = std::map<std::tuple<Asked, double, MotionModel>, PersonTally>;
/// By falling rate (its negative, in Hz); one tally per AheadWay.
using AheadTallies = std::map<double, std::vector<AheadTally>>;

/// `learned`: the quantile at which strangers' bounds hold; 0: bounds are those of the clips.
[[nodiscard]] BenchTable bracketTable(const PersonTallies& tallies, double learned);
/// Brackets of the scene's touches beside the least ones, by how fast the two come together.
[[nodiscard]] BenchTable widthTable(const PersonTallies& tallies);
[[nodiscard]] BenchTable aheadTable(const AheadTallies& tallies, double horizonS);

}  // namespace foretouch::tools
