#include "tests/middleware/solid_world/together_judge.h"

#include <algorithm>
#include <sstream>

namespace foretouch::test {
namespace {

using oracle::Real;
using oracle::Vec3d;

oracle::Motion motionOf(const TogetherBody& body, const TogetherLeg& leg) {
  std::vector<oracle::Joint> joints(body.parents.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints[j].parent = body.parents[j];
    joints[j].fromRotation = leg.from.rotations[j];
    joints[j].toRotation = leg.to.rotations[j];
    joints[j].fromTranslation = leg.from.translations[j];
    joints[j].toTranslation = leg.to.translations[j];
  }
  return oracle::Motion(joints);
}

oracle::Box grown(oracle::Box box, double by) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= by;
    box.high[k] += by;
  }
  return box;
}

double distanceOf(const TogetherPart& one, const std::array<Vec3d, 3>& atOne,
                  const TogetherPart& other, const std::array<Vec3d, 3>& atOther) {
  if (one.count == 2) return oracle::closestPoints(atOne[0], atOne[1], atOther).distance;
  if (other.count == 2) return oracle::closestPoints(atOther[0], atOther[1], atOne).distance;
  return oracle::closestPoints(atOne, atOther).distance;
}

}  // namespace

void TogetherJudge::setOut() {
  motions_.resize(bodies.size());
  frames_.resize(bodies.size());
  placed_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    motions_[i].clear();
    for (const TogetherLeg& leg : bodies[i].legs) motions_[i].push_back(motionOf(bodies[i], leg));
  }
}

void TogetherJudge::placeBody(std::size_t i, std::int64_t us) {
  const TogetherBody& body = bodies[i];
  Placed& placed = placed_[i];
  placed.isThere = false;
  placed.corners.clear();
  placed.boxes.clear();
  placed.box = {};
  for (std::size_t k = 0; k < body.legs.size() && !placed.isThere; ++k) {
    const TogetherLeg& leg = body.legs[k];
    if (us < leg.beginUs || us > leg.endUs) continue;
    placed.isThere = true;
    motions_[i][k].framesAt(
        static_cast<Real>(us - leg.beginUs) / static_cast<Real>(leg.endUs - leg.beginUs),
        frames_[i]);
  }
  if (body.holder >= 0) {
    const auto holder = static_cast<std::size_t>(body.holder);
    placed.isThere = placed.isThere && placed_[holder].isThere;
    if (!placed.isThere) return;
    const Frame& hand = frames_[holder][static_cast<std::size_t>(body.holdingLink)];
    for (Frame& frame : frames_[i]) {
      frame.p = hand.at(frame.p);
      frame.q = hand.q * frame.q;
    }
  }
  if (!placed.isThere) return;
  for (const TogetherPart& part : body.parts) {
    const Frame& frame = frames_[i][static_cast<std::size_t>(part.link)];
    std::array<Vec3d, 3> corners;
    oracle::Box box;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto from = std::min(c, static_cast<std::size_t>(part.count - 1));
      corners[c] = frame.at(part.corners[from].as<Real>()).as<double>();
      box.add(corners[c]);
    }
    placed.corners.push_back(corners);
    placed.boxes.push_back(grown(box, part.radius));
    placed.box.add(placed.boxes.back());
  }
}

/// The solid avatar that the body is, or is held by; -1: none.
int TogetherJudge::solidOf(std::size_t body) const {
  if (bodies[body].isSolid) return static_cast<int>(body);
  if (bodies[body].holder < 0) return -1;
  return solidOf(static_cast<std::size_t>(bodies[body].holder));
}

void TogetherJudge::keep(std::size_t a, int b, double separation, TogetherReading& reading,
                         std::int64_t us) {
  reading.least = std::min(reading.least, separation);
  for (const int body : {static_cast<int>(a), b}) {
    const int solid = body < 0 ? -1 : solidOf(static_cast<std::size_t>(body));
    if (solid < 0) continue;
    double& own = reading.leastOf[static_cast<std::size_t>(solid)];
    own = std::min(own, separation);
  }
  if (separation > 0.0) return;
  std::ostringstream what;
  what << "bodies " << a << " and " << b << " at " << us << " us: " << separation << " m";
  reading.inside.push_back(what.str());
}

void TogetherJudge::readStill(std::size_t body, TogetherReading& reading, std::int64_t us) {
  const Placed& placed = placed_[body];
  double least = kFar;
  for (std::size_t k = 0; k < placed.corners.size(); ++k) {
    const TogetherPart& part = bodies[body].parts[k];
    double within = least;
    still_.visitNear(placed.boxes[k], within, [&](int id) {
      const oracle::Triangle& triangle = still_.triangle(id);
      TogetherPart other;
      other.count = 3;
      const double separation = distanceOf(part, placed.corners[k], other, triangle) - part.radius;
      least = std::min(least, separation);
      within = std::max(least, 1e-6);
    });
  }
  if (least < kFar) keep(body, -1, least, reading, us);
}

void TogetherJudge::readPair(std::size_t a, std::size_t b, TogetherReading& reading,
                             std::int64_t us) {
  const Placed &one = placed_[a], &other = placed_[b];
  double least = kFar;
  if (one.box.gap(other.box) >= least) return;
  for (std::size_t i = 0; i < one.corners.size(); ++i) {
    if (one.boxes[i].gap(other.box) >= least) continue;
    for (std::size_t k = 0; k < other.corners.size(); ++k) {
      if (one.boxes[i].gap(other.boxes[k]) >= least) continue;
      const TogetherPart &x = bodies[a].parts[i], &y = bodies[b].parts[k];
      least =
          std::min(least, distanceOf(x, one.corners[i], y, other.corners[k]) - x.radius - y.radius);
    }
  }
  if (least < kFar) keep(a, static_cast<int>(b), least, reading, us);
}

TogetherReading TogetherJudge::look(std::int64_t fromUs, std::int64_t toUs, int instants,
                                    const Excused& isExcused) {
  TogetherReading reading;
  reading.leastOf.assign(bodies.size(), std::numeric_limits<double>::infinity());
  setOut();
  for (int n = 0; n <= instants; ++n) {
    const std::int64_t us = fromUs + (toUs - fromUs) * n / instants;
    for (std::size_t i = 0; i < bodies.size(); ++i) placeBody(i, us);
    ++reading.instants;
    for (std::size_t a = 0; a < bodies.size(); ++a) {
      const int solidA = solidOf(a);
      if (!placed_[a].isThere) continue;
      if (solidA >= 0 && !isExcused(static_cast<int>(a), -1, us)) readStill(a, reading, us);
      for (std::size_t b = a + 1; b < bodies.size(); ++b) {
        const int solidB = solidOf(b);
        if (!placed_[b].isThere || (solidA < 0 && solidB < 0) || solidA == solidB) continue;
        if (!isExcused(static_cast<int>(a), static_cast<int>(b), us)) readPair(a, b, reading, us);
      }
    }
  }
  return reading;
}

}  // namespace foretouch::test
