// middleware/world/world_contacts.h: what a world answers: which links of which bodies meet first,
// when (finer than the microseconds of poses) and where. Metres in W. The promise:
// docs/guarantees.md 15.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "articulated/track.h"
#include "middleware/contact.h"
#include "middleware/scene/scene.h"

namespace foretouch {

/// `us` whole microseconds and a fraction in [0,1) of one more.
struct WorldTime {
  std::int64_t us = 0;
  double fraction = 0.0;
};
[[nodiscard]] inline bool operator<(const WorldTime& x, const WorldTime& y) {
  return std::tie(x.us, x.fraction) < std::tie(y.us, y.fraction);
}
[[nodiscard]] inline bool operator==(const WorldTime& x, const WorldTime& y) {
  return x.us == y.us && x.fraction == y.fraction;
}

/// The instant at `t` in [0,1] of the span [beginUs, endUs], rounded down: never later than it is.
[[nodiscard]] WorldTime worldTimeAt(std::int64_t beginUs, std::int64_t endUs, double t);
/// The next instant that can be written.
[[nodiscard]] WorldTime justAfter(const WorldTime& time);
/// From `us` to the instant, in microseconds, rounded.
[[nodiscard]] inline double microsecondsAfter(std::int64_t us, const WorldTime& time) {
  return static_cast<double>(time.us - us) + time.fraction;
}

/// A body of a World, in the order in which they were added.
using BodyId = std::int32_t;
/// In a contact: the static scene.
inline constexpr BodyId kStillScene = -1;

/// In an undecided contact: every link that has none of its own listed.
inline constexpr LinkId kEveryLink = -1;

/// One of the two that meet.
struct ContactSide {
  BodyId body = kStillScene;
  LinkId link = 0;        ///< 0 for a mesh and for the scene.
  std::int32_t lss = -1;  ///< Index among the link's LSS; -1 for a mesh and for the scene.
  /// In a mesh or the scene; in an avatar that brings a surface, among the link's triangles, or
  /// -1 where its LSS touches; else -1.
  TriangleId triangle = -1;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< Witness point on its surface.
};

/// The first contact of two links of a window of world time. `a` is the body with the lower number,
/// or of one body the lower link; the scene is always `b`.
/// Sound: `time` is never later than the first touch of the two in the window, rounding included.
/// Tight: for Contact, their separation is then at most the world's tolerance.
struct WorldContact {
  ContactSide a, b;
  /// Contact, StartsInContact: they touch where the window begins, or where one of them appears or
  /// is attached. Undecided: free until `time`, nothing claimed after it.
  Verdict verdict = Verdict::Undecided;
  UndecidedReason reason = UndecidedReason::None;
  WorldTime time;
  double separation = 0.0;                              ///< As LinkContact::separation.
  double penetration = 0.0;                             ///< As LinkContact::penetration.
  Eigen::Vector3d nhat_BA_W = Eigen::Vector3d::Zero();  ///< Unit, from b to a; as LinkContact.
  /// A body that it depends on was silent, and was taken to hold still (WhenSilent::HoldStill).
  bool isAssumed = false;
};

/// A body of which nothing was known in the rest of the window, or that is crowded
/// (WorldOptions::mostNear).
struct SilentBody {
  BodyId body = 0;
  std::int64_t sinceUs = 0;                       ///< Its last knot, or the window's begin.
  WhenSilent takenTo = WhenSilent::HoldStill;     ///< HoldStill or Undecided.
  UndecidedReason reason = UndecidedReason::Gap;  ///< WorkBudget: it is crowded.
};

struct WorldCounters {
  std::uint64_t bodies = 0;     ///< Bodies whose swept boxes were found.
  std::uint64_t pairs = 0;      ///< Pairs of bodies, asked, whose boxes meet.
  std::uint64_t nearPairs = 0;  ///< Those with two LSS whose boxes meet.
  std::uint64_t spans = 0;      ///< Spans asked of a pair or of a body alone, from knot to knot.
  QueryCounters queries;        ///< What all of these took.
  /// What this answer took, in the units of WorldOptions::workPerWindow: unlike the others, it does
  /// not count what an earlier window has found out.
  std::uint64_t work = 0;
};

/// For one window. All pairs of links that were asked and not listed are proven clear while both
/// bodies are there; but nothing is claimed of a body in `silent` that is taken to be Undecided,
/// nor of what it carries, from then on.
struct WorldContacts {
  /// Earliest first; at equal times by a's body and link, then by b's.
  std::vector<WorldContact> contacts;
  std::vector<SilentBody> silent;  ///< By body.
  WorldCounters counters;
};

}  // namespace foretouch
