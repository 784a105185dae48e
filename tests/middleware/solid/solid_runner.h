// tests/middleware/solid/solid_runner.h: a figure of thirteen links, scenes of sheets, and a solid
// avatar whose every tick the judge looks at.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/solid/way_audit.h"
#include "middleware/solid/solid_avatar.h"
#include "tests/support/judged.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

using Eigen::Vector3d;

/// Stands at the origin on y = 0 and stretches its arms along x; metres.
inline Avatar figure() {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  const auto link = [&](const char* name, JointId parent, const Vector3d& offset, const Lss& one) {
    raw.joints.push_back({name, parent, offset, Quaternion::Identity()});
    lss.push_back({one});
    return static_cast<JointId>(raw.joints.size()) - 1;
  };
  const JointId hips = link("Hips", kNoParent, {0, 0.95, 0}, {{-0.08, 0, 0}, {0.08, 0, 0}, 0.1});
  const JointId chest = link("Chest", hips, {0, 0.12, 0}, {{0, 0.05, 0}, {0, 0.28, 0}, 0.11});
  link("Head", chest, {0, 0.44, 0}, {{0, 0.06, 0}, {0, 0.14, 0}, 0.09});
  for (const double side : {-1.0, 1.0}) {
    const std::string of = side < 0 ? "Right" : "Left";
    const JointId arm = link((of + "Arm").c_str(), chest, {0.17 * side, 0.32, 0},
                             {{0.02 * side, 0, 0}, {0.26 * side, 0, 0}, 0.045});
    const JointId fore = link((of + "ForeArm").c_str(), arm, {0.28 * side, 0, 0},
                              {{0, 0, 0}, {0.22 * side, 0, 0}, 0.04});
    link((of + "Hand").c_str(), fore, {0.25 * side, 0, 0},
         {{0.02 * side, 0, 0}, {0.12 * side, 0, 0}, 0.035});
    const JointId thigh = link((of + "UpLeg").c_str(), hips, {0.1 * side, -0.05, 0},
                               {{0, -0.02, 0}, {0, -0.38, 0}, 0.07});
    link((of + "Leg").c_str(), thigh, {0, -0.42, 0}, {{0, 0, 0}, {0, -0.38, 0}, 0.05});
  }
  return Avatar::build(Skeleton::build(raw).value(), lss).value();
}

/// A parallelogram in 2 n^2 triangles.
inline void addSheet(RawScene& raw, const Vector3d& corner, const Vector3d& u, const Vector3d& v,
                     int n = 1) {
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

/// Across z = `z`, in front of the figure.
inline RawScene wallAt(double z, int n = 1) {
  RawScene raw;
  addSheet(raw, {-2, -0.5, z}, {4, 0, 0}, {0, 3, 0}, n);
  return raw;
}

/// A box of six sheets.
inline void addBox(RawScene& raw, const Vector3d& low, const Vector3d& high) {
  const Vector3d s = high - low;
  const Vector3d x(s.x(), 0, 0), y(0, s.y(), 0), z(0, 0, s.z());
  for (const Vector3d& at : {Vector3d::Zero().eval(), z}) addSheet(raw, low + at, x, y);
  for (const Vector3d& at : {Vector3d::Zero().eval(), y}) addSheet(raw, low + at, x, z);
  for (const Vector3d& at : {Vector3d::Zero().eval(), x}) addSheet(raw, low + at, y, z);
}

class SolidRunner {
 public:
  explicit SolidRunner(const RawScene& raw, const SolidOptions& options = {},
                       Avatar body = figure())
      : avatar(std::move(body)),
        judged(tools::plain(raw.triangles)),
        judge(judged, tools::plainBody(avatar)),
        audit(judged, avatar),
        solid(SolidAvatar::build(avatar, Scene::build(raw).value(), options).value()) {
    audit.begin("run");
  }

  const SolidTick& follow(const Pose& tracked, double dtS = 1.0 / 90.0) {
    const auto done = solid.follow({tracked, dtS, nullptr}, tick);
    EXPECT_TRUE(done.ok()) << (done.ok() ? "" : describe(done.error()));
    audit.look(tick);
    return tick;
  }

  [[nodiscard]] bool isFree(const Pose& pose, double by = 0.0) {
    return judge.at(tools::plainPose(pose), by).link < 0;
  }
  [[nodiscard]] bool isFree(const Pose& from, const Pose& to, double by) {
    return judge.along(tools::plainPose(from), tools::plainPose(to), by).link < 0;
  }
  [[nodiscard]] Pose rest() const { return restPose(avatar.skeleton()); }
  [[nodiscard]] std::size_t joint(const char* name) const {
    return static_cast<std::size_t>(*avatar.skeleton().find(name));
  }
  /// Promises broken so far; their findings are printed.
  [[nodiscard]] std::uint64_t violations() const {
    for (const std::string& finding : audit.tally().findings) ADD_FAILURE() << finding;
    return audit.tally().violations();
  }

  Avatar avatar;
  oracle::Scene judged;
  oracle::WayJudge judge;
  tools::WayAudit audit;
  SolidAvatar solid;
  SolidTick tick;
};

inline bool isSame(const Pose& a, const Pose& b) {
  return tools::plainPose(a) == tools::plainPose(b);
}

/// The largest difference of any number of two poses.
inline double difference(const Pose& a, const Pose& b) {
  double most = 0.0;
  for (std::size_t j = 0; j < a.rotations.size(); ++j) {
    most = std::max(most, (a.rotations[j].coeffs() - b.rotations[j].coeffs()).norm());
    most = std::max(most, (a.translations[j] - b.translations[j]).norm());
  }
  return most;
}

/// The figure with both arms turned about y by `yaw`: forwards, to -z, at a quarter turn.
inline Pose reaching(const SolidRunner& run, double yaw) {
  Pose pose = run.rest();
  pose.rotations[run.joint("RightArm")] = Quaternion(Eigen::AngleAxisd(-yaw, Vector3d::UnitY()));
  pose.rotations[run.joint("LeftArm")] = Quaternion(Eigen::AngleAxisd(yaw, Vector3d::UnitY()));
  return pose;
}

/// Every joint turned by up to `most`, the root moved within a box of half of `reach`.
inline Pose randomPose(const SolidRunner& run, Random& random, double most, double reach) {
  Pose pose = run.rest();
  for (Quaternion& q : pose.rotations) q = random.turn(random.uniform(0.0, most));
  pose.translations[0] += random.inBox(reach);
  return pose;
}

}  // namespace foretouch::test
