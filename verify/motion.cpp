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

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

Vector madeUnit(const Point& axis) {
  const Vector v = exactly(axis);
  const Interval norm = length(v);
  Vector result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = within(v[i] / norm, -1.0, 1.0);
  return result;
}

/// The rotation by an angle about a unit axis. Half of the angle is halved until it is at most an
/// eighth. There sine and cosine are their series up to x^12; by Taylor the rest is below |x|^13 /
/// 13!. Doubling the angle again takes only sums and products.
Quaternion turned(const Vector& axis, const Interval& angle) {
  int halvings = 1;
  while (std::max(std::abs(angle.lo), std::abs(angle.hi)) > std::ldexp(0.125, halvings)) ++halvings;
  const Interval x = Interval(std::ldexp(1.0, -halvings)) * angle, square2 = square(x);
  constexpr double kRest = 0x1p-39 / 6227020800.0;
  const Interval one(1.0);
  Interval sine = one, cosine = one;  // Horner's way, from the end
  for (int k = 12; k >= 2; k -= 2) {
    cosine = one - square2 * cosine / Interval(k * (k - 1.0));
    if (k <= 10) sine = one - square2 * sine / Interval(k * (k + 1.0));
  }
  sine = x * sine + Interval(-2.0 * kRest, 2.0 * kRest);
  cosine = cosine + Interval(-2.0 * kRest, 2.0 * kRest);
  for (int i = 1; i < halvings; ++i) {
    const Interval twice = Interval(2.0) * sine * cosine;
    cosine = within(one - Interval(2.0) * square(sine), -1.0, 1.0);
    sine = within(twice, -1.0, 1.0);
  }
  return {cosine, sine * axis[0], sine * axis[1], sine * axis[2]};
}

/// What lies at `own` in a frame that lies at `above`.
LinkPlace under(const LinkPlace& above, const LinkPlace& own) {
  return {above.rotation * own.rotation, above.origin + above.rotation * own.origin};
}

/// The number that moves a joint, at one end.
Interval valueOf(const Drive& drive, const std::vector<double>& q) {
  return Interval(drive.factor) * Interval(q[drive.coordinate]) + Interval(drive.offset);
}
/// How much that number changes along the edge.
Interval changeOf(const Drive& drive, const Edge& edge) {
  return Interval(drive.factor) *
         (Interval(edge.to[drive.coordinate]) - Interval(edge.from[drive.coordinate]));
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

    joint.most = turnOf(joint);
    add(std::move(joint));
  }
}

Motion::Motion(const std::vector<Link>& links, const EdgeStatement& statement, const Edge& edge,
               std::size_t mostWork)
    : links_(links), isOnEdge_(true), mostWork_(mostWork) {
  for (std::size_t i = 0; i < links.size(); ++i) {
    const DrivenJoint& driven = statement.joints[i];
    Joint joint;
    for (std::size_t k = 0; k < 4; ++k) joint.from[k] = links[i].rotation[k];
    joint.from = joint.to = unit(joint.from);
    joint.start = exactly(links[i].offset);
    for (const Drive& shift : driven.shifts) {
      const Vector along = rotation(joint.from) * madeUnit(shift.axis);
      joint.start = joint.start + valueOf(shift, edge.from) * along;
      joint.drift = joint.drift + changeOf(shift, edge) * along;
    }
    if (driven.turn) {
      const Interval by = changeOf(*driven.turn, edge);
      joint.turn = Turn{madeUnit(driven.turn->axis), valueOf(*driven.turn, edge.from), by};
      joint.most = std::max(std::abs(by.lo), std::abs(by.hi));
    }
    add(std::move(joint));
  }
}

void Motion::add(Joint joint) {
  const int parent = links_[joints_.size()].parent;
  fastest_.push_back(
      below(parent < 0 ? Bound{} : fastest_[static_cast<std::size_t>(parent)], joint));
  joints_.push_back(std::move(joint));
}

/// The bound of what moves with the joint, from that of what carries it.
Motion::Bound Motion::below(const Bound& above, const Joint& joint) {
  const double arm = std::max(length(joint.start).hi, length(joint.start + joint.drift).hi);
  const Interval s(above.turns);
  return {up(above.turns + joint.most),
          (Interval(above.origin) + s * s * Interval(arm) + Interval(2.0) * s * length(joint.drift))
              .hi};
}

