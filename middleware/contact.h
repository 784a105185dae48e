// middleware/contact.h: what a query answers for each link: its verdict and its first contact.
// Lengths in metres in the world W; t is normalised, 0 at the earlier pose and 1 at the later. The
// promise, its proof and its constants: docs/guarantees.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "middleware/exact/feature.h"
#include "middleware/scene/scene.h"

namespace foretouch {

/// Work done, for measurements that do not depend on the machine's load.
struct QueryCounters {
  std::uint64_t nodes = 0;         ///< Nodes of the tree visited.
  std::uint64_t leaves = 0;        ///< Leaves of the tree visited (in lanes).
  std::uint64_t candidates = 0;    ///< (LSS, triangle) pairs that passed the culling.
  std::uint64_t clusterSteps = 0;  ///< Evaluations in lanes of an LSS and a leaf's sphere.
  std::uint64_t laneSteps = 0;     ///< Evaluations in lanes of an LSS and a triangle.
  std::uint64_t partSteps = 0;  ///< At exact and skinned fidelity: evaluations of parts in lanes.
  std::uint64_t advancements = 0;    ///< Scalar distance evaluations, all kinds together.
  std::uint64_t hierarchyTests = 0;  ///< At exact fidelity: tests of an LSS or a node below it.
  std::uint64_t planeTests = 0;      ///< At exact fidelity: parts against their parent's plane.
  std::uint64_t cubicTests = 0;      ///< By the reference room's cubics: pieces of pairs.
  std::uint64_t leafTests = 0;       ///< At exact fidelity: tests of two triangles.
  std::uint64_t states = 0;          ///< Link states evaluated (forward kinematics).
  std::uint64_t rungTests = 0;       ///< By the reference room: tests of volumes of several links.
  std::uint64_t settledAbove = 0;    ///< Links that the reference room's reach settled.
};

/// Add a counter here and every benchmark reports it.
inline constexpr std::array<std::pair<const char*, std::uint64_t QueryCounters::*>, 14>
    kCounterFields{{{"nodes", &QueryCounters::nodes},
                    {"leaves", &QueryCounters::leaves},
                    {"candidates", &QueryCounters::candidates},
                    {"cluster_steps", &QueryCounters::clusterSteps},
                    {"lane_steps", &QueryCounters::laneSteps},
                    {"part_steps", &QueryCounters::partSteps},
                    {"advancements", &QueryCounters::advancements},
                    {"hierarchy_tests", &QueryCounters::hierarchyTests},
                    {"plane_tests", &QueryCounters::planeTests},
                    {"cubic_tests", &QueryCounters::cubicTests},
                    {"leaf_tests", &QueryCounters::leafTests},
                    {"states", &QueryCounters::states},
                    {"rung_tests", &QueryCounters::rungTests},
                    {"settled_above", &QueryCounters::settledAbove}}};
static_assert(sizeof(QueryCounters) == kCounterFields.size() * sizeof(std::uint64_t),
              "name the new counter above");

enum class Verdict : std::uint8_t {
  Clear,            ///< Proven: the link's surface never touches the scene on [0,1].
  Contact,          ///< Free on [0, toi); at toi the separation is in [0, tolerance].
  StartsInContact,  ///< Separation <= 0 at t = 0 (to within rounding); toi == 0.
  Undecided,        ///< Free on [0, freeUntil), nothing claimed after it; `reason` says why.
};

/// "clear", "contact", "starts_in_contact", "undecided".
[[nodiscard]] const char* toString(Verdict verdict);

/// Why a link is undecided. The numbers are those on the wire.
enum class UndecidedReason : std::uint8_t {
  None = 0,        ///< Decided; or no answer, because the query failed.
  WorkBudget = 1,  ///< QueryOptions::workBudget or deadlineUs, or a world's, was spent.
  Resolution = 2,  ///< Doubles cannot resolve the tolerance at these coordinates.
  AfterFirst = 3,  ///< Scope::FirstOfAvatar: another link's contact is earlier.
  // The next ones come only from streams of poses, never from queries (docs/streaming.md).
  Gap = 4,             ///< Poses were lost: the motion between the two is unknown.
  MissingJoint = 5,    ///< The link's joint, or one above it, is missing in one of the poses.
  InvalidJoint = 6,    ///< ... is marked as not valid.
  StaleJoint = 7,      ///< ... is valid but neither tracked nor inferred: an old value.
  UnmatchedJoint = 8,  ///< ... is not in the sender's skeleton.
};
inline constexpr std::uint8_t kNumUndecidedReasons = 9;

/// "none", "work-budget", "resolution", "after-first", "gap", "missing-joint", ...
[[nodiscard]] const char* toString(UndecidedReason reason);

/// The first contact of one link on one motion. Starts as Undecided, free until 0, which claims
/// nothing; only a finished proof writes Clear.
/// Sound: toi and freeUntil never exceed the true time of first contact, rounding included.
/// Tight: for Contact, the separation at toi is <= tolerance.
/// The witness points, normal and triangle are those of the pair with the lowest toi; at equal toi,
/// of the smaller separation, then the lexicographically smaller witness point and normal, then the
/// lowest triangle. (At exact fidelity and t = 0: of the scene's triangles that the link touches,
/// the one deepest in the link's LSS, with the lowest of the link's triangles.) So the answer does
/// not depend on threads or on the triangles' order.
struct LinkContact {
  LinkId link = 0;
  Verdict verdict = Verdict::Undecided;
  UndecidedReason reason = UndecidedReason::None;
  double toi = 0.0;          ///< Time of impact, rounded down; freeUntil if there is no contact.
  double freeUntil = 0.0;    ///< Equals toi for Contact and StartsInContact, 1 for Clear.
  double separation = 0.0;   ///< At toi, from the scene's witness point to the link's surface, >= 0
                             ///< (0 if StartsInContact).
  double penetration = 0.0;  ///< Radius minus the axis's distance; 0 unless StartsInContact.
  TriangleId triangle = -1;
  std::int32_t lss = -1;  ///< Index among the link's LSS; 0 above link fidelity.
  Eigen::Vector3d p_WScene = Eigen::Vector3d::Zero();  ///< Witness point on the triangle.
  Eigen::Vector3d p_WLink = Eigen::Vector3d::Zero();   ///< Witness point on the LSS's surface.
  /// Unit normal from the scene to the link; zero if they meet so that there is none (a point on a
  /// point, without radii).
  Eigen::Vector3d nhat_SL_W = Eigen::Vector3d::Zero();
  /// At exact fidelity: the link's triangle, and the features of it and of the scene's triangle
  /// that hold the witness points. -1 at link fidelity.
  std::int32_t linkTriangle = -1;
  FeatureKind linkFeature = FeatureKind::Face, sceneFeature = FeatureKind::Face;
};

/// The first contact of two of an avatar's own links, where QueryOptions::self asks for it. The
/// other link takes the place of the scene in what LinkContact says: `p_WScene` is on its surface,
/// the normal points from it to `link`, `triangle` is one of its mesh's (-1 at link fidelity).
struct PairContact : LinkContact {
  LinkId other = -1;           ///< Above `link`; -1: the scene.
  std::int32_t otherLss = -1;  ///< Index among the other link's LSS.
  /// Not below the depth (m), of which `penetration` is a lower bound then. A query does not give
  /// it for meshes: LinkDepths (middleware/depth/depth.h) does.
  double penetrationAtMost = std::numeric_limits<double>::infinity();
};

struct StepContacts {
  std::vector<LinkContact> links;  ///< One per link of the avatar, in order.
  /// With Scope::EveryObject: the first contact of every link with every object, in the order of
  /// isReportedBefore(); `links` has the earliest of each link. A link and an object that it does
  /// not list never touch; if it lists the link as undecided, that holds until its freeUntil.
  std::vector<LinkContact> perObject;
  /// The contacts of own links: every asked pair that is not clear, in the order of
  /// isReportedBefore(), then by the other link.
  std::vector<PairContact> pairs;
  /// True: own links were asked, and every asked pair that `pairs` does not list is proven clear.
  /// False: `pairs` is empty and claims nothing.
  bool arePairsAnswered = false;
  /// As long as a link, or a pair, is free, it stays at least this far (m) from what it is asked
  /// about. Less than a share of the tolerance only where a link begins nearer and leaves.
  double provenClearance = 0.0;
  QueryCounters counters;
};

/// The contact of a link that is free until `freeUntil` and undecided after it.
[[nodiscard]] LinkContact undecidedContact(LinkId link, double freeUntil, UndecidedReason reason);

/// The order of reported links: earliest first, an undecided one at its freeUntil; at equal times
/// the lowest link first.
[[nodiscard]] bool isReportedBefore(const LinkContact& x, const LinkContact& y);

/// The reported links, in that order: all that are not Clear. Every format that lists contacts
/// lists these. O(links log links).
[[nodiscard]] std::vector<LinkId> reported(const StepContacts& step);
/// The same for `count` contacts, one per link, in order. Allocates nothing once `links` has room
/// for every link.
void listReported(const LinkContact* contacts, std::size_t count, std::vector<LinkId>& links);

/// For which contacts a format writes the field.
enum class ContactFieldUse : std::uint8_t {
  Every,
  Undecided,
  Touching,  ///< Contact and StartsInContact.
  StartsInContact,
  Exact,  ///< Touching, with a triangle of the link (linkTriangle is not -1).
  Never,  ///< Not in JSON and not on the wire.
};

using ContactMember = std::variant<std::int32_t LinkContact::*, double LinkContact::*,
                                   Eigen::Vector3d LinkContact::*, Verdict LinkContact::*,
                                   UndecidedReason LinkContact::*, FeatureKind LinkContact::*>;

struct ContactField {
  const char* name;  ///< In JSON and in Python; in the page's code as camelCase.
  const char* inC;   ///< In ft_contact.
  /// In contacts_t. For vectors, the part before _x, _y and _z; empty if it has no such field.
  const char* onWire;
  ContactMember member;
  ContactFieldUse use;
  const char* unit;     ///< "1" if it has none.
  const char* meaning;  ///< A sentence, which Python shows.
};

/// In the order of JSON. `object` is the name of the triangle's object in the scene.
inline constexpr std::array<ContactField, 16> kContactFields{{
    {"link", "link", "links", &LinkContact::link, ContactFieldUse::Every, "1",
     "The link that is told of."},
    {"verdict", "verdict", "verdicts", &LinkContact::verdict, ContactFieldUse::Every, "1",
     "What is known of its motion."},
    {"free_until", "free_until", "free_until", &LinkContact::freeUntil, ContactFieldUse::Undecided,
     "1", "Nothing is touched before this t; 1 where the link is clear."},
    {"reason", "reason", "reasons", &LinkContact::reason, ContactFieldUse::Undecided, "1",
     "Why it is undecided: 'work-budget', 'resolution' or 'after-first'."},
    {"toi", "toi", "", &LinkContact::toi, ContactFieldUse::Touching, "1",
     "Time of impact in [0, 1], never late."},
    {"separation", "separation", "separation", &LinkContact::separation, ContactFieldUse::Touching,
     "m", "At toi, at most the tolerance."},
    {"penetration", "penetration", "penetration", &LinkContact::penetration,
     ContactFieldUse::StartsInContact, "m", "How deep it starts; not known of triangles."},
    {"point", "point_scene", "point", &LinkContact::p_WScene, ContactFieldUse::Touching, "m",
     "Witness point on the scene, in the world."},
    {"on_link", "point_link", "on_link", &LinkContact::p_WLink, ContactFieldUse::Touching, "m",
     "Witness point on the link's surface, in the world."},
    {"normal", "normal", "normal", &LinkContact::nhat_SL_W, ContactFieldUse::Touching, "1",
     "Unit, from the scene to the link, in the world."},
    {"triangle", "triangle", "triangles", &LinkContact::triangle, ContactFieldUse::Touching, "1",
     "Of the scene."},
    {"object", "object", "objects", &LinkContact::triangle, ContactFieldUse::Touching, "1",
     "The triangle's object."},
    {"lss", "lss", "", &LinkContact::lss, ContactFieldUse::Never, "1", "Which of the link's LSS."},
    {"link_triangle", "link_triangle", "link_triangles", &LinkContact::linkTriangle,
     ContactFieldUse::Exact, "1", "At exact fidelity: which of the link's triangles."},
    {"link_feature", "link_feature", "link_features", &LinkContact::linkFeature,
     ContactFieldUse::Exact, "1", "At exact fidelity: 'vertex', 'edge' or 'face'."},
    {"scene_feature", "scene_feature", "scene_features", &LinkContact::sceneFeature,
     ContactFieldUse::Exact, "1", "The same of the scene's triangle."},
}};

/// Whether a format writes a field of this use for `contact`.
[[nodiscard]] constexpr bool isTold(ContactFieldUse use, const LinkContact& contact) {
  const bool isUndecided = contact.verdict == Verdict::Undecided;
  const bool isTouching = !isUndecided && contact.verdict != Verdict::Clear;
  switch (use) {
    case ContactFieldUse::Every: return true;
    case ContactFieldUse::Undecided: return isUndecided;
    case ContactFieldUse::Touching: return isTouching;
    case ContactFieldUse::StartsInContact: return contact.verdict == Verdict::StartsInContact;
    case ContactFieldUse::Exact: return isTouching && contact.linkTriangle >= 0;
    case ContactFieldUse::Never: return false;
  }
  return false;
}

}  // namespace foretouch
