#include "judge/world_judge.h"

#include <algorithm>
#include <cmath>

namespace foretouch::oracle {
namespace {

using Frame = MovingFrame<Real>;
constexpr int kMostSteps = 50'000;
constexpr Real kForever = 1e18L;

Joint jointOf(int parent, const OraclePlace& from, const OraclePlace& to) {
  Joint joint;
  joint.parent = parent;
  joint.fromRotation = from.rotation;
  joint.toRotation = to.rotation;
  joint.fromTranslation = from.translation;
  joint.toTranslation = to.translation;
  return joint;
}

Motion motionOf(const OracleBody& body, const OracleEpisode& episode, std::size_t from,
                std::size_t to) {
  std::vector<Joint> joints;
  for (std::size_t j = 0; j < body.parents.size(); ++j) {
    joints.push_back(jointOf(body.parents[j], episode.poses[from][j], episode.poses[to][j]));
  }
  return Motion(joints);
}

Corners<Real> cornersIn(const OraclePart& part, const Frame& frame) {
  Corners<Real> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t which = std::min(i, static_cast<std::size_t>(part.count - 1));
    corners[i] = frame.at(part.corners[which].as<Real>());
  }
  return corners;
}

/// A part in W, and a ball that holds its corners.
struct Placed {
  Corners<Real> corners;
  int count = 0;
  Vec3<Real> middle;
  Real reach = 0, radius = 0;
};

Placed placed(const OraclePart& part, const Frame& frame) {
  Placed in;
  in.corners = cornersIn(part, frame);
  in.middle = Real(1) / 3 * (in.corners[0] + in.corners[1] + in.corners[2]);
  for (const Vec3<Real>& corner : in.corners) {
    in.reach = std::max(in.reach, norm(corner - in.middle));
  }
  in.count = part.count;
  in.radius = static_cast<Real>(part.radius);
  return in;
}

std::vector<Placed> placedOf(const std::vector<OraclePart>& parts, int link, const Frame& frame) {
  std::vector<Placed> all;
  for (const OraclePart& part : parts) {
    if (part.link == link) all.push_back(placed(part, frame));
  }
  return all;
}

/// Their cores are at least so far apart, but for less than a nanometre of rounding.
Real apartAtLeast(const Placed& one, const Placed& other) {
  return norm(one.middle - other.middle) - one.reach - other.reach;
}

Triangle seenFrom(const Vec3<Real>& origin, const Corners<Real>& corners) {
  return {(corners[0] - origin).as<double>(), (corners[1] - origin).as<double>(),
          (corners[2] - origin).as<double>()};
}

/// The distance of their surfaces, in doubles from in between: off by much less than kRough (m) for
/// each metre that they are large or apart.
constexpr Real kRough = 1e-12L;
Real roughly(const Placed& one, const Placed& other) {
  const Triangle x = seenFrom(other.middle, one.corners), y = seenFrom(other.middle, other.corners);
  const double cores = one.count == 3 && other.count == 3 ? closestPoints(x, y).distance
                       : one.count == 3                   ? closestPoints(y[0], y[1], x).distance
                                                          : closestPoints(x[0], x[1], y).distance;
  return static_cast<Real>(cores) - one.radius - other.radius;
}

Real coreDistance(const Placed& one, const Placed& other) {
  if (one.count == 3 && other.count == 3) return closestPoints(one.corners, other.corners).distance;
  if (one.count == 3) return coreDistance(other, one);
  return closestPoints(one.corners[0], one.corners[1], other.corners).distance;
}

}  // namespace

OracleWorld::Moving OracleWorld::movingAt(int id, std::int64_t fromUs, Real us,
                                          bool isFromLeft) const {
  const std::vector<OracleEpisode>& episodes = body(id).episodes;
  const auto after = [&](std::int64_t instant) { return static_cast<Real>(instant - fromUs); };
  Moving moving;
  moving.untilUs = kForever;
  std::size_t e = 0;
  for (; e + 1 < episodes.size(); ++e) {
    const Real next = after(episodes[e + 1].beginUs);
    if (next > us || (isFromLeft && next == us)) {
      moving.untilUs = next;
      break;
    }
  }
  const OracleEpisode& episode = episodes[e];
  std::size_t k = 0;
  while (k + 1 < episode.times.size() && after(episode.times[k + 1]) <= us) ++k;
  const bool isLast = k + 1 == episode.times.size();
  const Motion motion = motionOf(body(id), episode, k, isLast ? k : k + 1);
  Real length = 1, t = 0;
  if (!isLast) {
    length = after(episode.times[k + 1]) - after(episode.times[k]);
    t = (us - after(episode.times[k])) / length;
    moving.untilUs = std::min(moving.untilUs, after(episode.times[k + 1]));
  }
  motion.framesAt(t, moving.frames);
  for (int j = 0; j < motion.numLinks(); ++j) {
    moving.speeds.push_back(
        {motion.bounds(j).speed / length, motion.bounds(j).angularSpeed / length});
  }
  if (episode.carrier < 0) return moving;
  const Moving carrier = movingAt(episode.carrier, fromUs, us, isFromLeft);
  const auto link = static_cast<std::size_t>(episode.link);
  for (int j = 0; j < motion.numLinks(); ++j) {
    Frame& frame = moving.frames[static_cast<std::size_t>(j)];
    frame.p = carrier.frames[link].at(frame.p);
    frame.q = carrier.frames[link].q * frame.q;
    Speed& speed = moving.speeds[static_cast<std::size_t>(j)];
    speed.ofOrigin +=
        carrier.speeds[link].ofOrigin + carrier.speeds[link].ofTurn * motion.reach(j, 0);
    speed.ofTurn += carrier.speeds[link].ofTurn;
  }
  moving.untilUs = std::min(moving.untilUs, carrier.untilUs);
  return moving;
}

