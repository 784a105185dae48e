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

/// A file of nothing but [[policy]] tables, at least one and at most kMaxPolicyRules. `file`: the
/// path of `text`. Errors name the line. Never throws.
[[nodiscard]] Result<std::vector<PolicyRule>> parsePolicyFile(std::string_view text,
                                                              const std::string& file);
[[nodiscard]] Result<std::vector<PolicyRule>> readPolicyFile(const std::string& path);
/// Reads the rules of the request's policy file, if it names one.
[[nodiscard]] Result<Done> readPolicies(WorldRequest& request);

/// Resolves the rules for one avatar and scene, in order: later ones win. Fills the options'
/// ignored pairs. If any rule sets a tolerance or fidelity:
///   - A link's tolerance is the least of its tolerances for the objects that it does not ignore,
///     so a contact with any of them is within that object's tolerance.
///   - The options' own tolerance becomes the largest of the links', and their fidelity Exact if
///     any link's is, else Link. Links that are ignored altogether do not count.
///   - The options get link policies only if links differ.
/// Errors name the rule's file and line: names that match nothing (with the nearest), a tolerance
/// or fidelity while the options' fidelity is neither Link nor Exact, too many pairs.
[[nodiscard]] Result<Done> applyPolicies(const std::vector<PolicyRule>& rules,
                                         const Skeleton& skeleton,
                                         const std::vector<std::string>& objectNames,
                                         QueryOptions& options);

}  // namespace foretouch::tools
