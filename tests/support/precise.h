// tests/support/precise.h: fifty-digit forward kinematics and distances, the yardstick for
// rounding. Shares no code with what it checks; slow on purpose. Formulas are textbook: quaternion
// slerp by sine weights, and the distance as the least over every pair of features whose foot
// points are inside.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace foretouch::test {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;

struct Precise3 {
  std::array<Real, 3> c;
  Precise3() : c{Real(0), Real(0), Real(0)} {}
  Precise3(Real x, Real y, Real z) : c{x, y, z} {}
  explicit Precise3(const Eigen::Vector3d& v) : c{Real(v.x()), Real(v.y()), Real(v.z())} {}
};

Precise3 operator+(const Precise3& a, const Precise3& b);
Precise3 operator-(const Precise3& a, const Precise3& b);
Precise3 operator*(const Real& s, const Precise3& a);
Real dot(const Precise3& a, const Precise3& b);
Precise3 cross(const Precise3& a, const Precise3& b);
Real norm(const Precise3& a);

/// Quaternion w, x, y, z.
struct PreciseQuaternion {
  Real w = 1, x = 0, y = 0, z = 0;
};
PreciseQuaternion operator*(const PreciseQuaternion& a, const PreciseQuaternion& b);
Precise3 rotate(const PreciseQuaternion& q, const Precise3& v);
/// Unit inputs are not needed; the arc is chosen by the sign of the double dot product in w, x, y,
/// z.
PreciseQuaternion slerp(const Eigen::Quaternion<double, Eigen::DontAlign>& from,
                        const Eigen::Quaternion<double, Eigen::DontAlign>& to, const Real& t);

/// One joint of a chain: its parent's index (-1: root) and its parent-relative pose at both ends.
struct PreciseJoint {
  int parent = -1;
  Eigen::Quaternion<double, Eigen::DontAlign> fromRotation, toRotation;
  Eigen::Vector3d fromTranslation, toTranslation;
};
struct PreciseFrame {
  PreciseQuaternion rotation;
  Precise3 origin;
  [[nodiscard]] Precise3 at(const Eigen::Vector3d& p_L) const {
    return origin + rotate(rotation, Precise3(p_L));
  }
};
/// World frames of all joints at t, parents before children.
std::vector<PreciseFrame> preciseFrames(const std::vector<PreciseJoint>& joints, const Real& t);

/// Distance of segment ab and triangle v, correct for every degenerate input.
Real preciseDistance(const Precise3& a, const Precise3& b, const std::array<Precise3, 3>& v);
/// Distance of two triangles, likewise.
Real preciseDistance(const std::array<Precise3, 3>& one, const std::array<Precise3, 3>& other);

}  // namespace foretouch::test
