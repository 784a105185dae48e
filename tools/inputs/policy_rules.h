// tools/inputs/policy_rules.h: [[policy]] tables: tolerance and fidelity per link, and objects to
// ignore. docs/formats.md, "Policies", has the keys.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/query_options.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

/// The [[policy]] tables of a file, at least one and at most kMaxPolicyRules; the only other tables
/// of the file are those of a project. `file`: the path of `text`. Errors name the line. Never
/// throws.
[[nodiscard]] Result<std::vector<PolicyRule>> parsePolicyFile(std::string_view text,
                                                              const std::string& file);
[[nodiscard]] Result<std::vector<PolicyRule>> readPolicyFile(const std::string& path);
/// Reads the rules of the request's policy file, if it names one.
[[nodiscard]] Result<Done> readPolicies(WorldRequest& request);

/// Finds the rules' names in one avatar and scene and applies them in order: applyObjectPolicies()
/// (middleware/query_options.h). Errors name the rule's file and line: names that match nothing
/// (with the nearest), a tolerance or fidelity while the options' fidelity is neither Link nor
/// Exact, too many pairs.
[[nodiscard]] Result<Done> applyPolicies(const std::vector<PolicyRule>& rules,
                                         const Skeleton& skeleton,
                                         const std::vector<std::string>& objectNames,
                                         QueryOptions& options);

}  // namespace foretouch::tools
