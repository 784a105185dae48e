// tools/report/view_touches.h: touches as a view document has them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/report/view_document.h"
#include "tools/settings/ground_rule.h"

namespace foretouch::tools {

/// Adds the touches of the document's avatar number `avatar`, each with its contacts among those of
/// that avatar, and keeps all of them in listed order.
void addTouches(const std::vector<Touch>& touches, std::size_t avatar, ViewDocument& document);

/// Notes how many touches of the ground the document leaves out, if these are ignored.
void noteGround(const TouchCounts& counts, const GroundRule& ground,
                std::vector<std::string>& notes);

/// The headline's numbers, for the table.
[[nodiscard]] std::vector<ViewRow> touchRows(const TouchCounts& counts, bool isOwnAsked);

}  // namespace foretouch::tools
