// middleware/query.h: the question Foretouch answers: what does each link meet first between two
// poses? Lengths in metres in the world W; t is normalised, 0 at the earlier pose and 1 at the
// later. The promise, its proof and the constants in it: docs/guarantees.md.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "middleware/avatar_surface.h"
#include "middleware/exact/leaf.h"
#include "middleware/scene.h"
#include "middleware/skinned_surface.h"

namespace foretouch {

enum class Verdict : std::uint8_t {
  Clear,            ///< Proven: the link's surface never touches the scene on [0,1].
  Contact,          ///< Free on [0, toi); at toi the separation is in [0, tolerance].
  StartsInContact,  ///< Separation <= 0 at t = 0 (to within rounding); toi == 0.
  Undecided,        ///< Free on [0, freeUntil), nothing claimed after it; `reason` says why.
};

/// "clear", "contact", "starts_in_contact", "undecided".
[[nodiscard]] const char* toString(Verdict verdict);

enum class UndecidedReason : std::uint8_t {
  None,
  WorkBudget,  ///< QueryOptions::workBudget or deadlineUs was spent.
  Resolution,  ///< Doubles cannot resolve the tolerance at these coordinates.
  AfterFirst,  ///< Scope::FirstOfAvatar: another link's contact is earlier.
};

[[nodiscard]] const char* toString(UndecidedReason reason);

/// What one link meets first on one motion.
/// Sound: toi and freeUntil never exceed the true time of first contact, rounding included.
/// Tight: for Contact, the separation at toi is <= tolerance.
/// The witness points, normal and triangle are those of the pair with the lowest toi; equal toi:
/// the smaller separation, then the lexicographically smaller witness point and normal, then the
/// lowest triangle. (At exact fidelity, of the scene's triangles that a link touches at t = 0 the
/// one deepest in the link's LSS, and the lowest of the link's triangles.) So the answer does not
/// depend on threads, on the culler or on the triangles' order.
struct LinkContact {
  LinkId link = 0;
  Verdict verdict = Verdict::Clear;
  UndecidedReason reason = UndecidedReason::None;
  double toi = 1.0;        ///< Time of impact, rounded down; valid for Contact and StartsInContact.
  double freeUntil = 1.0;  ///< Equals toi for Contact and StartsInContact, 1 for Clear.
  double separation =
      0.0;  ///< At toi, of witness points to LSS surface, >= 0 (0 if StartsInContact).
  double penetration =
      0.0;  ///< How deep the axis's distance is inside the radius; 0 unless StartsInContact.
  TriangleId triangle = -1;
  std::int32_t lss = -1;  ///< Which of the link's LSS; 0 above link fidelity.
  Eigen::Vector3d p_WScene = Eigen::Vector3d::Zero();   ///< Witness point on the triangle.
  Eigen::Vector3d p_WLink = Eigen::Vector3d::Zero();    ///< Witness point on the LSS's surface.
  Eigen::Vector3d nhat_SL_W = Eigen::Vector3d::Zero();  ///< Unit normal from the scene to the link.
  /// At exact fidelity: which of the link's triangles, and which features of it and of the scene's
  /// triangle hold the witness points. -1 at link fidelity.
  std::int32_t linkTriangle = -1;
  FeatureKind linkFeature = FeatureKind::Face, sceneFeature = FeatureKind::Face;
};

/// What a link's surface is: the rungs of the ladder, coarsest first Ellipsoid, Avatar, Limb, Link,
/// Exact; Skinned is none of them. Above Link one volume stands for several links, which all get
/// its verdict (middleware/rungs.h): each contains what stands for them one rung below, at every t,
/// so what is clear at a rung is free of contact at those below, where nothing is touched before
/// the time that a higher one reports. A link without LSS has no surface there.
enum class Fidelity : std::uint8_t {
  Link,   ///< Its LSS.
  Exact,  ///< The triangles of its mesh, and LSS that bound none. A subset of Link's contacts, and
          ///< never earlier.
  Skinned,  ///< The triangles of a skin, whose vertices follow the blend of several links; of a
            ///< link without any, its LSS.
  Limb,     ///< One LSS for all links of a chain between branchings (a finger, an arm to the hand).
  Avatar,   ///< One LSS for all links; one for those below each root where there are several.
  Ellipsoid,  ///< An ellipsoid of revolution around that LSS, which moves on a straight line.
};

/// "link", "exact", "skinned", "limb", "avatar", "ellipsoid".
[[nodiscard]] const char* toString(Fidelity fidelity);

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
  /// ns; other work is counted in their stead, middleware/work_meter.h). What is not answered by
  /// then is Undecided, free as far as is proven; more work never proves less. Counted, not timed:
  /// the same query gives the same answer.
  std::uint64_t workBudget = std::numeric_limits<std::uint64_t>::max();
  /// The same by the clock, from the query's beginning (us): looked at between pieces of work of a
  /// few microseconds. Which links are answered in time depends on the machine and its load.
  double deadlineUs = std::numeric_limits<double>::infinity();
};

