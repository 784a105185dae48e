// tools/inputs/policy_rules.h: [[policy]] tables: what links are asked with where they differ, and
// which objects are passed over. docs/formats.md, "Policies", has the keys.
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

/// A file of nothing but [[policy]] tables, at least one and at most kMaxPolicyRules. `file` is the
/// path that `text` came from. Errors name the line. Never throws.
[[nodiscard]] Result<std::vector<PolicyRule>> parsePolicyFile(std::string_view text,
                                                              const std::string& file);
[[nodiscard]] Result<std::vector<PolicyRule>> readPolicyFile(const std::string& path);
/// The rules of the request's own file, where it names one.
[[nodiscard]] Result<Done> readPolicies(WorldRequest& request);

/// Resolves the rules for one avatar and scene, in order, so that later ones win: fills the
/// options' ignored pairs and, where rules speak of tolerance or fidelity, their link policies. A
/// link's tolerance is the least of those with the objects that it does not ignore: contact with
/// any of them is then within that object's. Links that turn out alike get no policies; otherwise
/// the options' own tolerance becomes the largest of them, and their fidelity exact if any link's
/// is: what holds of all links. Errors name the rule's file and line: names that match nothing
/// (with the nearest), tolerances or fidelities beside a fidelity that is not the links', too many
/// pairs.
[[nodiscard]] Result<Done> applyPolicies(const std::vector<PolicyRule>& rules,
                                         const Skeleton& skeleton,
                                         const std::vector<std::string>& objectNames,
                                         QueryOptions& options);

}  // namespace foretouch::tools
