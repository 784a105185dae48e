// bench/person/person_trial.h: brackets judged: a person whose poses are held back, asked about
// with bounds that are learned from the same clip, or given. What was missed, what was a lie, what
// stays undecided, how wide the brackets are, and what they cost beside a plain step.
#pragma once

#include "bench/person/bounded_person.h"
#include "bench/person/person_tally.h"
#include "bench/solid/stage.h"
#include "middleware/bracket/bracket.h"

namespace foretouch::tools {

[[nodiscard]] PersonTally judgePerson(const SolidStage& stage, const SolidActor& actor,
                                      const Placement& place, const PersonTrial& trial);

}  // namespace foretouch::tools
