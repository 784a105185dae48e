// tools/settings/policy_rule.h: one [[policy]] table: what links are asked with where they differ,
// and which objects are passed over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "middleware/fidelity.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxPolicyRules = 256;

/// One table. What it leaves out stays as it was.
struct PolicyRule {
  std::string file;                  ///< Where it stands, for errors.
  std::int64_t line = -1;            ///< 1-based.
  std::vector<std::string> links;    ///< Patterns (tools/inputs/name_pattern.h); none: every link.
  std::vector<std::string> objects;  ///< The same of the scene's objects; none: every object.
  std::optional<double> tolerance;   ///< Metres, kMinTolerance to kMaxTolerance.
  std::optional<Fidelity> fidelity;  ///< Link or Exact; only where no objects are named.
  std::optional<bool> ignore;        ///< False: asked for again.
};

/// A list of the rules, each as it was given.
[[nodiscard]] std::string policiesJson(const std::vector<PolicyRule>& rules);

}  // namespace foretouch::tools
