// bench/extremes/asking.h: one case put to the product in every way there is: both
// backtrackings, every width of vectors, both cullers, each fidelity that the case has, denormals
// kept and flushed.
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

/// What became of one case.
struct Asked {
  std::optional<Error> refusal;  ///< The first, where there was one; then there are no answers.
  bool isRefusedAlike = true;    ///< By both ways with denormals.
  std::vector<Answer> answers;
  /// The truth's input, as the product holds it: validated poses, and the sign of each joint's dot
  /// product as doubles compute it. By isFlushed; the hulls are link fidelity's.
  oracle::HullWorld world[2];
};

/// Denormals kept, and flushed where the processor can. Leaves the widest vectors in use; not for
/// several threads at once, as the width is the process's.
[[nodiscard]] Asked ask(const ExtremeCase& extreme);

/// The hulls of the case's surface at that fidelity.
[[nodiscard]] std::vector<oracle::Hull> hullsOf(const ExtremeCase& extreme, Fidelity fidelity);

/// Evaluations of every kind that the step took.
[[nodiscard]] std::uint64_t workOf(const QueryCounters& counters);

}  // namespace foretouch::tools::extremes
