// bench/extremes/judge.h: the answers to one case held against the oracle, and what came of
// many.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bench/extremes/asking.h"

namespace foretouch::tools::extremes {

/// What can be wrong with an answer, worst first.
enum class Fault : std::uint8_t {
  None,
  Late,        ///< Unsound: touched before the instant up to which freedom is claimed.
  Malformed,   ///< A number that is not finite or out of its range, or a refusal of legal input.
  Accepted,    ///< Input that must be refused was not.
  Overworked,  ///< More than kMostWork evaluations.
  Loose,       ///< Contact where the separation is more than the tolerance and its rounding.
  Needless,    ///< Undecided where doubles do resolve the tolerance.
  Open,        ///< The oracle could not prove freedom within its budget.
};
[[nodiscard]] const char* toString(Fault fault);
/// What makes a campaign fail: all but Open, which says nothing against the product.
[[nodiscard]] bool isFailure(Fault fault);

/// A step of one avatar may cost so many evaluations and no more.
inline constexpr std::uint64_t kMostWork = 100'000'000;

/// In units of 2^-52 of the extent (HullOracle::extent): how far proven bounds may lie apart at a
/// link of that depth, so that a start in contact may be so far from touching and a tolerance below
/// 4/3 of it need not be resolved. docs/extremes.md derives it.
[[nodiscard]] double roundingsAt(int depth);

struct Finding {
  Fault fault = Fault::None;
  std::string what;  ///< For people.
};

/// The worst of a measure, and where it was.
struct Worst {
  double value = -std::numeric_limits<double>::infinity();
  std::uint64_t seed = 0;
  void offer(double other, std::uint64_t at) {
    if (other > value) *this = {other, at};
  }
};

/// Of one family. Links of answers are counted, not answers.
struct Tally {
  std::int64_t cases = 0, refused = 0, queries = 0;
  std::int64_t contacts = 0, starts = 0, clear = 0, undecided = 0;
  std::int64_t faults[8] = {};  // by Fault
  Worst tightness;              ///< Separation at contact, over the tolerance.
  Worst excess;                 ///< The same beyond the tolerance, in roundings of the extent.
  Worst start;                  ///< Separation of a start in contact, in roundings of the extent.
  Worst startShare;             ///< The same over what roundingsAt() allows.
  Worst lateness;  ///< Minus the least separation before the answer, over the tolerance.
  Worst work;
  Worst unresolved;  ///< Tolerance of an undecided link, over the least that must be resolved.
};

/// Judges one case and adds it to `tally`; what is wrong with it, the worst first, at most a few.
[[nodiscard]] std::vector<Finding> judge(const ExtremeCase& extreme, Tally& tally);

}  // namespace foretouch::tools::extremes
