// tools/settings/policy_rule.h: one [[policy]] table: tolerance and fidelity per link, and objects
// to ignore.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "middleware/query_options.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxPolicyRules = 256;

/// One table. Missing keys change nothing.
struct PolicyRule {
  std::string file;                  ///< Its file, for errors.
  std::int64_t line = -1;            ///< 1-based.
  std::vector<std::string> links;    ///< Patterns (tools/inputs/name_pattern.h); none: every link.
  std::vector<std::string> objects;  ///< The same for the scene's objects; none: every object.
  std::optional<double> tolerance;   ///< Metres, kMinTolerance to kMaxTolerance.
  std::optional<Fidelity> fidelity;  ///< Link or Exact; only without objects.
  std::optional<bool> ignore;        ///< False: no longer ignored.
};

/// The rules as a list, each as given.
[[nodiscard]] std::string policiesJson(const std::vector<PolicyRule>& rules);

}  // namespace foretouch::tools
