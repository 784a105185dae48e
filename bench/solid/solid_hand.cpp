#include "bench/solid/solid_hand.h"

#include <utility>

#include "articulated/try.h"
#include "bench/judged.h"
#include "bench/solid/figure.h"

namespace foretouch::tools {

Result<std::unique_ptr<SolidHand>> SolidHand::build(std::string name, const RawScene& raw,
                                                    const SolidOptions& options) {
  RawScene copy = raw;
  FORETOUCH_TRY(auto scene, Scene::build(std::move(copy)));
  FORETOUCH_TRY(auto solid, SolidAvatar::build(handAlone(), scene, options));
  return std::unique_ptr<SolidHand>(
      new SolidHand(std::move(name), std::move(solid), raw.triangles));
}

SolidHand::SolidHand(std::string name, SolidAvatar solid, const std::vector<Triangle>& triangles)
    : HandFollower(std::move(name)),
      solid_(std::move(solid)),
      judged_(plain(triangles)),
      audit_(judged_, solid_.avatar()),
      target_(restPose(solid_.avatar().skeleton())) {}

void SolidHand::begin(const RigidPose& at) {
  solid_.reset();
  audit_.begin("hand");
  follow(at, 1.0);
  look();
}

RigidPose SolidHand::follow(const RigidPose& tracked, double dtS) {
  target_.rotations.front() = tracked.rotation;
  target_.translations.front() = tracked.pivot;
  // Cannot fail: the pose is finite, and of the avatar.
  (void)solid_.follow({target_, dtS, nullptr}, tick_).ok();
  return {tick_.shown.rotations.front(), tick_.shown.translations.front()};
}

}  // namespace foretouch::tools
