// middleware/solid/solid_tick.h: what a solid avatar shows at one tick, and why. Lengths in metres
// in the world W.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "middleware/scene/scene.h"

namespace foretouch {

/// The numbers are those of the C API and the wire.
enum class SolidState : std::uint8_t {
  Placing = 0,  ///< No free place is found yet: `shown` is the tracked pose, and nothing is proven.
  Equal = 1,    ///< Shown is tracked, bit for bit (lost joints and the lift apart).
  Following = 2,  ///< On its way to the tracked pose, touching nothing: catching up.
  Sliding = 3,    ///< Surfaces keep it from the tracked pose, and it moved.
  Held = 4,       ///< Surfaces keep it from the tracked pose, and it stays where it is.
  Around = 5,     ///< On a proven way around what is between it and the tracked pose.
  Snapped = 6,    ///< Appeared at this place: the only break of the shown curve.
};
inline constexpr std::uint8_t kNumSolidStates = 7;
/// "placing", "equal", "following", "sliding", "held", "around", "snapped".
[[nodiscard]] const char* toString(SolidState state);

/// The state of one joint and its link.
enum class SolidJointState : std::uint8_t {
  Free = 0,     ///< No contact moves it from its tracked place.
  Sliding = 1,  ///< Its link is in contact, and moved.
  Held = 2,     ///< Its link is in contact, and did not move.
  Lost = 3,     ///< Its tracker is: it keeps its place on its parent, as far as surfaces let it.
};
inline constexpr std::uint8_t kNumSolidJointStates = 4;
/// "free", "sliding", "held", "lost".
[[nodiscard]] const char* toString(SolidJointState state);

/// Why a tick ended before it was as near to its target as surfaces let it.
enum class SolidLimit : std::uint8_t {
  None = 0,
  Budget = 1,   ///< SolidOptions::workBudget was spent.
  CatchUp = 2,  ///< SolidOptions::catchUp.
  Inside = 3,   ///< The scene that was changed has the avatar inside: it stays, unproven.
};
inline constexpr std::uint8_t kNumSolidLimits = 4;
/// "none", "budget", "catch-up", "inside".
[[nodiscard]] const char* toString(SolidLimit limit);

/// One place where a surface holds the shown pose from the tracked one.
struct SolidContact {
  LinkId link = 0;
  std::int32_t lss = -1;     ///< Index among the link's LSS.
  TriangleId triangle = -1;  ///< In the scene; -1 if another own link is touched.
  LinkId other = -1;         ///< That link.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();     ///< On the surface that is touched.
  Eigen::Vector3d nhat_W = Eigen::Vector3d::Zero();  ///< Unit, from it to the link.
  double gap = 0.0;
  /// How hard the tracked pose presses, >= 0 (m). Times a stiffness (N/m) it is the force along
  /// nhat_W with which a haptic device holds the hand; the pushes of all contacts together hold the
  /// shown pose from the tracked one, ends of joints apart (solid.md 4). Zero: it holds nothing.
  double push = 0.0;
  double slipSpeed = 0.0;  ///< How fast the link's point goes along the surface (m/s).
};

/// Work done, independent of the machine's load.
struct SolidCounters {
  std::uint32_t queries = 0;     ///< Motions asked.
  std::uint32_t iterations = 0;  ///< Steps proposed.
  std::uint32_t features = 0;    ///< Near features that the solver was given, in all iterations.
  std::uint32_t rows = 0;        ///< Those that it took up.
  std::uint32_t aroundQueries = 0, placingQueries = 0;  ///< Part of `queries`.
  std::uint64_t work = 0;                               ///< As SolidOptions::workBudget counts it.
};

struct SolidTick {
  Pose shown;
  SolidState state = SolidState::Placing;
  SolidLimit limit = SolidLimit::None;
  /// Proven: on the whole way from the pose shown before to this one, the avatar touches nothing
  /// (of what is not ignored). False: while Placing, or where the scene was changed around it.
  bool isCertified = false;
  /// It appeared at `way.front()`, which is proven free, but no way leads there: its first place, a
  /// place after it was inside, or a snap. The only breaks of the shown curve.
  bool hasAppeared = false;
  double deviation = 0.0;  ///< The largest of all links.
  double lift = 0.0;       ///< How far FloorPolicy::Lift has lifted the target.
  /// The largest distance of a point of a link's axes from where its tracker says, the lift not
  /// counted; one per link.
  std::vector<double> linkDeviation;
  std::vector<SolidJointState> joints;  ///< One per joint.
  std::vector<SolidContact> contacts;   ///< By link, LSS, triangle, other.
  /// The way from the pose shown before: every piece is a chain motion (articulated/motion.h) from
  /// the pose before it, bit for bit. The last one is `shown`; `times` says when each is reached,
  /// in (0, 1] of the tick (0: where it appeared). Only the first `numWay` count; 0: it did not
  /// move.
  std::vector<Pose> way;
  std::vector<double> times;
  std::size_t numWay = 0;
  /// Proven lower bound on the separation at every instant of the way (m); infinite if it did not
  /// move, 0 if not certified.
  double clearance = 0.0;
  double snapInS = -1.0;  ///< Seconds until the avatar snaps, if nothing changes; < 0: it does not.
  SolidCounters counters;
};

}  // namespace foretouch
