// tests/middleware/solid/solid_runner.h: a solid avatar whose every tick the judge looks at.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/solid/figure.h"
#include "bench/solid/way_audit.h"
#include "middleware/solid/solid_avatar.h"
#include "tests/support/judged.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

using Eigen::Vector3d;

using tools::addBox;
using tools::addSheet;
using tools::difference;
using tools::figure;
using tools::wallAt;

class SolidRunner {
 public:
  explicit SolidRunner(const RawScene& raw, const SolidOptions& options = {},
                       Avatar body = figure())
      : avatar(std::move(body)),
        judged(tools::plain(raw.triangles)),
        judge(judged, tools::plainBody(avatar)),
        audit(judged, avatar,
              options.self ? tools::askedPairs(avatar, *options.self)
                           : std::vector<std::array<int, 2>>{}),
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
