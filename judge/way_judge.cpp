// judge/way_judge.cpp: all instants first, then one search of the tree per capsule over all of
// them. From a pair's distance at one instant follows for how many more it cannot be the nearest.
#include "judge/way_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "judge/distance.h"
#include "judge/quaternion.h"

namespace foretouch::oracle {
namespace {

using Four = std::array<double, 4>;

Four unitOf(const Four& q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

/// By the difference, which is accurate for near and far quaternions alike.
double angleBetween(const Four& a, const Four& b) {
  double less = 0.0, more = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    less += (a[i] - b[i]) * (a[i] - b[i]);
    more += (a[i] + b[i]) * (a[i] + b[i]);
  }
  return 2.0 * std::atan2(std::sqrt(less), std::sqrt(more));
}

Quaternion<double> asQuaternion(const Four& q) {
  return {q[0], q[1], q[2], q[3]};
}

/// Instants that a piece is first looked at, to see how far it moves.
constexpr int kFirstLooks = 9;

}  // namespace

WayJudge::WayJudge(const Scene& scene, WayBody body) : scene_(scene), body_(std::move(body)) {
  std::vector<std::size_t> first;
  for (std::size_t link = 0; link < body_.capsules.size(); ++link) {
    first.push_back(capsules_.size());
    for (const Capsule& capsule : body_.capsules[link]) {
      capsules_.push_back(capsule);
      linkOf_.push_back(static_cast<int>(link));
    }
  }
  first.push_back(capsules_.size());
  for (const auto& [a, b] : body_.ownPairs) {
    const auto one = static_cast<std::size_t>(a), other = static_cast<std::size_t>(b);
    for (std::size_t i = first[one]; i < first[one + 1]; ++i) {
      for (std::size_t k = first[other]; k < first[other + 1]; ++k) ownCapsules_.push_back({i, k});
    }
  }
  arcs_.resize(body_.parents.size());
  frames_.resize(body_.parents.size());
}

void WayJudge::setOut(const PlainPose& from, const PlainPose& to) {
  for (std::size_t j = 0; j < arcs_.size(); ++j) {
    Arc& arc = arcs_[j];
    const Four &p = from.rotations[j], &q = to.rotations[j];
    // The sign as the motion is defined: of the given doubles, in the order w, x, y, z.
    const bool flips = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3] < 0.0;
    arc.from = unitOf(p);
    arc.to = unitOf(q);
    if (flips) {
      for (double& x : arc.to) x = -x;
    }
    arc.angle = angleBetween(arc.from, arc.to);
    arc.sine = std::sin(arc.angle);
    arc.translation = from.translations[j];
    arc.drift = to.translations[j] - from.translations[j];
  }
}

void WayJudge::placeAt(double t, Axis* axes) {
  // Below it the sine weights are 1 - t and t to rounding.
  constexpr double kTinyAngle = 1e-8;
  for (std::size_t j = 0; j < arcs_.size(); ++j) {
    const Arc& arc = arcs_[j];
    const bool isTiny = arc.angle < kTinyAngle;
    const double a = isTiny ? 1.0 - t : std::sin((1.0 - t) * arc.angle) / arc.sine;
    const double b = isTiny ? t : std::sin(t * arc.angle) / arc.sine;
    Four q{};
    for (std::size_t i = 0; i < 4; ++i) q[i] = a * arc.from[i] + b * arc.to[i];
    q = unitOf(q);
    const Vec3d p = arc.translation + t * arc.drift;
    Frame& frame = frames_[j];
    if (body_.parents[j] < 0) {
      frame = {q, p};
      continue;
    }
    const Frame& above = frames_[static_cast<std::size_t>(body_.parents[j])];
    const Quaternion<double> turn = asQuaternion(above.q);
    const Quaternion<double> whole = turn * asQuaternion(q);
    frame = {{whole.w, whole.x, whole.y, whole.z}, above.p + rotate(turn, p)};
  }
  for (std::size_t c = 0; c < capsules_.size(); ++c) {
    const Frame& frame = frames_[static_cast<std::size_t>(linkOf_[c])];
    const Quaternion<double> turn = asQuaternion(unitOf(frame.q));
    for (std::size_t end = 0; end < 2; ++end) {
      axes[c][end] = frame.p + rotate(turn, capsules_[c].ends[end]);
    }
  }
}

double WayJudge::moved(std::size_t capsule, int from, int to) const {
  const Axis &p = axis(capsule, from), &q = axis(capsule, to);
  return std::max(norm(q[0] - p[0]), norm(q[1] - p[1]));
}

