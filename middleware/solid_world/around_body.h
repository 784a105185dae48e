// middleware/solid_world/around_body.h: a body that a solid avatar may meet in one tick, and what
// it does from the tick's begin to its end: motions, leg by leg. Metres in W, world time in
// microseconds. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/skeleton.h"
#include "lss/lss.h"
#include "middleware/scene/scene.h"
#include "middleware/world/world_contacts.h"

namespace foretouch::internal {

/// What of a body touches, on the chain of the body and of all that carry it.
struct AroundKind {
  std::int32_t number = 0;  ///< Among all kinds of one world.
  Skeleton skeleton;        ///< Carriers first.
  JointId first = 0;        ///< The first of the body's own joints.
  /// Per joint of the chain; for a mesh, LSS that contain it, on joint `first`.
  std::vector<std::vector<Lss>> volumes;
  std::optional<Scene> mesh;  ///< In the frame of joint `first`.
  double rho = 0.0;           ///< No point of the volumes is farther from its link's origin.
};

/// One motion of the chain.
struct AroundLeg {
  std::int64_t beginUs = 0, endUs = 0;
  const AroundKind* kind = nullptr;
  Pose from, to;
  double rounding = 0.0;  ///< No point of what touches is farther from its true place (m).
};

/// Keeps its memory.
class AroundBody {
 public:
  BodyId body = 0;
  bool isSolid = false;    ///< A solid avatar: nothing ever makes it pass through another one.
  bool isAssumed = false;  ///< It was silent, and is taken to hold still.

  void begin(BodyId id);
  /// The next leg, which the caller fills and then settle()s. Legs come in order; between two of
  /// them the body is not there.
  AroundLeg& addLeg();
  /// Finds what the last leg sweeps.
  void settle();
  [[nodiscard]] std::size_t numLegs() const { return count_; }
  [[nodiscard]] const AroundLeg& leg(std::size_t i) const { return legs_[i]; }
  /// The box of everything that it sweeps in the tick.
  [[nodiscard]] const Eigen::AlignedBox3d& box() const { return box_; }

  /// The leg that the instant is in, the earlier one where two meet; null if the body is not there.
  [[nodiscard]] const AroundLeg* legAt(std::int64_t us) const;
  /// All links of the leg's chain at an instant of it. Not for two threads at once.
  void placeAt(const AroundLeg& leg, std::int64_t us, std::vector<LinkState>& states) const;

 private:
  std::vector<AroundLeg> legs_;  // longer than the count
  std::size_t count_ = 0;
  Eigen::AlignedBox3d box_;
  mutable ChainMotion motion_;
  mutable Pose pose_;
  std::vector<LinkState> states_;
};

/// A box around all that volumes on a moving chain sweep. `states`: memory.
[[nodiscard]] Eigen::AlignedBox3d sweptBox(const std::vector<std::vector<Lss>>& volumes,
                                           const ChainMotion& motion,
                                           std::vector<LinkState>& states);

/// The instant as a share of the window, in [0,1].
[[nodiscard]] double shareOf(std::int64_t beginUs, std::int64_t endUs, std::int64_t us);

/// The part of a motion from one pose to another that lies between two instants of it. Returns how
/// far any point at most `rho` from its link is from its true place in it.
class PartOfMotion {
 public:
  double cut(const Skeleton& skeleton, const Pose& from, const Pose& to, std::int64_t beginUs,
             std::int64_t endUs, std::int64_t partBeginUs, std::int64_t partEndUs, double rho);
  [[nodiscard]] const Pose& from() const { return from_; }
  [[nodiscard]] const Pose& to() const { return to_; }

 private:
  ChainMotion motion_;
  Pose from_, to_;
};

}  // namespace foretouch::internal
