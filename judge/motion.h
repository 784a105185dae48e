// judge/motion.h: the judge's own in-between motion, by its definition: every joint turns at
// constant rate about a fixed axis on the shorter arc and shifts linearly, a link's motion is the
// composition. Carries points from the link up to the root, joint by joint, together with bounds on
// their speed; or all frames from the roots down. In long double, and in fifty digits.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "judge/precise.h"
#include "judge/quaternion.h"
#include "judge/vector.h"

namespace foretouch::oracle {

/// A joint's parent-relative pose at both ends, in the same doubles as the product's input.
/// Rotations (w, x, y, z) need not be unit.
struct Joint {
  int parent = -1;  ///< Before this joint; -1: the world.
  std::array<double, 4> fromRotation{1, 0, 0, 0}, toRotation{1, 0, 0, 0};
  Vec3d fromTranslation, toTranslation;
  /// Is the dot product of the rotations below zero, as the caller's doubles compute it (perhaps
  /// with denormals flushed)? Part of the motion's definition: it chooses the arc.
  std::optional<bool> isFlipped = std::nullopt;

  /// isFlipped; else by that product in double, summed in the order w, x, y, z, zero counting as
  /// positive.
  [[nodiscard]] bool takesOtherSign() const;
  bool operator==(const Joint& o) const;
};

/// A point of a link at time t, in the world, and bounds that hold on [t - halfSpan, t + halfSpan].
template <typename S>
struct MovingPointOf {
  Vec3<S> position, velocity;
  S speed = 0;         ///< >= |velocity| anywhere in the span.
  S acceleration = 0;  ///< >= |acceleration| anywhere in the span.

  /// How far from `position` the point can be within `halfSpan` of t.
  [[nodiscard]] S stray(S halfSpan) const {
    return halfSpan * std::min(speed, S(norm(velocity) + S(0.5) * acceleration * halfSpan));
  }
};

/// A link's frame at an instant.
template <typename S>
struct MovingFrame {
  Quaternion<S> q;
  Vec3<S> p, w, v;  ///< Origin, angular velocity, velocity.
  [[nodiscard]] Vec3<S> at(const Vec3<S>& p_L) const { return p + rotate(q, p_L); }
  [[nodiscard]] Vec3<S> velocityAt(const Vec3<S>& x) const { return v + cross(w, x - p); }
};

/// Bounds on a link's origin, at every t in [0,1]; rounded up a little.
template <typename S>
struct MotionBounds {
  S angularSpeed = 0, angularAcceleration = 0, speed = 0, acceleration = 0, reach = 0;
  int depth = 0;
  /// The same for a point at distance `rho` from the origin.
  [[nodiscard]] S speedAt(const S& rho) const { return speed + angularSpeed * rho; }
  [[nodiscard]] S accelerationAt(const S& rho) const {
    return acceleration + (angularAcceleration + angularSpeed * angularSpeed) * rho;
  }
};

/// Instances: Real, Precise.
template <typename S>
class MotionOf {
 public:
  MotionOf() = default;
  /// Roots are relative to `origin`.
  explicit MotionOf(const std::vector<Joint>& joints, const Vec3d& origin = {});

  [[nodiscard]] int numLinks() const { return static_cast<int>(turns_.size()); }
  /// -1: the world.
  [[nodiscard]] int parent(int link) const { return turns_[static_cast<std::size_t>(link)].parent; }

  /// Points of a link at t, given in the link's frame; seen from the frame of `above`, the link
  /// itself or one above it (-1: the world).
  template <std::size_t N = 2>
  [[nodiscard]] std::array<MovingPointOf<S>, N> pointsAt(int link,
                                                         const std::array<Vec3d, N>& points,
                                                         const S& t, const S& halfSpan,
                                                         int above = -1) const {
    std::array<MovingPointOf<S>, N> moving;
    for (std::size_t i = 0; i < N; ++i) moving[i].position = points[i].template as<S>();
    carry({link, above}, moving.data(), N, t, halfSpan);
    return moving;
  }

  /// All links' frames at `t`; resizes `frames`.
  void framesAt(const S& t, std::vector<MovingFrame<S>>& frames) const;

  [[nodiscard]] const MotionBounds<S>& bounds(int link) const {
    return bounds_[static_cast<std::size_t>(link)];
  }

  /// The largest distance from the origin of the world, or of `above`, that a point at distance
  /// `rho` from the link's origin, or any joint in between, can have. Rounding is proportional to
  /// it.
  [[nodiscard]] S reach(int link, S rho, int above = -1) const;

 private:
  struct Turn {
    int parent = -1;
    Quaternion<S> from;
    Vec3<S> axis;  // unit, or zero for a joint that does not turn
    S angle = 0;   // over the whole step, radians, >= 0
    Vec3<S> translation, drift;
  };
  struct Chain {
    int link, above;
  };
  void carry(Chain chain, MovingPointOf<S>* points, std::size_t count, const S& t,
             const S& halfSpan) const;
  static Turn turnOf(const Joint& joint, const Vec3d& origin);
  static Quaternion<S> rotationAt(const Turn& turn, const S& t);
  void addBounds(const Turn& turn);

  std::vector<Turn> turns_;
  std::vector<MotionBounds<S>> bounds_;
};

using MovingPoint = MovingPointOf<Real>;
using Motion = MotionOf<Real>;

}  // namespace foretouch::oracle
