// tools/glb/contact_extras.h: the data of a contact in a GLB.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "middleware/scene/scene.h"
#include "tools/reported_contact.h"

namespace foretouch::tools {

/// "LeftHand at table, 1.003 s". Preconditions of both: touching (the contact has a triangle).
[[nodiscard]] std::string contactTitle(const ReportedContact& shown, const Skeleton& skeleton,
                                       const Scene& scene);

/// The fields of a results file (docs/formats.md, "Results"), `step` and `missed_by_poses`.
[[nodiscard]] nlohmann::json contactExtras(const ReportedContact& shown, const Skeleton& skeleton,
                                           const Scene& scene);

}  // namespace foretouch::tools