/// Below this (m) a tolerance is refused outright; above it, coordinates decide (UndecidedReason).
inline constexpr double kMinTolerance = 1e-9;
/// Above it (m) one is refused as well: boxes grown by more need not fit into floats.
inline constexpr double kMaxTolerance = kMaxCoordinate;

/// Work done, for measurements that no machine load changes.
struct QueryCounters {
  std::uint64_t nodes = 0;           ///< BVH nodes visited (FlatBvh) or callbacks (PointQuery).
  std::uint64_t leaves = 0;          ///< Leaves of the tree visited (Backtracking::Lanes).
  std::uint64_t candidates = 0;      ///< (LSS, triangle) pairs that passed the culling.
  std::uint64_t clusterSteps = 0;    ///< Evaluations in lanes of an LSS and a leaf's sphere.
  std::uint64_t laneSteps = 0;       ///< Evaluations in lanes of an LSS and a triangle.
  std::uint64_t partSteps = 0;       ///< At exact fidelity: evaluations in lanes of a link's parts.
  std::uint64_t advancements = 0;    ///< Scalar distance evaluations, all kinds together.
  std::uint64_t hierarchyTests = 0;  ///< At exact fidelity: of an LSS or a node below it.
  std::uint64_t planeTests = 0;      ///< At exact fidelity: of a part against its parent's plane.
  std::uint64_t cubicTests = 0;      ///< At exact fidelity by LeafMethod::Cubics: pieces of pairs.
  std::uint64_t leafTests = 0;       ///< At exact fidelity: of two triangles.
  std::uint64_t states = 0;          ///< Link states evaluated (forward kinematics).
  std::uint64_t rungTests = 0;       ///< Volumes asked that stand for several links.
  std::uint64_t settledAbove = 0;    ///< Links that such a volume settled, by Descent::ByNeed.
};

struct StepContacts {
  std::vector<LinkContact> links;  ///< One a link of the avatar, in order.
  QueryCounters counters;
};

/// Scratch memory that is kept between queries; one a thread.
class QueryScratch {
 public:
  QueryScratch();
  ~QueryScratch();
  QueryScratch(QueryScratch&&) noexcept;
  QueryScratch& operator=(QueryScratch&&) noexcept;
  struct Impl;
  [[nodiscard]] Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// The first contact of every link of `avatar` while it moves as `motion` says.
/// Errors are bad options (tolerance, a policy or an ignored pair out of range) or a motion of
/// another avatar. Geometry never produces one: see Verdict. The first form fills `step` and, once
/// scratch and step have grown to what the scene asks for, allocates nothing.
[[nodiscard]] Result<Done> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                         const Scene& scene, const QueryOptions& options,
                                         QueryScratch& scratch, StepContacts& step);
[[nodiscard]] Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                                 const Scene& scene, const QueryOptions& options,
                                                 QueryScratch& scratch);
[[nodiscard]] Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                                 const Scene& scene,
                                                 const QueryOptions& options = {});

/// The order in which links are reported: earliest first, an undecided one at its freeUntil; of
/// those at the same time the lowest link first.
[[nodiscard]] bool isReportedBefore(const LinkContact& x, const LinkContact& y);

/// What a discrete check sees: does the link's surface touch a triangle at this one instant?
/// Ignored pairs are passed over. Decided by the computed distance (no claim within rounding of
/// zero).
[[nodiscard]] bool touchesAt(const Avatar& avatar, const ChainMotion& motion, LinkId link, double t,
                             const Scene& scene, const QueryOptions& options,
                             QueryScratch& scratch);

}  // namespace foretouch
