#include "bindings/c/query_options.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "lss/index.h"
#include "middleware/query_options.h"

namespace foretouch::c {
namespace {

/// More than all pairs of a body of a hundred links and a scene of a thousand objects.
constexpr std::size_t kMaxIgnoredPairs = std::size_t{1} << 20;
constexpr std::size_t kMaxObjectPolicies = std::size_t{1} << 12;

/// The fidelities that the numbers from 1 on stood for.
constexpr std::array<const char*, 3> kGoneFidelities{"limb", "avatar", "ellipsoid"};

ft_status readFidelity(std::int32_t given, std::int64_t link, Fidelity& fidelity) {
  switch (given) {
    case FT_FIDELITY_LINK: fidelity = Fidelity::Link; return FT_OK;
    case FT_FIDELITY_EXACT: fidelity = Fidelity::Exact; return FT_OK;
    default: break;
  }
  if (given >= 1 && given <= static_cast<std::int32_t>(kGoneFidelities.size())) {
    const std::string why = whyFidelityIsGone(kGoneFidelities[static_cast<std::size_t>(given) - 1]);
    return failure(FT_ERROR_OUT_OF_RANGE, link, "fidelity: %s", why.c_str());
  }
  return failure(FT_ERROR_OUT_OF_RANGE, link, "fidelity: expected one of FT_FIDELITY_*, found %d",
                 given);
}

ft_status readScope(std::int32_t given, Scope& scope) {
  switch (given) {
    case FT_SCOPE_EVERY_LINK: scope = Scope::EveryLink; return FT_OK;
    case FT_SCOPE_FIRST_OF_AVATAR: scope = Scope::FirstOfAvatar; return FT_OK;
    case FT_SCOPE_EVERY_OBJECT: scope = Scope::EveryObject; return FT_OK;
    default: break;
  }
  return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "scope: expected one of FT_SCOPE_*, found %d",
                 given);
}

ft_status readPassSeparating(std::int32_t given, bool& passSeparating) {
  if (given != 0 && given != 1) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "pass_separating: expected 0 or 1, found %d",
                   given);
  }
  passSeparating = given == 1;
  return FT_OK;
}

ft_status readPolicies(const ft_query_options& given, QueryOptions& options) {
  constexpr auto kMost = countOf(kMaxJoints);
  const auto s = neededArray(given.policies, given.policy_count, kMost, "policies");
  if (s != FT_OK) return s;
  options.linkPolicies.resize(given.policy_count);
  for (std::size_t i = 0; i < given.policy_count; ++i) {
    const ft_link_policy& policy = given.policies[i];
    const auto link = static_cast<std::int64_t>(i);
    if (policy.reserved != 0) {
      return failure(FT_ERROR_STRUCT_SIZE, link, "policies: expected `reserved` 0, found %d",
                     policy.reserved);
    }
    const auto status = readFidelity(policy.fidelity, link, options.linkPolicies[i].fidelity);
    if (status != FT_OK) return status;
    options.linkPolicies[i].tolerance = policy.tolerance;
  }
  return FT_OK;
}

/// What a policy leaves out is FT_UNCHANGED; for a tolerance, 0.
ft_status readObjectPolicy(const ft_object_policy& given, std::int64_t place,
                           ObjectPolicy& policy) {
  if (given.link != FT_EVERY_LINK) policy.links = {given.link};
  if (given.object != FT_EVERY_OBJECT) policy.objects = {given.object};
  if (given.tolerance != 0.0) policy.tolerance = given.tolerance;
  if (given.fidelity != FT_UNCHANGED) {
    const auto s = readFidelity(given.fidelity, place, policy.fidelity.emplace());
    if (s != FT_OK) return s;
  }
  if (given.ignore == FT_UNCHANGED) return FT_OK;
  if (given.ignore != 0 && given.ignore != 1) {
    return failure(FT_ERROR_OUT_OF_RANGE, place,
                   "object_policies: expected `ignore` 0, 1 or FT_UNCHANGED, found %d",
                   given.ignore);
  }
  policy.ignore = given.ignore == 1;
  return FT_OK;
}

