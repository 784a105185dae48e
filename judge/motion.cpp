// judge/motion.cpp: slerp by axis and angle.
#include "judge/motion.h"

namespace foretouch::oracle {

bool Joint::takesOtherSign() const {
  if (isFlipped) return *isFlipped;
  const auto &f = fromRotation, &t = toRotation;
  return ((f[0] * t[0] + f[1] * t[1]) + f[2] * t[2]) + f[3] * t[3] < 0.0;
}

bool Joint::operator==(const Joint& o) const {
  return parent == o.parent && fromRotation == o.fromRotation && toRotation == o.toRotation &&
         fromTranslation == o.fromTranslation && toTranslation == o.toTranslation &&
         isFlipped == o.isFlipped;
}

template <typename S>
typename MotionOf<S>::Turn MotionOf<S>::turnOf(const Joint& joint, const Vec3d& origin) {
  auto to = joint.toRotation;
  if (joint.takesOtherSign()) {
    for (double& c : to) c = -c;
  }
  Turn turn;
  turn.parent = std::max(joint.parent, -1);
  turn.from = unit(quaternionOf<S>(joint.fromRotation));
  const Quaternion<S> relative = conjugate(turn.from) * unit(quaternionOf<S>(to));
  const S sine = norm(relative.vector());
  if (sine > S(1e-45)) {  // less is the rounding of fifty digits
    using std::atan2;
    turn.axis = (1 / sine) * relative.vector();
    turn.angle = 2 * atan2(sine, relative.w);
  }
  const auto from = joint.fromTranslation.as<S>();
  turn.translation = joint.parent < 0 ? from - origin.as<S>() : from;
  turn.drift = joint.toTranslation.as<S>() - from;
  return turn;
}

template <typename S>
MotionOf<S>::MotionOf(const std::vector<Joint>& joints, const Vec3d& origin) {
  turns_.reserve(joints.size());
  for (const Joint& joint : joints) {
    turns_.push_back(turnOf(joint, origin));
    addBounds(turns_.back());
  }
}

/// Norms of x' = x_p' + w_p x R_p o + R_p d and of its derivative, term by term.
template <typename S>
void MotionOf<S>::addBounds(const Turn& turn) {
  using std::max;
  const S roundUp = S(1) + S(1e-12);
  const MotionBounds<S> parent = turn.parent < 0 ? MotionBounds<S>{} : bounds(turn.parent);
  const S length = roundUp * max(norm(turn.translation), norm(turn.translation + turn.drift));
  const S drift = roundUp * norm(turn.drift), angle = roundUp * turn.angle;
  MotionBounds<S> b;
  b.angularSpeed = parent.angularSpeed + angle;
  b.angularAcceleration = parent.angularAcceleration + parent.angularSpeed * angle;
  b.speed = parent.speed + parent.angularSpeed * length + drift;
  b.acceleration =
      parent.acceleration +
      (parent.angularAcceleration + parent.angularSpeed * parent.angularSpeed) * length +
      2 * parent.angularSpeed * drift;
  b.reach = parent.reach + length;
  b.depth = parent.depth + 1;
  bounds_.push_back(b);
}

template <typename S>
Quaternion<S> MotionOf<S>::rotationAt(const Turn& turn, const S& t) {
  using std::cos;
  using std::sin;
  if (turn.angle == 0) return turn.from;
  const S half = turn.angle * t / 2;
  return turn.from * quaternion<S>(cos(half), sin(half) * turn.axis);
}

// Let x(t) be the point in a joint's frame, and y = T(t) + R(t) x its place in the parent's, with R
// turning at the constant rate w = angle * axis and T linear with rate d. Then
//   y'  = d + R (w x x + x'),                         |y'|  <= |d| + angle |x| + |x'|
//   y'' = R (w x (w x x) + 2 w x x' + x''),           |y''| <= angle^2 |x| + 2 angle |x'| + |x''|
// where |x| is at most its value at the span's middle plus halfSpan * sup |x'|.
template <typename S>
void MotionOf<S>::carry(Chain chain, MovingPointOf<S>* points, std::size_t count, const S& t,
                        const S& halfSpan) const {
  for (int j = chain.link; j != chain.above; j = parent(j)) {
    const Turn& turn = turns_[static_cast<std::size_t>(j)];
    const Quaternion<S> rotation = rotationAt(turn, t);
    const Vec3<S> spin = turn.angle * turn.axis;
    const S drift = norm(turn.drift);
    for (std::size_t i = 0; i < count; ++i) {
      MovingPointOf<S>& p = points[i];
      const S distance = norm(p.position) + halfSpan * p.speed;
      p.acceleration += turn.angle * (turn.angle * distance + 2 * p.speed);
      p.speed += drift + turn.angle * distance;
      p.velocity = turn.drift + rotate(rotation, cross(spin, p.position) + p.velocity);
      p.position = turn.translation + t * turn.drift + rotate(rotation, p.position);
    }
  }
}

template <typename S>
void MotionOf<S>::framesAt(const S& t, std::vector<MovingFrame<S>>& frames) const {
  frames.resize(turns_.size());
  for (std::size_t j = 0; j < turns_.size(); ++j) {
    const Turn& turn = turns_[j];
    const MovingFrame<S> parent =
        turn.parent < 0 ? MovingFrame<S>{} : frames[static_cast<std::size_t>(turn.parent)];
    const Vec3<S> arm = rotate(parent.q, turn.translation + t * turn.drift);
    MovingFrame<S>& frame = frames[j];
    frame.q = parent.q * rotationAt(turn, t);
    frame.p = parent.p + arm;
    frame.v = parent.v + cross(parent.w, arm) + rotate(parent.q, turn.drift);
    frame.w = parent.w + turn.angle * rotate(parent.q, rotate(turn.from, turn.axis));
  }
}

template <typename S>
S MotionOf<S>::reach(int link, S rho, int above) const {
  S sum = rho;
  for (int j = link; j != above; j = parent(j)) {
    const Turn& turn = turns_[static_cast<std::size_t>(j)];
    sum += std::max(norm(turn.translation), norm(turn.translation + turn.drift));
  }
  return sum;
}

template class MotionOf<Real>;
template class MotionOf<Precise>;

}  // namespace foretouch::oracle
