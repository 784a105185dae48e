// tools/inputs/policy_resolution.cpp: rules of policy_rules.h, resolved for an avatar and a scene.
#include <algorithm>
#include <utility>

#include "articulated/try.h"
#include "assets/near_names.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "middleware/query_options.h"
#include "tools/inputs/ignored_pairs.h"
#include "tools/inputs/name_pattern.h"
#include "tools/inputs/policy_rules.h"

namespace foretouch::tools {
namespace {

Error refusal(const PolicyRule& rule, ErrorCode code, const std::string& message) {
  return {code, rule.file, rule.line, -1, "[[policy]] " + message};
}

/// All indices that the patterns match, ascending; none if there are no patterns.
Result<std::vector<std::int32_t>> found(const PolicyRule& rule, const char* key, const char* what,
                                        const std::vector<std::string>& patterns,
                                        const std::vector<std::string>& names) {
  std::vector<std::uint8_t> isFound(names.size(), 0);
  for (const std::string& pattern : patterns) {
    const auto numbers = matching(pattern, names);
    if (numbers.empty()) {
      return refusal(rule, ErrorCode::UnknownName,
                     std::string(key) + ": " + inQuotes(pattern) + " is no " + what +
                         didYouMean(pattern, names));
    }
    for (const std::int32_t number : numbers) isFound[slotOf(number)] = 1;
  }
  std::vector<std::int32_t> all;
  for (std::size_t i = 0; i < isFound.size(); ++i) {
    if (isFound[i] != 0) all.push_back(static_cast<std::int32_t>(i));
  }
  return all;
}

/// The same with their names found.
Result<std::vector<ObjectPolicy>> foundRules(const std::vector<PolicyRule>& rules,
                                             const Skeleton& skeleton,
                                             const std::vector<std::string>& objectNames) {
  std::vector<std::string> linkNames;
  for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
    linkNames.push_back(skeleton.name(link));
  }
  std::vector<ObjectPolicy> result;
  for (const PolicyRule& rule : rules) {
    FORETOUCH_TRY(auto links, found(rule, "links", "link of the avatar", rule.links, linkNames));
    FORETOUCH_TRY(auto objects,
                  found(rule, "objects", "object of the scene", rule.objects, objectNames));
    result.push_back(
        {std::move(links), std::move(objects), rule.tolerance, rule.fidelity, rule.ignore});
  }
  return result;
}

}  // namespace

Result<Done> applyPolicies(const std::vector<PolicyRule>& rules, const Skeleton& skeleton,
                           const std::vector<std::string>& objectNames, QueryOptions& options) {
  if (rules.empty()) return Done{};
  const auto differing = std::find_if(rules.begin(), rules.end(), [](const PolicyRule& rule) {
    return rule.tolerance || rule.fidelity;
  });
  if (differing != rules.end() && options.fidelity != Fidelity::Link &&
      options.fidelity != Fidelity::Exact) {
    return refusal(*differing, ErrorCode::Mismatch,
                   std::string("expected neither tolerance nor fidelity beside the fidelity ") +
                       toString(options.fidelity) +
                       ": only at link and exact has each link a surface of its own");
  }
  FORETOUCH_TRY(const auto found, foundRules(rules, skeleton, objectNames));
  const auto applied = applyObjectPolicies(found, skeleton.numJoints(),
                                           static_cast<std::int32_t>(objectNames.size()), options);
  if (!applied.ok() && applied.error().code != ErrorCode::LimitExceeded) return applied.error();
  if (!applied.ok() || options.ignored.size() > kMaxIgnoredPairs) {
    return refusal(rules.back(), ErrorCode::LimitExceeded,
                   "ignore: all rules together stand for more than " +
                       std::to_string(kMaxIgnoredPairs) + " pairs; expected fewer");
  }
  return Done{};
}

}  // namespace foretouch::tools
