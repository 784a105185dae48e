// bench/extremes/asking.h: runs one case through the product in every way: both backtrackings,
// every width of vectors, both cullers, each fidelity that the case has, denormals kept and
// flushed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/extremes/extreme_case.h"
#include "judge/hull_oracle.h"
#include "middleware/query/query.h"

namespace foretouch::tools::extremes {

struct Answer {
  std::string way;  ///< "lanes avx2, flat, link, flushed"
  Fidelity fidelity = Fidelity::Link;
  bool isFlushed = false;
  Scope scope = Scope::EveryLink;
  StepContacts step;
};

/// The results of one case.
struct Asked {
  std::optional<Error> refusal;  ///< The first, if any; then there are no answers.
  bool isRefusedAlike = true;    ///< With denormals kept and flushed.
  std::vector<Answer> answers;
  /// The oracle's input, as the product holds it: validated poses, and the sign of each joint's dot
  /// product as doubles compute it. By isFlushed; the hulls are link fidelity's.
  oracle::HullWorld world[2];
};

/// Asks with denormals kept, and flushed if the processor can. Leaves the widest vectors in use;
/// for one thread at a time, because the width is the process's.
[[nodiscard]] Asked ask(const ExtremeCase& extreme);

/// The hulls of the case's surface at that fidelity.
[[nodiscard]] std::vector<oracle::Hull> hullsOf(const ExtremeCase& extreme, Fidelity fidelity);

/// Evaluations of every kind that the step took.
[[nodiscard]] std::uint64_t workOf(const QueryCounters& counters);

}  // namespace foretouch::tools::extremes
