// tests/support/oracle_motion.h: the oracle's own in-between motion, in long double: every joint
// turns at constant rate about a fixed axis on the shorter arc and shifts linearly, a link's motion
// is the composition. Here points are carried from the link up to the root, one joint at a time,
// together with bounds on how fast they can move.
#pragma once

#include <array>
#include <vector>

#include "tests/support/oracle_vector.h"

namespace foretouch::oracle {

/// A joint's parent-relative pose at both ends, as the doubles the product was given.
struct Joint {
  int parent = -1;  ///< Before this joint; -1: the world.
  std::array<double, 4> fromRotation{1, 0, 0, 0}, toRotation{1, 0, 0, 0};  ///< w, x, y, z
  Vec3d fromTranslation, toTranslation;
};

/// A point of a link at time t, in the world, and bounds that hold on [t - halfSpan, t + halfSpan].
struct MovingPoint {
  Vec3r position, velocity;
  Real speed = 0;         ///< >= |velocity| anywhere in the span.
  Real acceleration = 0;  ///< >= |acceleration| anywhere in the span.

  /// How far from `position` the point can be within `halfSpan` of t.
  [[nodiscard]] Real stray(Real halfSpan) const {
    return halfSpan *
           std::min(speed, norm(velocity) + static_cast<Real>(0.5) * acceleration * halfSpan);
  }
};

class Motion {
 public:
  /// Rotations need not be unit (they are normalised here); the arc is chosen by the sign of their
  /// dot product in double, summed in the order w, x, y, z, zero counting as positive.
  explicit Motion(const std::vector<Joint>& joints);

  [[nodiscard]] int numLinks() const { return static_cast<int>(turns_.size()); }

  /// Points of a link at t, given in the link's frame.
  template <std::size_t N = 2>
  [[nodiscard]] std::array<MovingPoint, N> pointsAt(int link, const std::array<Vec3d, N>& points,
                                                    Real t, Real halfSpan) const {
    std::array<MovingPoint, N> moving;
    for (std::size_t i = 0; i < N; ++i) moving[i].position = points[i].template as<Real>();
    carry(link, moving.data(), N, t, halfSpan);
    return moving;
  }

  /// The largest distance from the world's origin that a point at distance `rho` from the link's
  /// origin, or any joint above it, can have: what rounding is proportional to.
  [[nodiscard]] Real reach(int link, Real rho) const;

 private:
  struct Quaternion {
    Real w = 1;
    Vec3r v;
  };
  struct Turn {
    int parent = -1;
    Quaternion from;
    Vec3r axis;      // unit, or zero for a joint that does not turn
    Real angle = 0;  // over the whole step, radians, >= 0
    Vec3r translation, drift;
  };
  void carry(int link, MovingPoint* points, std::size_t count, Real t, Real halfSpan) const;
  static Quaternion normalised(const std::array<double, 4>& q);
  static Quaternion product(const Quaternion& a, const Quaternion& b);
  static Vec3r rotated(const Quaternion& q, const Vec3r& v);
  static Turn turnOf(const Joint& joint);
  static Quaternion rotationAt(const Turn& turn, Real t);

  std::vector<Turn> turns_;
};

}  // namespace foretouch::oracle
