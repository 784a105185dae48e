// bench/person/person_tally.h: what a judge found about brackets, counted.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace foretouch::tools {

/// A bracket of a begin, beside the least one that the same bounds allow: a person ahead of the
/// model by all of the bound touched at its begin; one who was behind it, at its end.
struct BracketWidth {
  double approach = 0.0;  ///< The model's, through the least bracket (m/s).
  double ms = 0.0, leastMs = 0.0;
  double growthMm = 0.0;  ///< At the least bracket's begin.
};

struct PersonTally {
  std::uint64_t intervals = 0;  ///< Links (or pairs) times steps, of what has a surface.
  std::uint64_t missed = 0, lied = 0;
  std::uint64_t excluded = 0, possible = 0, certain = 0, unclaimed = 0;
  std::uint64_t passed = 0;  ///< Certain ones, as they went through a surface.
  std::uint64_t fresh = 0;   ///< Those that touch in truth, and not at the earlier pose.
  std::uint64_t freshCertain = 0;
  std::uint64_t missedByPoses = 0;  ///< Fresh ones that no given pose shows.
  /// In the scene, if the constant rate is taken for what the person did, at a millimetre.
  std::uint64_t missedBetween = 0, inventedBetween = 0;
  std::vector<double> widthsMs;           ///< For certain fresh touches: from possible to certain.
  std::vector<BracketWidth> widths;       ///< For those of which the least is known.
  std::vector<double> growthsMm;          ///< Largest, per interval.
  double bracketUs = 0.0, plainUs = 0.0;  ///< Of all steps, bracketed and plain.
  std::uint64_t pieces = 0, steps = 0;
  std::vector<std::string> findings;  ///< The first ten.

  void add(const PersonTally& other);
};

}  // namespace foretouch::tools
