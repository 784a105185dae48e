// middleware/object_policies.h: settings for a link with an object, or for many of both, resolved
// to what a query takes: ignored pairs, and a tolerance and fidelity per link.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "articulated/result.h"
#include "middleware/query_options.h"

namespace foretouch {

/// What it leaves out stays as it was.
struct ObjectPolicy {
  std::vector<LinkId> links;         ///< None: every link.
  std::vector<ObjectId> objects;     ///< None: every object.
  std::optional<double> tolerance;   ///< Metres, kMinTolerance to kMaxTolerance.
  std::optional<Fidelity> fidelity;  ///< Link or Exact; only without objects.
  std::optional<bool> ignore;        ///< False: no longer ignored.
};

/// More than all pairs of a body of a hundred links and a scene of ten thousand objects.
inline constexpr std::size_t kMaxResolvedPairs = std::size_t{1} << 20;

/// Applies the policies in order, later ones over earlier ones and all of them over the options.
/// Fills the options' ignored pairs, in as few as possible. If any policy sets a tolerance or
/// fidelity:
///   - A link's tolerance is the least of its tolerances for the objects that it does not ignore,
///     so a contact with any of them is within that object's tolerance.
///   - The options' own tolerance becomes the largest of the links', and their fidelity Exact if
///     any link's is, else Link. Links that are ignored altogether do not count.
///   - The options get link policies only if links differ.
/// Errors: a tolerance or an ignored pair of the options out of range; and, with the policy's place
/// in the list as index: a link or an object that is not there, a
/// tolerance out of range, a fidelity other than Link and Exact or beside objects, a tolerance or
/// fidelity while the options' fidelity is neither Link nor Exact or while they have link policies,
/// more than kMaxResolvedPairs pairs. O(policies * links * objects).
[[nodiscard]] Result<Done> applyObjectPolicies(const std::vector<ObjectPolicy>& policies,
                                               std::int32_t numLinks, std::int32_t numObjects,
                                               QueryOptions& options);

}  // namespace foretouch
