// bench/extremes/judge.h: compares the answers to one case with the oracle, and sums up many cases.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bench/extremes/asking.h"

namespace foretouch::tools::extremes {

/// Faults of an answer, worst first.
enum class Fault : std::uint8_t {
  None,
  Late,        ///< Unsound: a touch before the instant up to which it claims freedom.
  Malformed,   ///< A number that is not finite or out of its range, or a refusal of legal input.
  Accepted,    ///< Did not refuse illegal input.
  Overworked,  ///< More than kMostWork evaluations.
  Loose,       ///< Contact although the separation is more than the tolerance and its rounding.
  Needless,    ///< Undecided although doubles resolve the tolerance.
  Open,        ///< The oracle could not prove freedom within its budget.
};
[[nodiscard]] const char* toString(Fault fault);
/// Whether it fails a campaign: all but Open, which is not the product's fault.
[[nodiscard]] bool isFailure(Fault fault);

/// Most evaluations that a step of one avatar may cost.
inline constexpr std::uint64_t kMostWork = 100'000'000;

/// How far proven bounds may lie apart at a link of that depth, in units of 2^-52 of the extent
/// (HullOracle::extent). A start in contact may be this far from touching, and a query need not
/// resolve a tolerance below 4/3 of it. docs/extremes.md derives it.
[[nodiscard]] double roundingsAt(int depth);

struct Finding {
  Fault fault = Fault::None;
  std::string what;  ///< Readable text.
};

/// The worst of a measure, and where it was.
struct Worst {
  double value = -std::numeric_limits<double>::infinity();
  std::uint64_t seed = 0;
  void offer(double other, std::uint64_t at) {
    if (other > value) *this = {other, at};
  }
};

/// The tally of one family. Counts links of answers, not answers.
struct Tally {
  std::int64_t cases = 0, refused = 0, queries = 0;
  std::int64_t contacts = 0, starts = 0, clear = 0, undecided = 0;
  std::int64_t faults[8] = {};  // by Fault
  Worst tightness;              ///< Separation at contact, over the tolerance.
  Worst excess;                 ///< The same beyond the tolerance, in roundings of the extent.
  Worst start;                  ///< Separation of a start in contact, in roundings of the extent.
  Worst startShare;             ///< The same over the allowance of roundingsAt().
  Worst lateness;  ///< Minus the least separation before the answer, over the tolerance.
  Worst work;
  Worst unresolved;  ///< Tolerance of an undecided link, over the least that must be resolved.
};

/// Judges one case and adds it to `tally`; returns its faults, worst first, at most a few.
[[nodiscard]] std::vector<Finding> judge(const ExtremeCase& extreme, Tally& tally);

}  // namespace foretouch::tools::extremes
