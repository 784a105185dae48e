#include <algorithm>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/query_options.h"

namespace foretouch {
namespace {

bool isOfLinks(Fidelity fidelity) {
  return fidelity == Fidelity::Link || fidelity == Fidelity::Exact;
}

bool areWithin(const std::vector<std::int32_t>& ids, std::int32_t count) {
  return std::all_of(ids.begin(), ids.end(),
                     [count](std::int32_t id) { return id >= 0 && id < count; });
}

Error refusal(std::int64_t place, ErrorCode code, std::string message) {
  return {code, "policies", -1, place, std::move(message)};
}

Result<Done> checked(const ObjectPolicy& policy, std::int64_t place, std::int32_t numLinks,
                     std::int32_t numObjects, const QueryOptions& options) {
  if (!areWithin(policy.links, numLinks) || !areWithin(policy.objects, numObjects)) {
    return refusal(place, ErrorCode::OutOfRange,
                   "expected links of the avatar and objects of the scene");
  }
  if (policy.tolerance &&
      !(*policy.tolerance >= kMinTolerance && *policy.tolerance <= kMaxTolerance)) {
    return refusal(place, ErrorCode::OutOfRange, "tolerance: expected 1e-9 to 1e7 metres");
  }
  if (policy.fidelity && !isOfLinks(*policy.fidelity)) {
    return refusal(place, ErrorCode::OutOfRange, "fidelity: expected link or exact");
  }
  if (policy.fidelity && !policy.objects.empty()) {
    return refusal(place, ErrorCode::Mismatch,
                   "fidelity: expected no objects beside it: a link has one surface for all of "
                   "them");
  }
  if (!policy.tolerance && !policy.fidelity) return Done{};
  if (!isOfLinks(options.fidelity)) {
    return refusal(place, ErrorCode::Mismatch,
                   std::string("expected neither tolerance nor fidelity beside the fidelity ") +
                       toString(options.fidelity) +
                       ": only at link and exact has each link a surface of its own");
  }
  if (!options.linkPolicies.empty()) {
    return refusal(place, ErrorCode::Mismatch,
                   "expected neither tolerance nor fidelity beside link policies");
  }
  return Done{};
}

/// What the policies begin with.
Result<Done> checkedBase(const QueryOptions& options, std::int32_t numLinks,
                         std::int32_t numObjects) {
  if (!(options.tolerance >= kMinTolerance && options.tolerance <= kMaxTolerance)) {
    return Error::in("tolerance", ErrorCode::OutOfRange, "expected 1e-9 to 1e7 metres");
  }
  for (const IgnoredPair& pair : options.ignored) {
    if (pair.link < 0 || pair.link >= numLinks || pair.object < IgnoredPair::kEveryObject ||
        pair.object >= numObjects) {
      return Error{ErrorCode::OutOfRange, "ignored", -1, pair.link,
                   "expected a link of the avatar and an object of the scene"};
    }
  }
  return Done{};
}

/// One link at a time.
class Resolver {
 public:
  Resolver(const std::vector<ObjectPolicy>& policies, std::int32_t numLinks,
           std::int32_t numObjects, const QueryOptions& base)
      : policies_(policies),
        base_(base),
        tolerances_(countOf(numObjects)),
        isIgnored_(countOf(numObjects)) {
    for (const ObjectPolicy& policy : policies) {
      auto& isOf = isOfLink_.emplace_back(countOf(numLinks), policy.links.empty() ? 1 : 0);
      for (const LinkId link : policy.links) isOf[slotOf(link)] = 1;
    }
  }

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
    for (std::size_t i = 0; i < policies_.size(); ++i) {
      if (isOfLink_[i][slotOf(link)] != 0) take(policies_[i]);
    }
  }

  [[nodiscard]] bool ignoresAll() const {
    return std::all_of(isIgnored_.begin(), isIgnored_.end(), [](auto is) { return is != 0; });
  }
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
  void take(const ObjectPolicy& policy) {
    if (policy.fidelity) fidelity_ = *policy.fidelity;
    if (policy.objects.empty()) {
      for (std::size_t i = 0; i < tolerances_.size(); ++i) takeFor(i, policy);
    }
    for (const ObjectId object : policy.objects) takeFor(slotOf(object), policy);
  }
  void takeFor(std::size_t object, const ObjectPolicy& policy) {
    if (policy.tolerance) tolerances_[object] = *policy.tolerance;
    if (policy.ignore) isIgnored_[object] = *policy.ignore ? 1 : 0;
  }

  const std::vector<ObjectPolicy>& policies_;
  const QueryOptions& base_;
  std::vector<std::vector<std::uint8_t>> isOfLink_;  // per policy
  // For the current link.
  std::vector<double> tolerances_;       // by object
  std::vector<std::uint8_t> isIgnored_;  // by object
  Fidelity fidelity_ = Fidelity::Link;
};

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

Result<Done> applyObjectPolicies(const std::vector<ObjectPolicy>& policies, std::int32_t numLinks,
                                 std::int32_t numObjects, QueryOptions& options) {
  if (policies.empty()) return Done{};
  FORETOUCH_CHECK(checkedBase(options, numLinks, numObjects));
  bool doLinksDiffer = false;
  for (std::size_t i = 0; i < policies.size(); ++i) {
    const auto place = static_cast<std::int64_t>(i);
    FORETOUCH_CHECK(checked(policies[i], place, numLinks, numObjects, options));
    doLinksDiffer = doLinksDiffer || policies[i].tolerance || policies[i].fidelity;
  }
  Resolver resolver(policies, numLinks, numObjects, options);
  std::vector<LinkPolicy> perLink;
  std::vector<IgnoredPair> ignored;
  std::vector<std::uint8_t> isAsked;
  for (LinkId link = 0; link < numLinks; ++link) {
    resolver.resolve(link);
    resolver.addIgnored(link, ignored);
    if (ignored.size() > kMaxResolvedPairs) {
      return refusal(-1, ErrorCode::LimitExceeded,
                     "ignore: expected at most " + std::to_string(kMaxResolvedPairs) +
                         " pairs of all policies together");
    }
    perLink.push_back(resolver.policy());
    isAsked.push_back(resolver.ignoresAll() ? 0 : 1);
  }
  options.ignored = std::move(ignored);
  if (doLinksDiffer) setPolicies(std::move(perLink), isAsked, options);
  return Done{};
}

}  // namespace foretouch
