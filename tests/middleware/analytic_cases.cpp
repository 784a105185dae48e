#include "tests/middleware/analytic_cases.h"

#include <algorithm>
#include <cmath>

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

Quaternion aboutY(double angle) {
  return {std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle), 0.0};
}
Quaternion aboutZ(double angle) {
  return {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)};
}

/// A large triangle in the plane y = 0 that reaches 50 m around the origin.
Triangle floorTriangle() {
  return {{Vector3d(-50, 0, -50), Vector3d(150, 0, -50), Vector3d(-50, 0, 150)}};
}

/// The rod's reach and the radius of most cases.
struct Rod {
  double length, radius;
  explicit Rod(Random& random)
      : length(random.uniform(0.2, 1.2)),
        radius(random.chance(0.15) ? 0.0 : random.magnitude(1e-3, 0.1)) {}
  [[nodiscard]] Lss along(const Vector3d& axis) const {
    return {Vector3d::Zero(), length * axis, radius};
  }
};

}  // namespace

void AnalyticCase::place(Random& random) {
  placeRotation = random.rotation();
  if (random.chance(0.25)) {
    placeTranslation = 1e4 * random.direction();
  } else {
    placeTranslation = random.inBox(5.0);
  }
  guard = 1e-14 * (100.0 + placeTranslation.norm());
  const Eigen::Quaternion<long double> turn(placeRotation.w(), placeRotation.x(), placeRotation.y(),
                                            placeRotation.z());
  for (Triangle& triangle : triangles) {
    for (Vector3d& v : triangle.vertices) {
      const Eigen::Matrix<long double, 3, 1> placed =
          turn.normalized() * v.cast<long double>() + placeTranslation.cast<long double>();
      v = placed.cast<double>();
    }
  }
}

