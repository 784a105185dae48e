// bench/person/bracket_judge.h: one bracket of two sides, judged by how far they truly are apart.
#pragma once

#include <functional>
#include <string>

#include "bench/person/person_tally.h"
#include "middleware/bracket/bracket.h"

namespace foretouch::tools {

struct JudgedSides {
  std::string name;
  double seconds = 0.0;                         ///< The time that the bracket is about.
  int looks = 0;                                ///< Instants that are looked at, less one.
  std::function<double(int look)> apartAtLook;  ///< Their separation (m) at t = look / looks.
  std::function<double(double t)> apartAt;
  /// The model's separation, and how far the person may be elsewhere (m): for the least width that
  /// answer from the same bounds has. Both or none.
  std::function<double(double t)> modelApartAt = {}, growthAt = {};
};

/// Whether the two touched at an instant that is looked at.
bool judge(const LinkBracket& bracket, const JudgedSides& sides, PersonTally& tally);

}  // namespace foretouch::tools
