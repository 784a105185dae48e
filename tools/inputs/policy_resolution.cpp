// tools/inputs/policy_resolution.cpp: rules of policy_rules.h, resolved for an avatar and a scene.
#include <algorithm>
#include <limits>
#include <utility>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "tools/inputs/ignored_pairs.h"
#include "tools/inputs/name_pattern.h"
#include "tools/inputs/policy_rules.h"
#include "tools/settings/near_names.h"

namespace foretouch::tools {
namespace {

Error refusal(const PolicyRule& rule, ErrorCode code, const std::string& message) {
  return {code, rule.file, rule.line, -1, "[[policy]] " + message};
}

/// A rule with its names found.
struct FoundRule {
  const PolicyRule* rule;
  std::vector<std::uint8_t> isOfLink;
  std::vector<std::int32_t> objects;  // ascending
};

/// All indices that the patterns match, ascending; every index if there are no patterns.
Result<std::vector<std::int32_t>> found(const PolicyRule& rule, const char* key, const char* what,
                                        const std::vector<std::string>& patterns,
                                        const std::vector<std::string>& names) {
  if (patterns.empty()) return matching("*", names);
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

/// One link at a time.
class PolicyResolver {
 public:
  PolicyResolver(const std::vector<FoundRule>& rules, std::size_t numObjects,
                 const QueryOptions& base)
      : rules_(rules), base_(base), tolerances_(numObjects), isIgnored_(numObjects) {}

  void resolve(LinkId link) {
    std::fill(tolerances_.begin(), tolerances_.end(), base_.tolerance);
    std::fill(isIgnored_.begin(), isIgnored_.end(), 0);
    fidelity_ = base_.fidelity;
    for (const IgnoredPair& pair : base_.ignored) {
      if (pair.link != link) continue;
      if (pair.object == IgnoredPair::kEveryObject) {
        std::fill(isIgnored_.begin(), isIgnored_.end(), 1);
      } else {
        isIgnored_[slotOf(pair.object)] = 1;
      }
    }
    for (const FoundRule& found : rules_) {
      if (found.isOfLink[slotOf(link)] != 0) take(found);
    }
  }

  [[nodiscard]] bool ignoresAll() const {
    return std::all_of(isIgnored_.begin(), isIgnored_.end(), [](auto is) { return is != 0; });
  }
  /// The objects that the link ignores, in as few pairs as possible.
  void addIgnored(LinkId link, std::vector<IgnoredPair>& pairs) const {
    if (ignoresAll()) return pairs.push_back({link, IgnoredPair::kEveryObject});
    for (std::size_t i = 0; i < isIgnored_.size(); ++i) {
      if (isIgnored_[i] != 0) pairs.push_back({link, static_cast<ObjectId>(i)});
    }
  }
  /// For a link that ignores everything: the cheapest, which has no effect.
  [[nodiscard]] LinkPolicy policy() const {
    LinkPolicy policy{kMaxTolerance, Fidelity::Link};
    if (ignoresAll()) return policy;
    policy.fidelity = fidelity_;
    for (std::size_t i = 0; i < tolerances_.size(); ++i) {
      if (isIgnored_[i] == 0) policy.tolerance = std::min(policy.tolerance, tolerances_[i]);
    }
    return policy;
  }

 private:
  void take(const FoundRule& found) {
    if (found.rule->fidelity) fidelity_ = *found.rule->fidelity;
    for (const std::int32_t object : found.objects) {
      const auto i = slotOf(object);
      if (found.rule->tolerance) tolerances_[i] = *found.rule->tolerance;
      if (found.rule->ignore) isIgnored_[i] = *found.rule->ignore ? 1 : 0;
    }
  }

  const std::vector<FoundRule>& rules_;
  const QueryOptions& base_;
  // Of the current link.
  std::vector<double> tolerances_;       // by object
  std::vector<std::uint8_t> isIgnored_;  // by object
  Fidelity fidelity_ = Fidelity::Link;
};

Result<std::vector<FoundRule>> foundRules(const std::vector<PolicyRule>& rules,
                                          const Skeleton& skeleton,
                                          const std::vector<std::string>& objectNames) {
  std::vector<std::string> linkNames;
  for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
    linkNames.push_back(skeleton.name(link));
  }
  std::vector<FoundRule> result;
  for (const PolicyRule& rule : rules) {
    FORETOUCH_TRY(const auto links,
                  found(rule, "links", "link of the avatar", rule.links, linkNames));
    FORETOUCH_TRY(auto objects,
                  found(rule, "objects", "object of the scene", rule.objects, objectNames));
    FoundRule next{&rule, std::vector<std::uint8_t>(linkNames.size(), 0), std::move(objects)};
    for (const LinkId link : links) next.isOfLink[slotOf(link)] = 1;
    result.push_back(std::move(next));
  }
  return result;
}

/// The options' own tolerance and fidelity become bounds for all links.
void setPolicies(std::vector<LinkPolicy> policies, const std::vector<std::uint8_t>& isAsked,
                 QueryOptions& options) {
  double largest = 0.0;
  bool isAnyExact = false;
  for (std::size_t i = 0; i < policies.size(); ++i) {
    if (isAsked[i] == 0) continue;
    largest = std::max(largest, policies[i].tolerance);
    isAnyExact = isAnyExact || policies[i].fidelity == Fidelity::Exact;
  }
  if (largest == 0.0) return;  // every link is ignored
  for (std::size_t i = 0; i < policies.size(); ++i) {
    if (isAsked[i] == 0) policies[i].tolerance = largest;
  }
  options.tolerance = largest;
  options.fidelity = isAnyExact ? Fidelity::Exact : Fidelity::Link;
  const bool areAlike =
      std::all_of(policies.begin(), policies.end(), [&](const LinkPolicy& policy) {
        return policy.tolerance == options.tolerance && policy.fidelity == options.fidelity;
      });
  if (!areAlike) options.linkPolicies = std::move(policies);
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
  PolicyResolver resolver(found, objectNames.size(), options);
  std::vector<LinkPolicy> policies;
  std::vector<IgnoredPair> ignored;
  std::vector<std::uint8_t> isAsked;
  for (LinkId link = 0; link < skeleton.numJoints(); ++link) {
    resolver.resolve(link);
    resolver.addIgnored(link, ignored);
    if (ignored.size() > kMaxIgnoredPairs) {
      return refusal(rules.back(), ErrorCode::LimitExceeded,
                     "ignore: all rules together stand for more than " +
                         std::to_string(kMaxIgnoredPairs) + " pairs; expected fewer");
    }
    policies.push_back(resolver.policy());
    isAsked.push_back(resolver.ignoresAll() ? 0 : 1);
  }
  options.ignored = std::move(ignored);
  if (differing != rules.end()) setPolicies(std::move(policies), isAsked, options);
  return Done{};
}

}  // namespace foretouch::tools