int WayJudge::instantsFor(const WayLooks& looks) {
  axes_.resize(static_cast<std::size_t>(std::max(looks.instants, kFirstLooks)) * capsules_.size());
  for (int i = 0; i < kFirstLooks; ++i) {
    placeAt(static_cast<double>(i) / (kFirstLooks - 1),
            &axes_[static_cast<std::size_t>(i) * capsules_.size()]);
  }
  double longest = 0.0;
  for (std::size_t c = 0; c < capsules_.size(); ++c) {
    double length = 0.0;
    for (int i = 1; i < kFirstLooks; ++i) length += moved(c, i - 1, i);
    longest = std::max(longest, length);
  }
  const double asked = std::ceil(longest / looks.spacing) + 1.0;
  return std::max({2, looks.instants, static_cast<int>(std::min<double>(asked, WayLooks::kMost))});
}

Box WayJudge::boxOver(std::size_t capsule, int instants) const {
  Box box;
  for (int i = 0; i < instants; ++i) {
    for (const Vec3d& end : axis(capsule, i)) box.add(end);
  }
  return box;
}

/// Visits instants in order, but leaves out those at which the pair must be farther than the least
/// so far: its distance changes by at most the way of the axes' ends, of which every point of an
/// axis is a mean.
template <typename Distance, typename Stray>
bool WayJudge::walk(int instants, double radius, WayReading& reading, const Distance& distance,
                    const Stray& stray) {
  // Of coordinates within kilometres.
  constexpr double kRounding = 1e-11;
  bool isNearer = false;
  for (int i = 0; i < instants;) {
    const double separation = distance(i) - radius;
    if (separation < reading.least) {
      reading.least = separation;
      reading.t = instants > 1 ? static_cast<double>(i) / (instants - 1) : 0.0;
      isNearer = true;
    }
    int next = i + 1;
    while (next < instants && separation - stray(i, next) - kRounding > reading.least) ++next;
    i = next;
  }
  return isNearer;
}

void WayJudge::readScene(std::size_t capsule, int instants, WayReading& reading) {
  const double radius = capsules_[capsule].radius;
  double within = reading.least + radius;
  scene_.visitNear(boxOver(capsule, instants), within, [&](int id) {
    const Triangle& triangle = scene_.triangle(id);
    const bool isNearer = walk(
        instants, radius, reading,
        [&](int i) {
          const Axis& at = axis(capsule, i);
          return closestPoints(at[0], at[1], triangle).distance;
        },
        [&](int from, int to) { return moved(capsule, from, to); });
    if (!isNearer) return;
    reading.link = linkOf_[capsule];
    reading.triangle = id;
    reading.other = -1;
    within = reading.least + radius;
  });
}

void WayJudge::readOwn(std::size_t a, std::size_t b, int instants, WayReading& reading) {
  const double radius = capsules_[a].radius + capsules_[b].radius;
  if (boxOver(a, instants).gap(boxOver(b, instants)) - radius > reading.least) return;
  const bool isNearer = walk(
      instants, radius, reading,
      [&](int i) {
        const Axis &one = axis(a, i), &other = axis(b, i);
        return closestPoints(one[0], one[1], Triangle{other[0], other[1], other[1]}).distance;
      },
      [&](int from, int to) { return moved(a, from, to) + moved(b, from, to); });
  if (!isNearer) return;
  reading.link = linkOf_[a];
  reading.other = linkOf_[b];
  reading.triangle = -1;
}

void WayJudge::read(int instants, WayReading& reading) {
  axes_.resize(static_cast<std::size_t>(instants) * capsules_.size());
  for (int i = 0; i < instants; ++i) {
    placeAt(instants > 1 ? static_cast<double>(i) / (instants - 1) : 0.0,
            &axes_[static_cast<std::size_t>(i) * capsules_.size()]);
  }
  reading.instants += static_cast<std::uint64_t>(instants);
  for (std::size_t c = 0; c < capsules_.size(); ++c) readScene(c, instants, reading);
  for (const auto& [a, b] : ownCapsules_) readOwn(a, b, instants, reading);
}

WayReading WayJudge::along(const PlainPose& from, const PlainPose& to, double cutoff,
                           const WayLooks& looks) {
  WayReading reading;
  reading.least = cutoff;
  setOut(from, to);
  read(instantsFor(looks), reading);
  return reading;
}

WayReading WayJudge::at(const PlainPose& pose, double cutoff) {
  WayReading reading;
  reading.least = cutoff;
  setOut(pose, pose);
  read(1, reading);
  return reading;
}

const std::vector<std::array<Vec3d, 2>>& WayJudge::endsAt(const PlainPose& pose) {
  setOut(pose, pose);
  axes_.resize(capsules_.size());
  placeAt(0.0, axes_.data());
  return axes_;
}

}  // namespace foretouch::oracle
