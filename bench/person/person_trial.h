// bench/person/person_trial.h: brackets judged: a person whose poses are held back, asked about
// with bounds that are learned from the same clip, or given. What was missed, what was a lie, what
// stays undecided, how wide the brackets are, and what they cost beside a plain step.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/solid/stage.h"
#include "middleware/bracket/bracket_query.h"

namespace foretouch::tools {

struct PersonTrial {
  double rateHz = 30.0;  ///< Of the given poses: every n-th frame, the nearest n >= 1.
  MotionModel model = MotionModel::CubicLate;
  bool isFollowed = true;  ///< Bounds follow how the poses bend, too.
  bool asksOwnLinks = false;
  double boundShare = 1.0;             ///< Of the bounds that hold: below 1 for planted faults.
  int instants = 4;                    ///< That are looked at per frame of the clip.
  std::vector<LinkBound> bounds = {};  ///< One per link; empty: those that hold on the clip.
};

struct PersonTally {
  std::uint64_t intervals = 0;  ///< Links (or pairs) times steps, of what has a surface.
  std::uint64_t missed = 0, lied = 0;
  std::uint64_t excluded = 0, possible = 0, certain = 0, unclaimed = 0;
  std::uint64_t fresh = 0;  ///< That touch in truth, and not at the earlier pose.
  std::uint64_t freshCertain = 0;
  std::uint64_t missedByPoses = 0;        ///< Fresh ones that no given pose shows.
  std::vector<double> widthsMs;           ///< Of certain fresh touches: from possible to certain.
  std::vector<double> growthsMm;          ///< Largest, per interval.
  double bracketUs = 0.0, plainUs = 0.0;  ///< Of all steps, bracketed and plain.
  std::uint64_t pieces = 0, steps = 0;
  std::vector<std::string> findings;  ///< The first ten.

  void add(const PersonTally& other);
};

[[nodiscard]] PersonTally judgePerson(const SolidStage& stage, const SolidActor& actor,
                                      const Placement& place, const PersonTrial& trial);

}  // namespace foretouch::tools
