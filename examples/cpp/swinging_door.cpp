// A dancer, tracked 30 times per second, and a door that swings, known 60 times per second: when
// does which link meet the door?
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <foretouch/foretouch.hpp>
#include <iostream>
#include <utility>

using namespace foretouch;

template <typename T>
T must(Result<T> result) {
  if (!result.ok()) {
    std::cerr << describe(result.error()) << '\n';
    std::exit(1);
  }
  return std::move(result).value();
}

constexpr double kTurn = 6.283185307179586;

/// A panel of 0.9 by 2 m, in the frame of its hinge.
Scene doorPanel() {
  const Eigen::Vector3d hinge(0, 0, 0), handle(-0.9, 0, 0), above(-0.9, 2, 0), top(0, 2, 0);
  RawScene raw;
  raw.objectNames = {"door"};
  raw.triangles = {{{hinge, handle, above}}, {{hinge, above, top}}};
  raw.objectOf = {0, 0};
  return must(Scene::build(raw));
}

/// A trunk with one arm.
Avatar dancerWithAnArm() {
  RawSkeleton bones;
  bones.joints.push_back({"trunk", kNoParent, {0, 0.9, 0}, Quaternion::Identity()});
  bones.joints.push_back({"arm", 0, {0.2, 0.5, 0}, Quaternion::Identity()});
  const Lss trunk{{0, 0, 0}, {0, 0.6, 0}, 0.15}, arm{{0, 0, 0}, {0.6, 0, 0}, 0.05};
  return must(Avatar::build(must(Skeleton::build(bones)), {{trunk}, {arm}}));
}

Quaternion aboutY(double angle) {
  return {std::cos(0.5 * angle), 0.0, std::sin(0.5 * angle), 0.0};
}

/// What the tracker says of the dancer, who turns and swings the arm; and how far the door is open.
/// Yours.
Pose trackedDancer(double s, const Skeleton& skeleton) {
  Pose pose = restPose(skeleton);
  pose.rotations[0] = aboutY(0.4 * std::sin(kTurn * 0.3 * s));
  pose.rotations[1] = aboutY(1.2 * std::sin(kTurn * 0.7 * s));
  return pose;
}
RigidPose trackedDoor(double s) {
  return {aboutY(0.35 * std::sin(kTurn * 0.5 * s)), Eigen::Vector3d(1.3, 0.0, -0.35)};
}

/// Prints the contacts of a window, the earliest first; returns how many there are.
int print(const WorldContacts& answer, const Skeleton& skeleton) {
  int met = 0;
  for (const WorldContact& contact : answer.contacts) {
    if (contact.verdict != Verdict::Contact) continue;  // it touched before
    const Eigen::Vector3d& p = contact.a.p_W;
    std::printf("%.4f s: %s meets the door at (%.3f, %.3f, %.3f)\n",
                1e-6 * microsecondsAfter(0, contact.time), skeleton.name(contact.a.link).c_str(),
                p.x(), p.y(), p.z());
    ++met;
  }
  return met;
}

int main() {
  const Avatar avatar = dancerWithAnArm();
  const Skeleton& skeleton = avatar.skeleton();
  int contacts = 0, windows = 0;

  World world = must(World::build(std::nullopt));    // or a Scene: what never moves
  const BodyId dancer = must(world.add(avatar));     // several bodies may have one avatar
  const BodyId door = must(world.add(doorPanel()));  // a Scene in the door's own frame
  Scratch scratch;
  WorldContacts answer;
  std::int64_t answered = 0;
  for (std::int64_t us = 0; us <= 4'000'000; us += 5'556) {
    const double s = 1e-6 * static_cast<double>(us);
    if (us % 33'336 == 0) must(world.push(dancer, us, trackedDancer(s, skeleton)));
    if (us % 16'668 == 0) must(world.push(door, us, trackedDoor(s)));  // its own clock
    const std::int64_t until = *world.knownUntilUs();                  // all is known until then
    if (until <= answered) continue;
    must(world.contacts(answered, until, scratch, answer));
    contacts += print(answer, skeleton);
    world.forgetBefore(until);
    answered = until;
    ++windows;
  }

  std::printf("%d contacts in %d windows\n", contacts, windows);
  return contacts > 0 ? 0 : 1;
}
