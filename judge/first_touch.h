// judge/first_touch.h: when a capsule whose axis moves in any known way first touches a scene, by
// conservative advancement in double. Metres.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "judge/scene.h"
#include "judge/vector.h"

namespace foretouch::oracle {

/// The distance (m) of the segment ab from the triangles, or `bound` where that is less: none
/// farther is looked for. Zero where the segment meets one. Errs by a few roundings of the
/// coordinates.
[[nodiscard]] double distanceTo(const Scene& scene, const Vec3d& a, const Vec3d& b, double bound);

/// An axis on its way.
struct MovingAxis {
  std::function<std::array<Vec3d, 2>(double t)> at;  ///< Its ends; t in [0,1].
  double speed = 0.0;  ///< No point of it is ever faster (m per unit of t).
  double radius = 0.0;
};

enum class TouchOutcome : std::uint8_t {
  Free,       ///< Proven: the separation is positive at every t.
  Touch,      ///< At t the separation is at most kTouchSeparation, before t it is positive.
  Uncertain,  ///< kTouchSteps evaluations did not tell: the motion grazes something.
};

struct FirstTouch {
  TouchOutcome outcome = TouchOutcome::Free;
  double t = 1.0;
};

/// Metres: a million times finer than the finest difference that is judged by it.
inline constexpr double kTouchSeparation = 1e-9;
/// Evaluations of the distance; motions that need more are replaced by others.
inline constexpr int kTouchSteps = 20'000;

/// Conservative advancement [Mirtich96]: no point of the axis can come nearer faster than its
/// speed. The separation is taken to be less than computed by more than rounding can do.
[[nodiscard]] FirstTouch firstTouch(const Scene& scene, const MovingAxis& axis);

}  // namespace foretouch::oracle
