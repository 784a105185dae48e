// A loop at 90 Hz: a tracked arm swings to and fro, and a pole holds what is shown of it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <foretouch/foretouch.hpp>
#include <iostream>
#include <utility>

using namespace foretouch;

template <typename T>
T made(Result<T> result) {
  if (!result.ok()) {
    std::cerr << describe(result.error()) << '\n';
    std::exit(1);
  }
  return std::move(result).value();
}

/// What the tracker says in this frame. Yours; here an elbow that turns up to 90 degrees and back.
Pose trackedIn(int frame, const Skeleton& skeleton) {
  Pose pose = restPose(skeleton);
  const double angle = 0.785 * (1.0 - std::cos(0.0698 * frame));
  pose.rotations[0] = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY());
  return made(validatedPose(skeleton, std::move(pose)));
}

int main() {
  RawSkeleton bones;
  bones.joints.push_back({"forearm", kNoParent, {0, 1, 0}, Quaternion::Identity()});
  const Lss forearm{{0, 0, 0}, {0.3, 0, 0}, 0.04};
  const Avatar avatar = made(Avatar::build(made(Skeleton::build(bones)), {{forearm}}));
  const Scene scene =
      made(Scene::build({{{{{{0.2, 0, -0.2}, {0.2, 2, -0.2}, {0.4, 1, -0.4}}}}}, {0}, {"pole"}}));
  QueryOptions options;
  options.workBudget = 200'000;   // evaluations of some 10 ns: 2 ms of the frame's 11
  options.passSeparating = true;  // what was stopped at the pole may leave it
  const Query query = made(Query::build(avatar, scene, options));

  ChainMotion motion;
  Scratch scratch;
  StepContacts step;
  Pose shown = trackedIn(0, avatar.skeleton());
  int held = 0;
  for (int frame = 1; frame <= 90; ++frame) {
    const Pose tracked = trackedIn(frame, avatar.skeleton());
    motion.assign(avatar.skeleton(), shown, tracked);
    query.answer(motion, scratch, step);
    // Clear: 1. A contact: its toi. Out of budget: as far as is proven. So nothing passes.
    double free = 1.0;
    for (const LinkContact& link : step.links) free = std::min(free, link.freeUntil);
    motion.poseAt(free, shown);  // draw this; the next frame starts from it
    held += free < 1.0;
  }
  const double left =
      shown.rotations[0].angularDistance(trackedIn(90, avatar.skeleton()).rotations[0]);
  std::printf("held in %d of 90 frames, and back with the tracker: %s\n", held,
              left < 1e-6 ? "yes" : "no");
  return held > 20 && held < 70 && left < 1e-6 ? 0 : 1;
}
