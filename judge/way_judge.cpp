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

/// The rounding of coordinates within kilometres, and of the sums of ways.
constexpr double kRounding = 1e-10;
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
    arc.translation = from.translations[j];
    arc.drift = to.translations[j] - from.translations[j];
  }
}

void WayJudge::weigh(int steps) {
  // Below it the sine weights are 1 - t and t to rounding.
  constexpr double kTinyAngle = 1e-8;
  const auto perJoint = static_cast<std::size_t>(steps) + 1;
  weights_.resize(arcs_.size() * perJoint);
  for (std::size_t j = 0; j < arcs_.size(); ++j) {
    const Arc& arc = arcs_[j];
    const double sine = std::sin(arc.angle);
    for (std::size_t i = 0; i < perJoint; ++i) {
      const double t = static_cast<double>(i) / steps;
      weights_[j * perJoint + i] = arc.angle < kTinyAngle ? t : std::sin(t * arc.angle) / sine;
    }
  }
}

void WayJudge::placeAt(int step, int steps, Axis* axes) {
  const double t = static_cast<double>(step) / steps;
  for (std::size_t j = 0; j < arcs_.size(); ++j) {
    const Arc& arc = arcs_[j];
    const double* weights = &weights_[j * (static_cast<std::size_t>(steps) + 1)];
    const double a = weights[steps - step], b = weights[step];
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

void WayJudge::place(int instants) {
  const int steps = std::max(1, instants - 1);
  weigh(steps);
  axes_.resize(static_cast<std::size_t>(instants) * capsules_.size());
  for (int i = 0; i < instants; ++i) {
    placeAt(i, steps, &axes_[static_cast<std::size_t>(i) * capsules_.size()]);
  }
  measureStray(instants);
}

void WayJudge::measureStray(int instants) {
  const std::size_t count = capsules_.size();
  strayed_.resize(static_cast<std::size_t>(instants) * count);
  std::fill_n(strayed_.begin(), count, 0.0);
  for (int i = 1; i < instants; ++i) {
    for (std::size_t c = 0; c < count; ++c) {
      const Axis &p = axis(c, i - 1), &q = axis(c, i);
      const std::size_t at = static_cast<std::size_t>(i) * count + c;
      strayed_[at] = strayed_[at - count] + std::max(norm(q[0] - p[0]), norm(q[1] - p[1]));
    }
  }
}

int WayJudge::instantsFor(const WayLooks& looks) {
  place(kFirstLooks);
  double longest = 0.0;
  for (std::size_t c = 0; c < capsules_.size(); ++c) {
    longest = std::max(longest, strayed(c, 0, kFirstLooks - 1));
  }
  const double asked = std::ceil(longest / looks.spacing) + 1.0;
  return std::max({2, looks.instants, static_cast<int>(std::min<double>(asked, WayLooks::kMost))});
}

void WayJudge::boxAll(int instants) {
  boxes_.assign(capsules_.size(), Box{});
  for (int i = 0; i < instants; ++i) {
    for (std::size_t c = 0; c < boxes_.size(); ++c) {
      for (const Vec3d& end : axis(c, i)) boxes_[c].add(end);
    }
  }
}

/// Visits instants in order, but leaves out those at which the pair must be farther than the least
/// so far: its distance changes by at most the way of the axes' ends, of which every point of an
/// axis is a mean. `stray(from, to)` bounds it, and grows with `to`.
template <typename Distance, typename Stray>
bool WayJudge::walk(int instants, double radius, WayReading& reading, const Distance& distance,
                    const Stray& stray) {
  bool isNearer = false;
  for (int i = 0; i < instants;) {
    const double separation = distance(i) - radius;
    if (separation < reading.least) {
      reading.least = separation;
      reading.t = instants > 1 ? static_cast<double>(i) / (instants - 1) : 0.0;
      isNearer = true;
    }
    const double spare = separation - kRounding - reading.least;
    int last = i, next = instants;  // the first instant beyond the spare is in (last, next]
    while (next - last > 1) {
      const int middle = last + (next - last) / 2;
      (stray(i, middle) < spare ? last : next) = middle;
    }
    i = next;
  }
  return isNearer;
}

bool WayJudge::readTriangle(std::size_t capsule, int id, int instants, WayReading& reading) {
  const double radius = capsules_[capsule].radius;
  const Triangle& triangle = scene_.triangle(id);
  const Scene::Ball& ball = scene_.ballOf(id);
  const Axis& first = axis(capsule, 0);
  const double apart =
      pointSegmentDistance(ball.center, first[0], first[1]) - ball.radius - radius - kRounding;
  if (apart - strayed(capsule, 0, instants - 1) > reading.least) return false;
  const bool isNearer = walk(
      instants, radius, reading,
      [&](int i) {
        const Axis& at = axis(capsule, i);
        return closestPoints(at[0], at[1], triangle).distance;
      },
      [&](int from, int to) { return strayed(capsule, from, to); });
  if (!isNearer) return false;
  reading.link = linkOf_[capsule];
  reading.triangle = id;
  reading.other = -1;
  last_ = {capsule, id};
  return true;
}

void WayJudge::readScene(std::size_t capsule, int instants, WayReading& reading) {
  const double radius = capsules_[capsule].radius;
  double within = reading.least + radius;
  scene_.visitNear(boxes_[capsule], within, [&](int id) {
    if (readTriangle(capsule, id, instants, reading)) within = reading.least + radius;
  });
}

void WayJudge::readOwn(std::size_t a, std::size_t b, int instants, WayReading& reading) {
  const double radius = capsules_[a].radius + capsules_[b].radius;
  if (boxes_[a].gap(boxes_[b]) - radius > reading.least) return;
  const bool isNearer = walk(
      instants, radius, reading,
      [&](int i) {
        const Axis &one = axis(a, i), &other = axis(b, i);
        return closestPoints(one[0], one[1], Triangle{other[0], other[1], other[1]}).distance;
      },
      [&](int from, int to) { return strayed(a, from, to) + strayed(b, from, to); });
  if (!isNearer) return;
  reading.link = linkOf_[a];
  reading.other = linkOf_[b];
  reading.triangle = -1;
}

void WayJudge::read(int instants, WayReading& reading) {
  place(instants);
  boxAll(instants);
  reading.instants += static_cast<std::uint64_t>(instants);
  // What was nearest last is near now, most often: beside it few others need a look.
  const WayNearest last = last_;
  if (last.triangle >= 0) readTriangle(last.capsule, last.triangle, instants, reading);
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
  place(1);
  return axes_;
}

}  // namespace foretouch::oracle
