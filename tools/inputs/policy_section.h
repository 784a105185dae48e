// tools/inputs/policy_section.h: the [[policy]] tables of a file that holds other things, too.
#pragma once

#include <vector>

#include "tools/settings/policy_rule.h"
#include "tools/settings/toml_section.h"

namespace foretouch::tools {

/// Reads none if there are none; errors go to `reading`.
void readPolicies(const TomlSection& root, TomlReading& reading, std::vector<PolicyRule>& rules);

}  // namespace foretouch::tools