Motion::Bound Motion::boundIn(int carrier, std::size_t link) const {
  std::vector<std::size_t> chain;
  for (auto i = static_cast<int>(link); i != carrier; i = links_[chain.back()].parent) {
    chain.push_back(static_cast<std::size_t>(i));
  }
  Bound bound;
  for (auto i = chain.rbegin(); i != chain.rend(); ++i) bound = below(bound, joints_[*i]);
  return bound;
}

int Motion::carrierOf(std::size_t a, std::size_t b) const {
  auto i = static_cast<int>(a), j = static_cast<int>(b);  // parents stand before their children
  while (i != j) {
    int& later = i > j ? i : j;
    later = links_[static_cast<std::size_t>(later)].parent;
  }
  return i;
}

void Motion::spend(std::size_t work) {
  work_ += work;
  if (work_ > mostWork_) throw std::runtime_error("the claims ask for too many places");
}

/// At least the angle: a chord of length c between unit quaternions means a rotation by
/// 4 asin(c / 2), asin(x) <= x / sqrt(1 - x^2), and a turn is sixteen times its sixteenth.
double Motion::turnOf(const Joint& joint) const {
  const Quaternion piece = rotationAt(joint, kChordLevel, 1);
  Interval chord;
  for (std::size_t k = 0; k < 4; ++k) chord = chord + square(piece[k] - joint.from[k]);
  const Interval half = Interval(0.5) * root(chord);
  const Interval sine(half.hi);
  const Interval angle = sine / root(Interval(1.0) - sine * sine);
  return (Interval(4.0 * (1 << kChordLevel)) * angle).hi;
}

Quaternion Motion::rotationAt(const Joint& joint, int level, std::int64_t index) const {
  if (isOnEdge_) {
    if (!joint.turn) return joint.from;
    const Interval t(std::ldexp(static_cast<double>(index), -level));
    return product(joint.from, turned(joint.turn->axis, joint.turn->angle + t * joint.turn->by));
  }
  Quaternion a = joint.from, b = joint.to;
  if (index >> level != 0) return b;
  for (int bit = level - 1; bit >= 0; --bit) {
    const Quaternion half = middle(a, b);
    ((index >> bit) & 1) != 0 ? a = half : b = half;
  }
  return a;
}

/// A turn of an edge costs as much as three halvings, at any instant.
std::size_t Motion::workAt(int level) const {
  return isOnEdge_ ? 3 : static_cast<std::size_t>(level + 1);
}

/// Some 32 MB.
std::size_t Motion::mostInstants() const {
  constexpr std::size_t kMostKept = (std::size_t{32} << 20) / sizeof(LinkPlace);
  return std::max<std::size_t>(2, kMostKept / std::max<std::size_t>(1, links_.size()));
}

/// The joint's place in its parent's frame. Exact in t: its numbers are below 2^41.
LinkPlace Motion::placeOf(const Joint& joint, int level, std::int64_t index) const {
  const Interval t(std::ldexp(static_cast<double>(index), -level));
  return {rotation(rotationAt(joint, level, index)), joint.start + t * joint.drift};
}

const LinkPlace& Motion::at(int level, std::int64_t index, std::size_t link) {
  while (level > 0 && index % 2 == 0) {
    --level;
    index /= 2;
  }
  if (known_.size() >= mostInstants() && known_.count({level, index}) == 0) known_.clear();
  Places& places = known_[{level, index}];
  if (places.empty()) places.resize(links_.size());
  std::vector<std::size_t> chain;  // up to the first that is known
  for (auto i = static_cast<int>(link); i >= 0 && !places[static_cast<std::size_t>(i)];) {
    chain.push_back(static_cast<std::size_t>(i));
    i = links_[static_cast<std::size_t>(i)].parent;
  }
  spend(chain.size() * workAt(level));
  for (auto i = chain.rbegin(); i != chain.rend(); ++i) {
    const LinkPlace own = placeOf(joints_[*i], level, index);
    const int above = links_[*i].parent;
    places[*i] = above < 0 ? own : under(*places[static_cast<std::size_t>(above)], own);
  }
  return *places[link];
}

LinkPlace Motion::in(int carrier, int level, std::int64_t index, std::size_t link) {
  LinkPlace place;
  for (std::size_t k = 0; k < 3; ++k) place.rotation[k][k] = Interval(1.0);
  std::size_t depth = 0;
  for (auto i = static_cast<int>(link); i != carrier; ++depth) {
    const auto own = static_cast<std::size_t>(i);
    place = under(placeOf(joints_[own], level, index), place);
    i = links_[own].parent;
  }
  spend(depth * workAt(level));
  return place;
}

}  // namespace verify
