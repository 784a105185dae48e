// bench/person/pair_trial.h: brackets of two persons, both of whom hold poses back, judged: each
// has its own steps; the parts that overlap are asked.
#pragma once

#include "bench/person/person_trial.h"
#include "bench/solid/stage.h"

namespace foretouch::tools {

/// A person, and where the clip stands.
struct PersonOfPair {
  const SolidActor& actor;
  Placement place;
  PersonTrial trial;
};

/// Both clips begin at once. `stage` is not asked.
[[nodiscard]] PersonTally judgePersons(const SolidStage& stage, const PersonOfPair& one,
                                       const PersonOfPair& other);

}  // namespace foretouch::tools
