// middleware/contact.h: what a query answers for each link: its verdict and its first contact.
// Lengths in metres in the world W; t is normalised, 0 at the earlier pose and 1 at the later. The
// promise, its proof and the constants in it: docs/guarantees.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "middleware/exact/leaf.h"
#include "middleware/query_counters.h"
#include "middleware/scene/triangle_id.h"

namespace foretouch {

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
  None = 0,        ///< Decided; or not answered, by a query that failed.
  WorkBudget = 1,  ///< QueryOptions::workBudget or deadlineUs was spent.
  Resolution = 2,  ///< Doubles cannot resolve the tolerance at these coordinates.
  AfterFirst = 3,  ///< Scope::FirstOfAvatar: another link's contact is earlier.
  // Queries never give those that follow; streams of poses do (docs/streaming.md).
  Gap = 4,             ///< Poses were lost: what happened between the two is not known.
  MissingJoint = 5,    ///< A joint above the link, or its own, is not in one of the poses.
  InvalidJoint = 6,    ///< ... is marked as not valid.
  StaleJoint = 7,      ///< ... is valid but neither tracked nor inferred: an old value.
  UnmatchedJoint = 8,  ///< ... is not in the sender's skeleton.
};
inline constexpr std::uint8_t kNumUndecidedReasons = 9;

/// "none", "work-budget", "resolution", "after-first", "gap", "missing-joint", ...
[[nodiscard]] const char* toString(UndecidedReason reason);

/// What one link meets first on one motion. Undecided and free until 0, which claims nothing, until
/// a query has answered: Clear is written where the proof of it ends, and nowhere else.
/// Sound: toi and freeUntil never exceed the true time of first contact, rounding included.
/// Tight: for Contact, the separation at toi is <= tolerance.
/// The witness points, normal and triangle are those of the pair with the lowest toi; equal toi:
/// the smaller separation, then the lexicographically smaller witness point and normal, then the
/// lowest triangle. (At exact fidelity, of the scene's triangles that a link touches at t = 0 the
/// one deepest in the link's LSS, and the lowest of the link's triangles.) So the answer does not
/// depend on threads, on the culler or on the triangles' order.
struct LinkContact {
  LinkId link = 0;
  Verdict verdict = Verdict::Undecided;
  UndecidedReason reason = UndecidedReason::None;
  double toi = 0.0;        ///< Time of impact, rounded down; freeUntil where there is no contact.
  double freeUntil = 0.0;  ///< Equals toi for Contact and StartsInContact, 1 for Clear.
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

struct StepContacts {
  std::vector<LinkContact> links;  ///< One a link of the avatar, in order.
  QueryCounters counters;
};

/// What is said of a link that is free until `freeUntil`, and of which nothing is known after it.
[[nodiscard]] LinkContact undecidedContact(LinkId link, double freeUntil, UndecidedReason reason);

/// The order in which links are reported: earliest first, an undecided one at its freeUntil; of
/// those at the same time the lowest link first.
[[nodiscard]] bool isReportedBefore(const LinkContact& x, const LinkContact& y);

/// The links that are reported, in that order: all that are not Clear. Every format that lists
/// contacts lists these. O(links log links).
[[nodiscard]] std::vector<LinkId> reported(const StepContacts& step);
/// The same of `count` contacts, one per link, in order. Allocates nothing once `links` has room
/// for every link.
void listReported(const LinkContact* contacts, std::size_t count, std::vector<LinkId>& links);

}  // namespace foretouch
