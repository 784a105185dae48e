#include "verify/motion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace verify {
namespace {

/// Halvings before a chord is measured: its half angle is then below pi/32, and the bound on it by
/// its sine within a fiftieth of it.
constexpr int kChordLevel = 4;

Quaternion negative(const Quaternion& q) {
  return {-q[0], -q[1], -q[2], -q[3]};
}

Quaternion middle(const Quaternion& a, const Quaternion& b) {
  return unit({a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]});
}

double norm(const std::array<double, 4>& q) {
  return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

}  // namespace

Motion::Motion(const std::vector<Link>& links, const Step& step, std::size_t mostWork)
    : links_(links), mostWork_(mostWork) {
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto& a = step.from[i].rotation;
    const auto& b = step.to[i].rotation;
    // Made unit, they are the same within rounding: 0.001 is what an avatar file may be off.
    if (std::abs(norm(a) - 1.0) > 1e-3 || std::abs(norm(b) - 1.0) > 1e-3) {
      fault_ = "joint " + std::to_string(i) + ": expected unit quaternions";
      return;
    }
    Joint joint;
    for (std::size_t k = 0; k < 4; ++k) {
      joint.from[k] = a[k];
      joint.to[k] = b[k];
    }
    joint.from = unit(joint.from);
    joint.to = unit(joint.to);
    // The shorter arc is by definition that of the sign that doubles compute, in this order.
    const double sign = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    if (std::abs(sign) < 1e-12) {
      fault_ = "joint " + std::to_string(i) + ": half a turn: which way is a matter of rounding";
      return;
    }
    if (sign < 0.0) joint.to = negative(joint.to);
    joint.start = exactly(step.from[i].translation);
    joint.drift = exactly(step.to[i].translation) + Interval(-1.0) * joint.start;

    const int parent = links[i].parent;
    const bool isRoot = parent < 0;
    const double above = isRoot ? 0.0 : turns_[static_cast<std::size_t>(parent)];
    const double before = isRoot ? 0.0 : accelerations_[static_cast<std::size_t>(parent)];
    const double arm = std::max(length(joint.start).hi, length(joint.start + joint.drift).hi);
    turns_.push_back(up(above + turnOf(joint)));
    const Interval s(above);
    accelerations_.push_back(
        (Interval(before) + s * s * Interval(arm) + Interval(2.0) * s * length(joint.drift)).hi);
    joints_.push_back(joint);
  }
}

/// At least the angle: of a chord of length c between unit quaternions the rotation is by
/// 4 asin(c / 2), asin(x) <= x / sqrt(1 - x^2), and a turn is sixteen times its sixteenth.
double Motion::turnOf(const Joint& joint) {
  const Quaternion piece = rotationAt(joint, kChordLevel, 1);
  Interval chord;
  for (std::size_t k = 0; k < 4; ++k) chord = chord + square(piece[k] - joint.from[k]);
  const Interval half = Interval(0.5) * root(chord);
  const Interval sine(half.hi);
  const Interval angle = sine / root(Interval(1.0) - sine * sine);
  return (Interval(4.0 * (1 << kChordLevel)) * angle).hi;
}

Quaternion Motion::rotationAt(const Joint& joint, int level, std::int64_t index) {
  Quaternion a = joint.from, b = joint.to;
  if (index >> level != 0) return b;
  for (int bit = level - 1; bit >= 0; --bit) {
    const Quaternion half = middle(a, b);
    ((index >> bit) & 1) != 0 ? a = half : b = half;
  }
  return a;
}

/// Some 32 MB.
std::size_t Motion::mostInstants() const {
  constexpr std::size_t kMostKept = (std::size_t{32} << 20) / sizeof(LinkPlace);
  return std::max<std::size_t>(2, kMostKept / std::max<std::size_t>(1, links_.size()));
}

const LinkPlace& Motion::at(int level, std::int64_t index, std::size_t link) {
  while (level > 0 && index % 2 == 0) {
    --level;
    index /= 2;
  }
  if (known_.size() >= mostInstants() && known_.count({level, index}) == 0) known_.clear();
  Places& places = known_[{level, index}];
  if (places.empty()) places.resize(links_.size());
  const Interval t(std::ldexp(static_cast<double>(index), -level));  // exact: below 2^41
  std::vector<std::size_t> chain;  // up to the first that is known
  for (auto i = static_cast<int>(link); i >= 0 && !places[static_cast<std::size_t>(i)];) {
    chain.push_back(static_cast<std::size_t>(i));
    i = links_[static_cast<std::size_t>(i)].parent;
  }
  work_ += chain.size() * static_cast<std::size_t>(level + 1);
  if (work_ > mostWork_) throw std::runtime_error("the claims ask for too many places");
  for (auto i = chain.rbegin(); i != chain.rend(); ++i) {
    const Joint& joint = joints_[*i];
    const Matrix turned = rotation(rotationAt(joint, level, index));
    const Vector moved = joint.start + t * joint.drift;
    const int above = links_[*i].parent;
    if (above < 0) {
      places[*i] = LinkPlace{turned, moved};
      continue;
    }
    const LinkPlace& parent = *places[static_cast<std::size_t>(above)];
    places[*i] = LinkPlace{parent.rotation * turned, parent.origin + parent.rotation * moved};
  }
  return *places[link];
}

double Motion::acceleration(std::size_t link, double distance) const {
  const Interval s(turns_[link]);
  return (Interval(accelerations_[link]) + s * s * Interval(distance)).hi;
}

}  // namespace verify
