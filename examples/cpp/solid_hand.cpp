// A hand that stays on a table: the tracked hand goes 6 cm too deep, sweeps along and over the
// edge, comes back and leaves. Prints what is shown of it, at 90 Hz.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <foretouch/foretouch.hpp>
#include <iostream>
#include <utility>

using namespace foretouch;

template <typename T>
T orExit(Result<T> result) {
  if (!result.ok()) {
    std::cerr << describe(result.error()) << '\n';
    std::exit(1);
  }
  return std::move(result).value();
}

constexpr double kHz = 90.0, kTop = 0.75, kEdge = 0.4, kThickness = 0.04;

/// A table's board: x from -0.4 to 0.4, its top at 0.75 m.
Scene table() {
  const double low = kTop - kThickness;
  const auto corner = [&](int i) {
    return Eigen::Vector3d((i & 1) != 0 ? kEdge : -kEdge, (i & 2) != 0 ? kTop : low,
                           (i & 4) != 0 ? 0.3 : -0.3);
  };
  constexpr int kFaces[6][4] = {{0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2},
                                {4, 5, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  RawScene board;
  board.objectNames = {"table"};
  for (const auto& f : kFaces) {
    board.triangles.push_back({{{corner(f[0]), corner(f[1]), corner(f[2])}}});
    board.triangles.push_back({{{corner(f[0]), corner(f[2]), corner(f[3])}}});
    board.objectOf.insert(board.objectOf.end(), {0, 0});
  }
  return orExit(Scene::build(board));
}

/// A forearm, tracked at its elbow, with a hand.
Avatar forearm() {
  RawSkeleton bones;
  bones.joints.push_back({"LeftForeArm", kNoParent, {0, 0, 0}, Quaternion::Identity()});
  bones.joints.push_back({"LeftHand", 0, {0.25, 0, 0}, Quaternion::Identity()});
  const Lss arm{{0, 0, 0}, {0.25, 0, 0}, 0.04}, hand{{0, 0, 0}, {0.15, 0, 0}, 0.03};
  return orExit(Avatar::build(orExit(Skeleton::build(bones)), {{arm}, {hand}}));
}

/// 0 before `begin`, 1 after `end` (seconds), smoothly.
double ramp(double t, double begin, double end) {
  const double s = std::clamp((t - begin) / (end - begin), 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

/// What the tracker says. Yours; here an elbow above the board, and a hand below its top.
Pose trackedAt(double t, const Skeleton& skeleton) {
  Pose pose = restPose(skeleton);
  const double down = ramp(t, 0.0, 0.8) - ramp(t, 4.2, 5.0);
  const double along = ramp(t, 1.2, 2.4) - ramp(t, 3.2, 4.2);
  pose.translations[0] = {-0.5 + 0.6 * along, kTop + 0.3 - 0.13 * down, 0.0};
  pose.rotations[0] = Eigen::AngleAxisd(-0.35 - 0.35 * down, Eigen::Vector3d::UnitZ());
  pose.rotations[1] = Eigen::AngleAxisd(0.4 * down, Eigen::Vector3d::UnitZ());
  return orExit(validatedPose(skeleton, std::move(pose)));
}

/// The tip of the hand, in the world.
Eigen::Vector3d tipOf(const Pose& pose) {
  const Eigen::Vector3d wrist = pose.rotations[0] * pose.translations[1] + pose.translations[0];
  return wrist + pose.rotations[0] * pose.rotations[1] * Eigen::Vector3d(0.15, 0, 0);
}

double pushOf(const SolidTick& tick) {
  double push = 0.0;
  for (const SolidContact& contact : tick.contacts) push = std::max(push, contact.push);
  return push;
}

void print(double t, const Pose& tracked, const SolidTick& tick) {
  const Eigen::Vector3d wanted = tipOf(tracked), shown = tipOf(tick.shown);
  std::printf("%4.2f  %6.3f %6.3f  %6.3f %6.3f  %-9s  %5.1f  %5.1f\n", t, wanted.x(), wanted.y(),
              shown.x(), shown.y(), toString(tick.state), 1e3 * tick.deviation, 1e3 * pushOf(tick));
}

int main() {
  const Avatar avatar = forearm();
  const Scene scene = table();
  SolidAvatar solid = orExit(SolidAvatar::build(avatar, scene));

  std::printf("   s   tracked x, y   shown x, y    state      off mm  push mm\n");
  SolidTick tick;
  int touching = 0, moving = 0, proven = 0, frames = 0;
  for (; frames <= 5.5 * kHz; ++frames) {
    const Pose tracked = trackedAt(frames / kHz, avatar.skeleton());
    const auto done = solid.follow({tracked, 1.0 / kHz}, tick);
    if (!done.ok()) std::cerr << describe(done.error()) << '\n';  // shows what it showed before
    proven += tick.isCertified;
    touching += !tick.contacts.empty();
    moving += tick.state == SolidState::Sliding;
    if (frames % 30 == 0) print(frames / kHz, tracked, tick);
  }
  const bool isBack = tick.state == SolidState::Equal;
  std::printf("proven free in %d of %d frames, touched in %d, slid in %d; back: %s\n", proven,
              frames, touching, moving, isBack ? "yes" : "no");
  return proven == frames && touching > 90 && moving > 30 && isBack ? 0 : 1;
}
