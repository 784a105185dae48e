#include "bench/extremes/extreme_case.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "articulated/motion.h"

namespace foretouch::tools::extremes {

using Eigen::Vector3d;

void ExtremeCase::add(const Triangle& triangle) {
  if (scene.objectNames.empty()) scene.objectNames.emplace_back("thing");
  scene.triangles.push_back(triangle);
  scene.objectOf.push_back(0);
}

double Draw::magnitude(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}
double Draw::pick(std::initializer_list<double> values) {
  return *(values.begin() + below(values.size()));
}
std::size_t Draw::below(std::size_t count) {
  const auto i = static_cast<std::size_t>(uniform(0.0, 1.0) * static_cast<double>(count));
  return std::min(i, count - 1);
}
Vector3d Draw::direction() {
  for (;;) {
    const Vector3d v = inBox(1.0);
    const double length = v.norm();
    if (length > 1e-3 && length <= 1.0) return v / length;
  }
}
Quaternion Draw::rotation(double angle) {
  return aboutAxis(direction(), angle);
}

Quaternion aboutAxis(const Vector3d& unitAxis, double angle) {
  const Vector3d v = std::sin(0.5 * angle) * unitAxis;
  return {std::cos(0.5 * angle), v.x(), v.y(), v.z()};
}

ExtremeCase rigged(Draw& draw, const RigShape& shape) {
  ExtremeCase extreme;
  for (int j = 0; j < shape.joints; ++j) {
    RawJoint joint;
    joint.name = "joint" + std::to_string(j);
    joint.parent = j - 1;
    const Vector3d limb = shape.reach * draw.uniform(0.4, 1.0) * draw.direction();
    joint.offset = j == 0 ? shape.origin : Vector3d(0.6 * limb);
    const Quaternion start = draw.rotation(draw.uniform(0.0, 3.0));
    const Quaternion turned = start * draw.rotation(draw.uniform(0.0, shape.turn));
    extreme.from.rotations.push_back(start);
    extreme.to.rotations.push_back(turned.normalized());
    extreme.from.translations.push_back(joint.offset);
    extreme.to.translations.push_back(j == 0 ? Vector3d(joint.offset + draw.inBox(shape.travel))
                                             : joint.offset);
    extreme.skeleton.joints.push_back(joint);
    extreme.lss.push_back({{Vector3d::Zero(), limb, shape.radius * draw.uniform(0.5, 1.0)}});
  }
  return extreme;
}

namespace {

/// The frame of the link at `t`; rest rotations do not matter.
LinkState stateOf(const ExtremeCase& extreme, LinkId link, double t) {
  const auto skeleton = Skeleton::build(extreme.skeleton);
  const auto from = validatedPose(skeleton.value(), extreme.from);
  const auto to = validatedPose(skeleton.value(), extreme.to);
  return ChainMotion(skeleton.value(), from.value(), to.value()).stateAt(link, t);
}

}  // namespace

Vector3d aimed(Draw& draw, const ExtremeCase& extreme, const AimShape& shape) {
  const std::size_t link = draw.below(extreme.lss.size());
  const Lss& lss = extreme.lss[link].front();
  const Vector3d p_L = lss.a + draw.uniform(0.0, 1.0) * (lss.b - lss.a);
  const Vector3d p_W =
      stateOf(extreme, static_cast<LinkId>(link), draw.uniform(0.0, 1.0)).pointAt(p_L);
  const double gap = draw.chance(shape.inside) ? -draw.uniform(0.0, 1.0) * lss.radius
                                               : draw.magnitude(shape.gapLow, shape.gapHigh);
  return p_W + (lss.radius + gap) * draw.direction();
}

void aim(Draw& draw, ExtremeCase& extreme, const AimShape& shape) {
  for (int i = 0; i < shape.count; ++i) {
    const Vector3d corner = aimed(draw, extreme, shape);
    extreme.add({{corner, corner + draw.inBox(shape.size), corner + draw.inBox(shape.size)}});
  }
}

void cover(Draw& draw, ExtremeCase& extreme, bool thin) {
  constexpr double kThin = 1e-12, kWithin = 0.5;
  constexpr int kTriangles = 4;
  extreme.surface.assign(extreme.lss.size(), {});
  for (std::size_t link = 0; link < extreme.lss.size(); ++link) {
    if (extreme.lss[link].empty()) continue;
    const Lss& lss = extreme.lss[link].front();
    const auto point = [&](double out) {
      return Vector3d(lss.a + draw.uniform(0.05, 0.95) * (lss.b - lss.a) +
                      out * lss.radius * draw.direction());
    };
    for (int i = 0; i < kTriangles; ++i) {
      const Vector3d p = point(kWithin), q = point(kWithin);
      const Vector3d third = thin && i % 2 == 0
                                 ? Vector3d(0.5 * (p + q) + kThin * lss.radius * draw.direction())
                                 : point(kWithin);
      extreme.surface[link].push_back({{p, q, third}});
    }
  }
}

ExtremeCase sliding(const Lss& lss, const Vector3d& from, const Vector3d& to) {
  ExtremeCase extreme;
  RawJoint joint;
  joint.name = "root";
  extreme.skeleton.joints.push_back(joint);
  extreme.lss.push_back({lss});
  extreme.from.rotations.push_back(Quaternion::Identity());
  extreme.to.rotations.push_back(Quaternion::Identity());
  extreme.from.translations.push_back(from);
  extreme.to.translations.push_back(to);
  return extreme;
}

Triangle floorAt(double height, double half) {
  return {{Vector3d(-half, height, -half), Vector3d(3.0 * half, height, -half),
           Vector3d(-half, height, 3.0 * half)}};
}

}  // namespace foretouch::tools::extremes
