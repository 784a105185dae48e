// bindings/python/query_options.h: the keywords of a query as the library's options.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/python/arguments.h"
#include "middleware/query/query.h"

namespace foretouch::python {

/// 'link' or 'exact'.
[[nodiscard]] Fidelity fidelityFrom(py::handle given, const std::string& what);
[[nodiscard]] bool boolean(py::handle given, const std::string& what);
/// Links, and pairs of a link and an object, by name or index.
[[nodiscard]] std::vector<IgnoredPair> ignoredFrom(const py::object& given, const Avatar& avatar,
                                                   const Scene& scene);
/// None, or the surface of this avatar.
[[nodiscard]] std::optional<AvatarSurface> surfaceFrom(const py::object& given,
                                                       const Avatar& avatar);
/// None, or the rules of this avatar.
[[nodiscard]] std::optional<foretouch::PairRules> rulesFrom(const py::object& given,
                                                            const Avatar& avatar);

/// As given, unchecked.
struct GivenOptions {
  py::object tolerance, fidelity, policies, ignore, workBudget, deadlineUs, scope, surface,
      selfPairs, passSeparating;
};

/// Looks up the names of links and objects. The library itself checks the values.
[[nodiscard]] QueryOptions optionsFrom(const GivenOptions& given, const Avatar& avatar,
                                       const Scene& scene);

}  // namespace foretouch::python
