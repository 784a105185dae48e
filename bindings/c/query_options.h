// bindings/c/query_options.h: a query's options, from C.
#pragma once

#include <cstddef>
#include <vector>

#include "bindings/c/handles.h"
#include "bindings/c/sized_struct.h"

namespace foretouch::c {

[[nodiscard]] ft_query_options defaultQueryOptions();

/// Checks everything that needs no query; NULL: the defaults.
[[nodiscard]] ft_status readQueryOptions(const ft_query_options* given, const AvatarParts& avatar,
                                         const Scene& scene, QueryOptions& options);

/// Refuses an avatar without triangles at FT_FIDELITY_EXACT.
[[nodiscard]] ft_status checkedTriangles(const AvatarParts& avatar);

/// Checks only their number.
[[nodiscard]] ft_status readIgnored(const ft_ignored_pair* given, std::size_t count,
                                    std::vector<IgnoredPair>& ignored);

}  // namespace foretouch::c
