#include "bench/solid/figure.h"

#include <string>
#include <vector>

namespace foretouch::tools {

using Eigen::Vector3d;

Avatar figure() {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  const auto link = [&](const std::string& name, JointId parent, const Vector3d& offset,
                        const Lss& one) {
    raw.joints.push_back({name, parent, offset, Quaternion::Identity()});
    lss.push_back({one});
    return static_cast<JointId>(raw.joints.size()) - 1;
  };
  const JointId hips = link("Hips", kNoParent, {0, 0.95, 0}, {{-0.08, 0, 0}, {0.08, 0, 0}, 0.1});
  const JointId chest = link("Chest", hips, {0, 0.12, 0}, {{0, 0.05, 0}, {0, 0.28, 0}, 0.11});
  link("Head", chest, {0, 0.44, 0}, {{0, 0.06, 0}, {0, 0.14, 0}, 0.09});
  for (const double side : {-1.0, 1.0}) {
    const std::string of = side < 0 ? "Right" : "Left";
    const JointId arm = link(of + "Arm", chest, {0.17 * side, 0.32, 0},
                             {{0.02 * side, 0, 0}, {0.26 * side, 0, 0}, 0.045});
    const JointId fore =
        link(of + "ForeArm", arm, {0.28 * side, 0, 0}, {{0, 0, 0}, {0.22 * side, 0, 0}, 0.04});
    link(of + "Hand", fore, {0.25 * side, 0, 0}, {{0.02 * side, 0, 0}, {0.12 * side, 0, 0}, 0.035});
    const JointId thigh =
        link(of + "UpLeg", hips, {0.1 * side, -0.05, 0}, {{0, -0.02, 0}, {0, -0.38, 0}, 0.07});
    link(of + "Leg", thigh, {0, -0.42, 0}, {{0, 0, 0}, {0, -0.38, 0}, 0.05});
  }
  return Avatar::build(Skeleton::build(raw).value(), lss).value();
}

Lss handLss() {
  return {{-0.05, 0, 0}, {0.05, 0, 0}, 0.035};
}

Avatar handAlone() {
  RawSkeleton raw;
  raw.joints.push_back({"Hand", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
  return Avatar::build(Skeleton::build(raw).value(), {{handLss()}}).value();
}

void addSheet(RawScene& raw, const Vector3d& corner, const Vector3d& u, const Vector3d& v, int n) {
  if (raw.objectNames.empty()) raw.objectNames = {"sheets"};
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const Vector3d a = corner + u * i / n + v * k / n, b = corner + u * (i + 1) / n + v * k / n,
                     c = corner + u * (i + 1) / n + v * (k + 1) / n,
                     d = corner + u * i / n + v * (k + 1) / n;
      raw.triangles.push_back({{a, b, c}});
      raw.triangles.push_back({{a, c, d}});
      raw.objectOf.insert(raw.objectOf.end(), 2, 0);
    }
  }
}

void addBox(RawScene& raw, const Vector3d& low, const Vector3d& high) {
  const Vector3d s = high - low;
  const Vector3d x(s.x(), 0, 0), y(0, s.y(), 0), z(0, 0, s.z());
  for (const Vector3d& at : {Vector3d::Zero().eval(), z}) addSheet(raw, low + at, x, y);
  for (const Vector3d& at : {Vector3d::Zero().eval(), y}) addSheet(raw, low + at, x, z);
  for (const Vector3d& at : {Vector3d::Zero().eval(), x}) addSheet(raw, low + at, y, z);
}

RawScene wallAt(double z, int n) {
  RawScene raw;
  addSheet(raw, {-2, -0.5, z}, {4, 0, 0}, {0, 3, 0}, n);
  return raw;
}

}  // namespace foretouch::tools
