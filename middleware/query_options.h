// middleware/query_options.h: what a query can be asked for, and how.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "articulated/skeleton.h"
#include "middleware/fidelity.h"
#include "middleware/scene/triangle_id.h"
#include "middleware/surface/avatar_surface.h"
#include "middleware/surface/skinned_surface.h"

namespace foretouch {

/// Both answer alike, byte for byte; the point-query one is the slower reference.
enum class Culler : std::uint8_t {
  FlatBvh,     ///< Embree's builder (rtcBuildBVH), flattened; our traversal.
  PointQuery,  ///< An RTCScene and rtcPointQuery.
};

/// How first contacts are looked for. Both keep the promise; they may report contact at different
/// instants within it.
enum class Backtracking : std::uint8_t {
  Lanes,   ///< Many pairs at once in the processor's vectors (lss/simd.h), in doubles where these
           ///< cannot decide. Skins take the scalar way all the same.
  Scalar,  ///< Pair by pair in doubles: the slower reference.
};

/// "lanes", "scalar".
[[nodiscard]] const char* toString(Backtracking backtracking);

/// How much is asked of a step.
enum class Scope : std::uint8_t {
  EveryLink,      ///< Every link's own first contact.
  FirstOfAvatar,  ///< The links that touch first of all. Once something touches, nothing is said of
                  ///< the others but that they are free until then: they are Undecided, AfterFirst,
                  ///< those that touch nothing in the whole step among them.
};

/// "links", "avatar".
[[nodiscard]] const char* toString(Scope scope);

/// A link, or a link and one object, whose contacts are not asked for.
/// Above link fidelity an object is passed over only where all links that a volume stands for
/// ignore it (those that are ignored altogether not counted); a link that alone does gets the
/// volume's verdict.
struct IgnoredPair {
  LinkId link = 0;
  ObjectId object = kEveryObject;
  static constexpr ObjectId kEveryObject = -1;
};

/// How a pair of triangles is carried through time. Both keep the promise; they may report contact
/// at different instants within it.
enum class LeafMethod : std::uint8_t {
  Advancement,  ///< Conservative advancement, as of LSS. The faster one.
  Cubics,       ///< Pieces of the motion as nlerp bodies, by their contact functions ([Canny86]).
};

/// "advancement", "cubics".
[[nodiscard]] const char* toString(LeafMethod method);

/// Whether a query at link or exact fidelity asks first whether anything is within reach of the
/// avatar as a whole, however it moves, and ends where nothing is. The same answers.
enum class Descent : std::uint8_t {
  Straight,
  ByNeed,
};

/// "straight", "by-need".
[[nodiscard]] const char* toString(Descent descent);

/// What one link is asked with, where links differ. Its verdict keeps the promise for this
/// tolerance and the surface of this fidelity, whatever the others' are.
struct LinkPolicy {
  double tolerance = 1e-3;             ///< Metres; kMinTolerance to kMaxTolerance.
  Fidelity fidelity = Fidelity::Link;  ///< Link or Exact.
};

struct QueryOptions {
  double tolerance = 1e-3;  ///< eps in metres; kMinTolerance to kMaxTolerance.
  Culler culler = Culler::FlatBvh;
  Fidelity fidelity = Fidelity::Link;
  /// Of the same avatar; needed for Fidelity::Exact, of all links or of one.
  std::optional<AvatarSurface> surface;
  std::optional<SkinnedSurface> skin;  ///< Of the same avatar; needed for Fidelity::Skinned.
  LeafMethod leafMethod = LeafMethod::Advancement;
  Backtracking backtracking = Backtracking::Lanes;
  Scope scope = Scope::EveryLink;
  Descent descent = Descent::Straight;
  std::vector<IgnoredPair> ignored;
  /// One a link, in order: in place of `tolerance` and `fidelity`, which must be Link or Exact
  /// beside them and decide nothing then. Empty: all links alike. Links that are all alike are
  /// answered as without policies, bit for bit.
  std::vector<LinkPolicy> linkPolicies;
  /// Work that the step may cost, all links together, in evaluations of a pair in lanes (about 10
  /// ns; other work is counted in their stead, middleware/query/work_meter.h). What is not answered
  /// by then is Undecided, free as far as is proven; more work never proves less. Counted, not
  /// timed: the same query gives the same answer.
  std::uint64_t workBudget = std::numeric_limits<std::uint64_t>::max();
  /// The same by the clock, from the query's beginning (us): looked at between pieces of work of a
  /// few microseconds. Which links are answered in time depends on the machine and its load.
  double deadlineUs = std::numeric_limits<double>::infinity();
};

/// Below this (m) a tolerance is refused outright; above it, coordinates decide (UndecidedReason).
inline constexpr double kMinTolerance = 1e-9;
/// Above it (m) one is refused as well: boxes grown by more need not fit into floats.
inline constexpr double kMaxTolerance = kMaxCoordinate;

}  // namespace foretouch
