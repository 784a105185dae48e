// tools/glb/contact_extras.h: what a GLB says of a contact besides showing it.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "tools/replay/results_writer.h"

namespace foretouch::tools {

/// Seconds from the clip's first frame.
[[nodiscard]] double timeOf(const LinkContact& contact, const StepAnswer& answer);

/// "LeftHand at table, 1.003 s". Preconditions of both: touching (the contact has a triangle).
[[nodiscard]] std::string contactTitle(const LinkContact& contact, double timeS,
                                       const Skeleton& skeleton, const Scene& scene);

/// The fields of a results file (docs/formats.md, "Results"), `step` and `missed_by_poses`.
[[nodiscard]] nlohmann::json contactExtras(const LinkContact& contact, std::int64_t step,
                                           double timeS, bool isMissedByPoses,
                                           const Skeleton& skeleton, const Scene& scene);

}  // namespace foretouch::tools
