// bench/extremes/precise_motion.h: the in-between motion by its definition (each joint turns
// at constant rate about a fixed axis on the chosen arc, its translation is linear, links compose),
// over any real number type, with bounds on speed and acceleration of its own. Nothing of the
// product in it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "bench/extremes/precise_geometry.h"

namespace foretouch::tools::extremes {

/// One joint as given: doubles, to the bit. Quaternions w, x, y, z, not necessarily unit.
struct OracleJoint {
  int parent = -1;  ///< An earlier joint, or -1.
  std::array<double, 4> fromRotation{1, 0, 0, 0}, toRotation{1, 0, 0, 0};
  std::array<double, 3> fromTranslation{}, toTranslation{};
  /// The dot product of the two quaternions as doubles compute it is below zero: part of the
  /// motion's definition, so it is handed in.
  bool isFlipped = false;
  bool operator==(const OracleJoint& o) const {
    return parent == o.parent && fromRotation == o.fromRotation && toRotation == o.toRotation &&
           fromTranslation == o.fromTranslation && toTranslation == o.toTranslation &&
           isFlipped == o.isFlipped;
  }
};

/// The nearest number of that type.
template <typename Real>
Real narrowed(const Precise& x) {
  return x.template convert_to<Real>();
}
template <>
inline Precise narrowed<Precise>(const Precise& x) {
  return x;
}

/// `p` from the corner `origin`: the difference is taken in fifty digits.
template <typename Real>
Vector<Real> relative(const std::array<double, 3>& p, const std::array<double, 3>& origin) {
  return {narrowed<Real>(Precise(p[0]) - Precise(origin[0])),
          narrowed<Real>(Precise(p[1]) - Precise(origin[1])),
          narrowed<Real>(Precise(p[2]) - Precise(origin[2]))};
}

template <typename Real>
class PreciseMotion {
 public:
  struct Frame {
    Rotation<Real> q;
    Vector<Real> p, w, v;  // origin, angular velocity, velocity
    [[nodiscard]] Vector<Real> at(const Vector<Real>& p_L) const { return p + rotate(q, p_L); }
    [[nodiscard]] Vector<Real> velocityAt(const Vector<Real>& x) const {
      return v + cross(w, x - p);
    }
  };
  /// Of a link's origin, at every t in [0,1]; a little rounded up.
  struct Bounds {
    Real angularSpeed = 0, angularAcceleration = 0, speed = 0, acceleration = 0, reach = 0;
    int depth = 0;
    [[nodiscard]] Real speedAt(const Real& rho) const { return speed + angularSpeed * rho; }
    [[nodiscard]] Real accelerationAt(const Real& rho) const {
      return acceleration + (angularAcceleration + angularSpeed * angularSpeed) * rho;
    }
  };

  PreciseMotion() = default;
  /// Roots are taken from `origin`.
  PreciseMotion(const std::vector<OracleJoint>& joints, const std::array<double, 3>& origin) {
    for (const OracleJoint& joint : joints) addJoint(joint, origin);
  }

  /// All links' frames at `t`; `frames` is resized.
  void framesAt(const Real& t, std::vector<Frame>& frames) const {
    using std::cos;
    using std::sin;
    frames.resize(joints_.size());
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const Joint& joint = joints_[j];
      const Frame parent =
          joint.parent < 0 ? Frame{} : frames[static_cast<std::size_t>(joint.parent)];
      const Vector<Real> arm = rotate(parent.q, joint.translation + t * joint.drift);
      Frame& frame = frames[j];
      frame.p = parent.p + arm;
      frame.v = parent.v + cross(parent.w, arm) + rotate(parent.q, joint.drift);
      const Rotation<Real> start = parent.q * joint.start;
      if (!joint.turns) {
        frame.q = start;
        frame.w = parent.w;
        continue;
      }
      const Real sine = sin(t * joint.half), cosine = cos(t * joint.half);
      frame.q = start * Rotation<Real>{cosine, sine * joint.axis.x, sine * joint.axis.y,
                                       sine * joint.axis.z};
      frame.w = parent.w + Real(2) * joint.half * rotate(start, joint.axis);
    }
  }

  [[nodiscard]] const Bounds& bounds(std::size_t link) const { return bounds_[link]; }

 private:
  struct Joint {
    int parent = -1;
    Rotation<Real> start;
    Vector<Real> axis, translation, drift;  // axis: unit, in the joint's frame
    Real half = 0;                          // of the angle
    bool turns = false;
  };

  static Rotation<Precise> unit(const std::array<double, 4>& q, bool isFlipped) {
    Rotation<Precise> r{Precise(q[0]), Precise(q[1]), Precise(q[2]), Precise(q[3])};
    Precise length = sqrt(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z);
    if (isFlipped) length = -length;
    return {r.w / length, r.x / length, r.y / length, r.z / length};
  }
  static Rotation<Real> narrow(const Rotation<Precise>& q) {
    return {narrowed<Real>(q.w), narrowed<Real>(q.x), narrowed<Real>(q.y), narrowed<Real>(q.z)};
  }

  void addJoint(const OracleJoint& given, const std::array<double, 3>& origin) {
    using std::max;
    Joint joint;
    joint.parent = given.parent;
    const Rotation<Precise> q0 = unit(given.fromRotation, false);
    const Rotation<Precise> q1 = unit(given.toRotation, given.isFlipped);
    const Rotation<Precise> turn = Rotation<Precise>{q0.w, -q0.x, -q0.y, -q0.z} * q1;
    const Vector<Precise> v{turn.x, turn.y, turn.z};
    const Precise sine = norm(v);
    joint.start = narrow(q0);
    joint.turns = sine > Precise("1e-45");  // less is the rounding of fifty digits
    if (joint.turns) {
      joint.half = narrowed<Real>(atan2(sine, turn.w));
      joint.axis = {narrowed<Real>(v.x / sine), narrowed<Real>(v.y / sine),
                    narrowed<Real>(v.z / sine)};
    }
    const std::array<double, 3> zero{};
    joint.translation = relative<Real>(given.fromTranslation, given.parent < 0 ? origin : zero);
    joint.drift = relative<Real>(given.toTranslation, given.fromTranslation);
    joints_.push_back(joint);
    addBounds(joint);
  }

  /// Norms of x' = x_p' + w_p x R_p o + R_p d and of its derivative, term by term.
  void addBounds(const Joint& joint) {
    using std::max;
    const Real roundUp = Real(1) + Real(1e-12);
    const Bounds parent =
        joint.parent < 0 ? Bounds{} : bounds_[static_cast<std::size_t>(joint.parent)];
    const Real length =
        roundUp * max(norm(joint.translation), norm(Vector<Real>(joint.translation + joint.drift)));
    const Real drift = roundUp * norm(joint.drift);
    const Real turn = roundUp * Real(2) * joint.half;
    Bounds b;
    b.angularSpeed = parent.angularSpeed + turn;
    b.angularAcceleration = parent.angularAcceleration + parent.angularSpeed * turn;
    b.speed = parent.speed + parent.angularSpeed * length + drift;
    b.acceleration =
        parent.acceleration +
        (parent.angularAcceleration + parent.angularSpeed * parent.angularSpeed) * length +
        Real(2) * parent.angularSpeed * drift;
    b.reach = parent.reach + length;
    b.depth = parent.depth + 1;
    bounds_.push_back(b);
  }

  std::vector<Joint> joints_;
  std::vector<Bounds> bounds_;
};

}  // namespace foretouch::tools::extremes
