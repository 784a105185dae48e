// judge/first_touch.h: when a capsule whose axis moves in any known way first touches a scene, by
// conservative advancement in double. Metres.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "judge/scene.h"
#include "judge/vector.h"

namespace foretouch::oracle {

/// The distance (m) of the segment ab from the triangles, or `bound` if that is less: looks no
/// farther. Zero if the segment meets one. Errs by a few roundings of the coordinates.
[[nodiscard]] double distanceTo(const Scene& scene, const Vec3d& a, const Vec3d& b, double bound);

/// A moving axis.
struct MovingAxis {
  std::function<std::array<Vec3d, 2>(double t)> at;  ///< Its ends; t in [0,1].
  double speed = 0.0;  ///< No point of it is ever faster (m per unit of t).
  double radius = 0.0;
};

enum class TouchOutcome : std::uint8_t {
  Free,       ///< Proven: the separation is positive at every t.
  Touch,      ///< At t the separation is at most kTouchSeparation, before t it is positive.
  Uncertain,  ///< kTouchSteps evaluations did not decide: the motion grazes something.
};

struct FirstTouch {
  TouchOutcome outcome = TouchOutcome::Free;
  double t = 1.0;
};

/// Metres: a million times finer than the finest difference that it judges.
inline constexpr double kTouchSeparation = 1e-9;
/// Evaluations of the distance; callers replace motions that need more.
inline constexpr int kTouchSteps = 20'000;

/// Conservative advancement [Mirtich96]: no point of the axis can come nearer faster than its
/// speed. Reduces the computed separation by more than rounding can change it.
[[nodiscard]] FirstTouch firstTouch(const Scene& scene, const MovingAxis& axis);

}  // namespace foretouch::oracle