Avatar AnalyticCase::avatar() const {
  RawSkeleton raw;
  raw.joints.push_back({"place", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
  raw.joints.push_back({"rod", 0, Vector3d::Zero(), Quaternion::Identity()});
  return Avatar::build(Skeleton::build(raw).value(), {{}, {lss}}).value();
}

ChainMotion AnalyticCase::motion() const {
  const Pose from{{placeRotation, fromRotation}, {placeTranslation, fromTranslation}};
  const Pose to{{placeRotation, toRotation}, {placeTranslation, toTranslation}};
  return ChainMotion(avatar().skeleton(), from, to);
}

Scene AnalyticCase::scene() const {
  return Scene::build({triangles, std::vector<ObjectId>(triangles.size(), 0), {"thing"}}).value();
}

// A ball falls straight to the floor and stops somewhere above or below it.
AnalyticCase fallingSphere(Random& random) {
  AnalyticCase c;
  c.name = "falling sphere";
  const double r = random.chance(0.1) ? 0.0 : random.magnitude(1e-3, 0.5);
  const double from = r + random.magnitude(1e-2, 2.0);
  const double to = r + random.uniform(-1.0, 1.0);
  c.lss = {Vector3d::Zero(), Vector3d::Zero(), r};
  c.fromTranslation = Vector3d(0, from, 0);
  c.toTranslation = Vector3d(random.uniform(-1, 1), to, random.uniform(-1, 1));
  c.toRotation = random.rotation();
  c.triangles = {floorTriangle()};
  c.separationAt = [=](double t) { return std::max(0.0, from + t * (to - from)) - r; };
  if (to < r) c.impact = (from - r) / (from - to);
  return c;
}

// A rod turns about its base towards the floor: its tip's ball touches when L sin(w t) = h - r.
AnalyticCase rodToFloor(Random& random) {
  AnalyticCase c;
  c.name = "rod to floor";
  const Rod rod(random);
  const double angle = random.uniform(0.2, 1.5);
  const double height = rod.radius + rod.length * random.uniform(0.05, 1.2);
  c.lss = rod.along(Vector3d::UnitX());
  c.fromTranslation = c.toTranslation = Vector3d(0, height, 0);
  c.toRotation = aboutZ(-angle);
  c.triangles = {floorTriangle()};
  c.separationAt = [=](double t) {
    return std::max(0.0, height - rod.length * std::sin(angle * t)) - rod.radius;
  };
  const double sine = (height - rod.radius) / rod.length;
  if (sine < std::sin(angle)) c.impact = std::asin(sine) / angle;
  return c;
}

// A rod sweeps level towards an upright edge at distance rho and angle phi: it touches when
// rho sin(phi - w t) = r. The triangle lies behind the edge as the rod sees it.
AnalyticCase rodToEdge(Random& random) {
  AnalyticCase c;
  c.name = "rod to edge";
  const Rod rod(random);
  const double rho = rod.radius + (rod.length - rod.radius) * random.uniform(0.3, 0.95);
  const double phi = std::asin(rod.radius / rho) + random.uniform(0.05, 1.0);
  const double angle = random.uniform(0.1, 1.6);
  c.lss = rod.along(Vector3d::UnitX());
  c.toRotation = aboutY(-angle);  // x turns towards z
  const Vector3d foot(rho * std::cos(phi), 0, rho * std::sin(phi));
  const Vector3d behind = Vector3d(-std::sin(phi), 0, std::cos(phi)) * random.uniform(0.01, 0.5);
  const double up = random.uniform(0.3, 2.0);
  c.triangles = {{{foot + Vector3d(0, up, 0), foot - Vector3d(0, up, 0), foot + behind}}};
  c.separationAt = [=](double t) {
    const double open = phi - angle * t;
    return (open > 0.0 ? rho * std::sin(std::min(open, kPi / 2)) : 0.0) - rod.radius;
  };
  const double touch = (phi - std::asin(rod.radius / rho)) / angle;
  if (touch < 1.0) c.impact = touch;
  return c;
}

// The same towards a single vertex in the plane of the sweep.
AnalyticCase rodToVertex(Random& random) {
  AnalyticCase c = rodToEdge(random);
  c.name = "rod to vertex";
  Triangle& t = c.triangles[0];
  const Vector3d vertex = 0.5 * (t.vertices[0] + t.vertices[1]);
  const Vector3d behind = t.vertices[2] - vertex;
  const Vector3d up(0, random.uniform(0.01, 0.5), 0);
  t = {{vertex, vertex + behind + up, vertex + behind - up}};
  if (random.chance(0.3)) t.vertices[2] = t.vertices[1];           // a segment
  if (random.chance(0.2)) t.vertices[1] = t.vertices[2] = vertex;  // a point
  return c;
}

// A level rod falls flat on the floor: the closest points are not unique.
AnalyticCase parallelRod(Random& random) {
  AnalyticCase c = fallingSphere(random);
  c.name = "parallel rod";
  c.toRotation = Quaternion::Identity();
  c.lss.b = Vector3d(random.uniform(0.1, 1.0), 0, random.uniform(-0.5, 0.5));
  return c;
}

// A ball flies past a vertex at distance r + gap: a graze, by log-uniform gaps of both signs.
AnalyticCase passingSphere(Random& random) {
  AnalyticCase c;
  c.name = "passing sphere";
  const double r = random.magnitude(1e-3, 0.3);
  const double gap = random.magnitude(1e-9, 1e-1) * (random.chance(0.5) ? 1.0 : -1.0);
  const double closest = std::max(0.0, r + gap);
  const double span = random.uniform(1.0, 3.0), middle = random.uniform(0.3, 0.7);
  c.lss = {Vector3d::Zero(), Vector3d::Zero(), r};
  c.fromTranslation = Vector3d(-span * middle, closest, 0);
  c.toTranslation = Vector3d(span * (1.0 - middle), closest, 0);
  const Vector3d down(0, -random.uniform(0.1, 1.0), 0), side(0, 0, random.uniform(0.05, 0.5));
  c.triangles = {{{Vector3d::Zero(), down + side, down - side}}};
  c.separationAt = [=](double t) { return std::hypot(span * (t - middle), closest) - r; };
  if (closest < r) {
    c.impact = middle - std::sqrt((r - closest) * (r + closest)) / span;
    if (*c.impact < 0.0) {
      c.startsInContact = true;
      c.impact = 0.0;
    }
  }
  return c;
}

// Nothing moves; a third starts inside, a third within reach of the tolerance, a third outside.
AnalyticCase standingStill(Random& random) {
  AnalyticCase c;
  c.name = "standing still";
  const Rod rod(random);
  const double gap = random.chance(0.33) ? -random.uniform(0.0, 1.0) * rod.radius - 1e-6
                                         : random.magnitude(1e-6, 1.0);
  c.lss = rod.along(Vector3d::UnitY());
  c.fromTranslation = c.toTranslation = Vector3d(0, rod.radius + gap, 0);
  c.triangles = {floorTriangle()};
  c.startsInContact = gap <= 0.0;
  if (c.startsInContact) c.impact = 0.0;
  c.separationAt = [=](double) { return gap; };
  return c;
}

// A rod makes exactly half a turn between two upright edges at the same angle either way, so that
// the answer does not depend on which of the two equal arcs is taken.
AnalyticCase halfTurn(Random& random) {
  AnalyticCase c = rodToEdge(random);
  c.name = "half turn";
  const Triangle ahead = c.triangles[0];
  Triangle mirrored = ahead;
  for (Vector3d& v : mirrored.vertices) v.z() = -v.z();
  c.triangles = {ahead, mirrored};
  c.toRotation = random.chance(0.5) ? Quaternion(0, 0, 1, 0) : aboutY(-kPi);
  const Vector3d foot = 0.5 * (ahead.vertices[0] + ahead.vertices[1]);
  const double rho = foot.norm(), phi = std::atan2(foot.z(), foot.x()), r = c.lss.radius;
  c.separationAt = [=](double t) {
    const double open = phi - kPi * t;
    return (open > 0.0 ? rho * std::sin(std::min(open, kPi / 2)) : 0.0) - r;
  };
  c.impact = (phi - std::asin(r / rho)) / kPi;
  return c;
}

}  // namespace foretouch::test