Real OracleWorld::separation(int a, const Moving& atA, int linkOfA, int b, const Moving& atB,
                             int linkOfB) const {
  const auto of = [&](int id, const Moving& at, int link) {
    return placedOf(body(id).parts, link, at.frames[static_cast<std::size_t>(link)]);
  };
  const std::vector<Placed> ofA = of(a, atA, linkOfA), ofB = of(b, atB, linkOfB);
  // Parts that are farther apart change nothing: finds in doubles which may be the nearest.
  struct Near {
    const Placed *one, *other;
    Real least;
  };
  std::vector<Near> near;
  Real most = kForever;
  for (const Placed& one : ofA) {
    for (const Placed& other : ofB) {
      const Real balls = norm(one.middle - other.middle) + one.reach + other.reach;
      if (apartAtLeast(one, other) - one.radius - other.radius > most + kTouch) continue;
      const Real rough = roughly(one, other), slack = kRough * (balls + 1);
      most = std::min(most, rough + slack);
      near.push_back({&one, &other, rough - slack});
    }
  }
  Real least = kForever;
  for (const Near& pair : near) {
    if (pair.least > most) continue;
    const Real radii = pair.one->radius + pair.other->radius;
    least = std::min(least, coreDistance(*pair.one, *pair.other) - radii);
  }
  return least;
}

std::vector<OraclePart> OracleWorld::partsAt(int id, int link, std::int64_t fromUs, Real us) const {
  const Moving moving = movingAt(id, fromUs, us, false);
  std::vector<OraclePart> parts;
  for (OraclePart part : body(id).parts) {
    if (link >= 0 && part.link != link) continue;
    const Corners<Real> corners =
        cornersIn(part, moving.frames[static_cast<std::size_t>(part.link)]);
    for (std::size_t i = 0; i < 3; ++i) part.corners[i] = corners[i].as<double>();
    parts.push_back(part);
  }
  return parts;
}

MovingFrame<Real> OracleWorld::frameAt(int id, int link, std::int64_t fromUs, Real us,
                                       bool isFromLeft) const {
  return movingAt(id, fromUs, us, isFromLeft).frames[static_cast<std::size_t>(link)];
}

/// No corner of the link's parts is farther from its origin; below zero if it has none.
Real OracleWorld::reachOf(int id, int link) const {
  Real rho = -1;
  for (const OraclePart& part : body(id).parts) {
    if (part.link != link) continue;
    for (const Vec3d& corner : part.corners) rho = std::max(rho, norm(corner.as<Real>()));
  }
  return rho;
}

Real OracleWorld::speedOf(int id, const Moving& moving, int link) const {
  const Speed& speed = moving.speeds[static_cast<std::size_t>(link)];
  return speed.ofOrigin + speed.ofTurn * reachOf(id, link);
}

std::vector<bool> OracleWorld::mayTouch(int a, int b, std::int64_t fromUs,
                                        std::int64_t toUs) const {
  constexpr int kInstants = 200;
  const Real end = static_cast<Real>(toUs - fromUs);
  const std::size_t linksOfA = body(a).parents.size(), linksOfB = body(b).parents.size();
  std::vector<bool> may(linksOfA * linksOfB, false);
  for (Real us = 0; us < end;) {
    const Moving atA = movingAt(a, fromUs, us, false), atB = movingAt(b, fromUs, us, false);
    const Real next = std::min({us + end / kInstants, atA.untilUs, atB.untilUs, end});
    for (std::size_t i = 0; i < linksOfA; ++i) {
      const int one = static_cast<int>(i);
      const Real reach = reachOf(a, one);
      for (std::size_t j = 0; j < linksOfB && reach >= 0; ++j) {
        const int other = static_cast<int>(j);
        if (may[i * linksOfB + j] || reachOf(b, other) < 0) continue;
        ++pairInstants;
        const Real way = (speedOf(a, atA, one) + speedOf(b, atB, other)) * (next - us);
        const Real apart = norm(atA.frames[i].p - atB.frames[j].p) - reach - reachOf(b, other);
        constexpr Real kWidest = 0.3L;  // metres: no two radii are more
        if (apart > way + kWidest) continue;
        may[i * linksOfB + j] = !(separation(a, atA, one, b, atB, other) > way + kTouch);
      }
    }
    us = next;
  }
  return may;
}

