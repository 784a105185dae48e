// tools/report/view_person.h: what the person of a replay surely touched and may have touched, as
// its page shows it.
#pragma once

#include <optional>

#include "tools/inputs/replay_inputs.h"
#include "tools/person/person_touches.h"
#include "tools/report/view_document.h"
#include "tools/world/world_person.h"

namespace foretouch::tools {

/// Adds the touches of the only avatar's person, up to the last pose that the document has; nothing
/// without an answer.
void addPerson(const ReplayInputs& inputs, const PersonRequest& request,
               const std::optional<PersonAnswer>& answer, ViewDocument& document);

/// The same for all persons of a world.
void addPersons(const LoadedWorld& world, const WorldPersons& persons, ViewDocument& document);

}  // namespace foretouch::tools