ft_status applyGiven(const ft_query_options& given, const AvatarParts& avatar, const Scene& scene,
                     QueryOptions& options) {
  const auto s = neededArray(given.object_policies, given.object_policy_count, kMaxObjectPolicies,
                             "object_policies");
  if (s != FT_OK) return s;
  std::vector<ObjectPolicy> policies(given.object_policy_count);
  for (std::size_t i = 0; i < policies.size(); ++i) {
    const auto status =
        readObjectPolicy(given.object_policies[i], static_cast<std::int64_t>(i), policies[i]);
    if (status != FT_OK) return status;
  }
  const auto applied =
      applyObjectPolicies(policies, avatar.avatar.numLinks(),
                          static_cast<std::int32_t>(scene.objectNames().size()), options);
  return applied.ok() ? FT_OK : failure(applied.error());
}

ft_status checkedSurface(const AvatarParts& avatar, const QueryOptions& options) {
  const auto isExact = [](const LinkPolicy& policy) { return policy.fidelity == Fidelity::Exact; };
  const bool needsSurface =
      options.fidelity == Fidelity::Exact ||
      std::any_of(options.linkPolicies.begin(), options.linkPolicies.end(), isExact);
  return needsSurface ? checkedTriangles(avatar) : ft_status{FT_OK};
}

}  // namespace

ft_status checkedTriangles(const AvatarParts& avatar) {
  if (avatar.surface) return FT_OK;
  return failure(FT_ERROR_MISMATCH, kNoIndex,
                 "fidelity: FT_FIDELITY_EXACT expects an avatar with triangles, given in "
                 "ft_avatar_arrays or read with its file");
}

ft_status readIgnored(const ft_ignored_pair* given, std::size_t count,
                      std::vector<IgnoredPair>& ignored) {
  if (const auto s = neededArray(given, count, kMaxIgnoredPairs, "ignored"); s != FT_OK) return s;
  ignored.reserve(count);
  for (std::size_t i = 0; i < count; ++i) ignored.push_back({given[i].link, given[i].object});
  return FT_OK;
}

ft_query_options defaultQueryOptions() {
  const QueryOptions defaults;
  ft_query_options options{};
  options.size = sizeof options;
  options.fidelity = FT_FIDELITY_LINK;
  options.tolerance = defaults.tolerance;
  options.work_budget = defaults.workBudget;
  options.deadline_us = defaults.deadlineUs;
  options.scope = FT_SCOPE_EVERY_LINK;
  return options;
}

ft_status readQueryOptions(const ft_query_options* given, const AvatarParts& avatar,
                           const Scene& scene, QueryOptions& options) {
  ft_query_options known = defaultQueryOptions();
  if (given != nullptr) {
    if (const auto s = readStruct(given, "ft_query_options", known); s != FT_OK) return s;
  }
  for (const std::int32_t reserved : {known.reserved, known.reserved_end}) {
    const auto s = zero(static_cast<std::uint32_t>(reserved), "reserved");
    if (s != FT_OK) return s;
  }
  if (const auto s = readScope(known.scope, options.scope); s != FT_OK) return s;
  if (const auto s = readPassSeparating(known.pass_separating, options.passSeparating);
      s != FT_OK) {
    return s;
  }
  if (const auto s = readFidelity(known.fidelity, kNoIndex, options.fidelity); s != FT_OK) return s;
  const auto ignored = readIgnored(known.ignored, known.ignored_count, options.ignored);
  if (ignored != FT_OK) return ignored;
  if (const auto s = readPolicies(known, options); s != FT_OK) return s;
  options.tolerance = known.tolerance;
  options.workBudget = known.work_budget;
  options.deadlineUs = known.deadline_us;
  options.surface = avatar.surface;
  if (const auto s = applyGiven(known, avatar, scene, options); s != FT_OK) return s;
  return checkedSurface(avatar, options);
}

}  // namespace foretouch::c

ft_status ft_query_options_init(ft_query_options* options, size_t size) {
  return foretouch::c::initStruct(__func__, options, size, "ft_query_options",
                                  foretouch::c::defaultQueryOptions());
}