Real OracleWorld::separationAt(int a, int linkOfA, int b, int linkOfB, std::int64_t fromUs,
                               Real us) const {
  return separation(a, movingAt(a, fromUs, us, false), linkOfA, b, movingAt(b, fromUs, us, false),
                    linkOfB);
}

std::vector<Real> OracleWorld::separationsAt(int a, int b, std::int64_t fromUs, Real us,
                                             bool isFromLeft, Real beyond) const {
  const Moving atA = movingAt(a, fromUs, us, isFromLeft);
  const Moving atB = a == b ? atA : movingAt(b, fromUs, us, isFromLeft);
  const std::size_t linksOfA = body(a).parents.size(), linksOfB = body(b).parents.size();
  std::vector<Real> separations(linksOfA * linksOfB, kForever);
  const std::vector<Ball> ballsOfA = ballsOf(a, atA), ballsOfB = ballsOf(b, atB);
  for (std::size_t i = 0; i < linksOfA; ++i) {
    const Ball& ofOne = ballsOfA[i];
    for (std::size_t j = 0; j < linksOfB && ofOne.radius >= 0; ++j) {
      const Ball& ofOther = ballsOfB[j];
      if (ofOther.radius < 0 || (a == b && i >= j)) continue;
      ++pairInstants;
      const Real apart = norm(ofOne.middle - ofOther.middle) - ofOne.radius - ofOther.radius;
      Real& least = separations[i * linksOfB + j];
      // A nanometre is far more than long doubles round by here.
      least = apart > beyond + kTouch
                  ? apart
                  : separation(a, atA, static_cast<int>(i), b, atB, static_cast<int>(j));
    }
  }
  return separations;
}

/// Per link, in W: a ball that holds all its parts. A radius below zero if it has none.
std::vector<OracleWorld::Ball> OracleWorld::ballsOf(int id, const Moving& moving) const {
  std::vector<Ball> balls(moving.frames.size());
  std::vector<int> counts(balls.size(), 0);
  for (const OraclePart& part : body(id).parts) {
    const auto link = static_cast<std::size_t>(part.link);
    for (const Vec3d& corner : part.corners) {
      balls[link].middle = balls[link].middle + corner.as<Real>();
      ++counts[link];
    }
  }
  for (std::size_t link = 0; link < balls.size(); ++link) {
    if (counts[link] > 0) balls[link].middle = Real(1) / counts[link] * balls[link].middle;
  }
  for (const OraclePart& part : body(id).parts) {
    Ball& ball = balls[static_cast<std::size_t>(part.link)];
    for (const Vec3d& corner : part.corners) {
      const Real reach = norm(corner.as<Real>() - ball.middle) + static_cast<Real>(part.radius);
      ball.radius = std::max(ball.radius, reach);
    }
  }
  for (std::size_t link = 0; link < balls.size(); ++link) {
    balls[link].middle = moving.frames[link].at(balls[link].middle);
  }
  return balls;
}

OracleTouch OracleWorld::firstTouch(int a, int linkOfA, int b, int linkOfB, std::int64_t fromUs,
                                    std::int64_t toUs) const {
  const Real end = static_cast<Real>(toUs - fromUs);
  Real us = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    // What changes at the window's end belongs to the next one.
    const Moving atA = movingAt(a, fromUs, us, us >= end), atB = movingAt(b, fromUs, us, us >= end);
    const Real gap = separation(a, atA, linkOfA, b, atB, linkOfB);
    ++pairInstants;
    if (gap <= kTouch) return {OracleOutcome::Touch, us};
    if (us >= end) return {OracleOutcome::Free, end};
    const Real speed = speedOf(a, atA, linkOfA) + speedOf(b, atB, linkOfB);
    // A thousandth of what a touch is, for rounding.
    const Real safe = (gap - kTouch * Real(1e-3L)) / (speed + Real(1e-30L));
    us = std::min({us + safe, atA.untilUs, atB.untilUs, end});
  }
  return {OracleOutcome::Uncertain, us};
}

Real OracleWorld::distanceToSurface(int id, int link, const Vec3d& p_W, std::int64_t fromUs,
                                    Real us) const {
  const Moving at = movingAt(id, fromUs, us, false);
  OraclePart part;
  part.corners = {p_W, p_W, p_W};
  const Placed point = placed(part, Frame());
  Real least = kForever;
  for (const Placed& one :
       placedOf(body(id).parts, link, at.frames[static_cast<std::size_t>(link)])) {
    if (apartAtLeast(one, point) - one.radius > least + kTouch) continue;
    least = std::min(least, std::abs(coreDistance(one, point) - one.radius));
  }
  return least;
}

}  // namespace foretouch::oracle
