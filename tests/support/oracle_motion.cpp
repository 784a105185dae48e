// tests/support/oracle_motion.cpp: slerp by axis and angle, points carried up the chain.
#include "tests/support/oracle_motion.h"

namespace foretouch::oracle {

Motion::Quaternion Motion::normalised(const std::array<double, 4>& q) {
  const Vec3r v{q[1], q[2], q[3]};
  const Real w = q[0];
  const Real length = std::sqrt(w * w + dot(v, v));
  return {w / length, (1 / length) * v};
}

Motion::Quaternion Motion::product(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}

Vec3r Motion::rotated(const Quaternion& q, const Vec3r& v) {
  const Vec3r twice = static_cast<Real>(2) * cross(q.v, v);
  return v + q.w * twice + cross(q.v, twice);
}

Motion::Turn Motion::turnOf(const Joint& joint) {
  const auto& f = joint.fromRotation;
  auto to = joint.toRotation;
  const double sign = ((f[0] * to[0] + f[1] * to[1]) + f[2] * to[2]) + f[3] * to[3];
  if (sign < 0.0) {
    for (double& c : to) c = -c;
  }
  Turn turn;
  turn.parent = joint.parent;
  turn.from = normalised(f);
  const Quaternion back{turn.from.w, static_cast<Real>(-1) * turn.from.v};
  const Quaternion relative = product(back, normalised(to));
  const Real sine = norm(relative.v);
  if (sine > 0) {
    turn.axis = (1 / sine) * relative.v;
    turn.angle = 2 * std::atan2(sine, relative.w);
  }
  turn.translation = joint.fromTranslation.as<Real>();
  turn.drift = joint.toTranslation.as<Real>() - turn.translation;
  return turn;
}

Motion::Motion(const std::vector<Joint>& joints) {
  turns_.reserve(joints.size());
  for (const Joint& joint : joints) turns_.push_back(turnOf(joint));
}

Motion::Quaternion Motion::rotationAt(const Turn& turn, Real t) {
  if (turn.angle == 0) return turn.from;
  const Real half = turn.angle * t / 2;
  return product(turn.from, {std::cos(half), std::sin(half) * turn.axis});
}

// Let x(t) be the point in a joint's frame, and y = T(t) + R(t) x its place in the parent's, with R
// turning at the constant rate w = angle * axis and T linear with rate d. Then
//   y'  = d + R (w x x + x'),                         |y'|  <= |d| + angle |x| + |x'|
//   y'' = R (w x (w x x) + 2 w x x' + x''),           |y''| <= angle^2 |x| + 2 angle |x'| + |x''|
// where |x| is at most its value at the span's middle plus halfSpan * sup |x'|.
void Motion::carry(int link, MovingPoint* points, std::size_t count, Real t, Real halfSpan) const {
  for (int j = link; j >= 0; j = turns_[static_cast<std::size_t>(j)].parent) {
    const Turn& turn = turns_[static_cast<std::size_t>(j)];
    const Quaternion rotation = rotationAt(turn, t);
    const Vec3r spin = turn.angle * turn.axis;
    const Real drift = norm(turn.drift);
    for (std::size_t i = 0; i < count; ++i) {
      MovingPoint& p = points[i];
      const Real distance = norm(p.position) + halfSpan * p.speed;
      p.acceleration += turn.angle * (turn.angle * distance + 2 * p.speed);
      p.speed += drift + turn.angle * distance;
      p.velocity = turn.drift + rotated(rotation, cross(spin, p.position) + p.velocity);
      p.position = turn.translation + t * turn.drift + rotated(rotation, p.position);
    }
  }
}

Real Motion::reach(int link, Real rho) const {
  Real sum = rho;
  for (int j = link; j >= 0; j = turns_[static_cast<std::size_t>(j)].parent) {
    const Turn& turn = turns_[static_cast<std::size_t>(j)];
    sum += std::max(norm(turn.translation), norm(turn.translation + turn.drift));
  }
  return sum;
}

}  // namespace foretouch::oracle
