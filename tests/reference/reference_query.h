// tests/reference/reference_query.h: the door of the reference room: the same questions,
// answered in other ways. For tests, which hold one way against another, and for benchmarks; no
// program of the product links this library, and none of its answers needs it.
#pragma once

#include <cstdint>
#include <optional>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "middleware/contact.h"
#include "middleware/query/query.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"
#include "tests/reference/rungs.h"

namespace foretouch {

/// Both give the same answer, byte for byte.
enum class Culler : std::uint8_t {
  FlatBvh,     ///< The scene's own tree; our traversal.
  PointQuery,  ///< An RTCScene and rtcPointQuery, or every triangle: slower.
};

/// "flat", "point-query".
[[nodiscard]] const char* toString(Culler culler);

/// How the query finds first contacts. Both keep the promise; they may report contact at different
/// instants within it.
enum class Backtracking : std::uint8_t {
  Lanes,   ///< Many pairs at once in the processor's vectors (lss/simd.h), in doubles where lanes
           ///< cannot decide, and at exact fidelity where the processor has a single one.
  Scalar,  ///< Pair by pair in doubles: slower.
};

/// "lanes", "scalar".
[[nodiscard]] const char* toString(Backtracking backtracking);

/// How a query at exact fidelity follows a pair of triangles through time. Both keep the promise;
/// they may report contact at different instants within it.
enum class LeafMethod : std::uint8_t {
  Advancement,  ///< Conservative advancement, as for LSS. The faster one.
  Cubics,       ///< Pieces of the motion as nlerp bodies, by their contact functions ([Canny86]).
};

/// "advancement", "cubics".
[[nodiscard]] const char* toString(LeafMethod method);

/// Whether a query at link or exact fidelity first tests whether anything is within reach of the
/// whole avatar, however it moves, and stops if nothing is. The same answers.
enum class Descent : std::uint8_t {
  Straight,
  ByNeed,
};

/// "straight", "by-need".
[[nodiscard]] const char* toString(Descent descent);

/// The defaults are what the product does.
struct ReferenceOptions {
  Culler culler = Culler::FlatBvh;  ///< touchesAt() and Descent::ByNeed ask the flat tree anyway.
  /// None: lanes, except for more LSS than a walk takes, and for skins where there are no vectors.
  std::optional<Backtracking> backtracking;
  LeafMethod leafMethod = LeafMethod::Advancement;
  Descent descent = Descent::Straight;
  /// Volumes around several links in place of the links' own LSS. A volume ignores an object only
  /// if all links that it covers do (not counting links that are ignored altogether). A link
  /// without LSS has no surface. touchesAt() asks the links all the same.
  std::optional<Rung> rung;
};

/// As Query::build(), answered in the ways of `reference`. Further errors: a way that the query
/// does not have (cubics without exact fidelity; by need of skins or of rungs; lanes of skins or of
/// too many LSS; either backtracking of an ellipsoid; rungs at another fidelity than link, or with
/// what asks link by link).
[[nodiscard]] Result<Query> buildReference(const Avatar& avatar, const Scene& scene,
                                           const QueryOptions& options,
                                           const ReferenceOptions& reference);

/// Builds such a query and asks it once. Errors: as there, and as firstContacts().
[[nodiscard]] Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                                 const Scene& scene, const QueryOptions& options,
                                                 const ReferenceOptions& reference);

}  // namespace foretouch
