// tools/stream/stream_person.h: what is claimed of the persons of a stream, live or from its log.
#pragma once

#include <vector>

#include "articulated/result.h"
#include "network/stream/person_stream.h"
#include "network/stream/stream_solver.h"
#include "tools/settings/person_settings.h"

namespace foretouch::tools {

/// One for each solver, in order, with the surfaces, own links and ignored pairs of its query; none
/// if they are not asked. Errors name the file.
[[nodiscard]] Result<std::vector<PersonStream>> makePersons(
    const PersonRequest& request, const std::vector<StreamSolver>& solvers, const Scene& scene);

}  // namespace foretouch::tools
