// examples/throw.cpp: see the header.
#include "examples/throw.h"

#include <cmath>

#include <Eigen/Core>
#include <fmt/format.h>

#include "articulated/motion.h"
#include "examples/choreography.h"
#include "examples/dancer_body.h"
#include "examples/posture.h"

namespace foretouch::examples {
namespace {

using Eigen::Vector3d;

constexpr double kGravity = 9.81;  // m/s2
constexpr int kPosesPerS = 120;
/// The share of the speed across, and along, that is left after a bounce off anything.
constexpr double kBounce = 0.62, kSlide = 0.85;
/// Where the middle of the ball stays: the room within its walls, above the floor.
const Vector3d kLowest(-3.3, kBallRadius, -2.8), kHighest(3.3, 10.0, 2.8);
/// At the chest of the other dancer, who turns opposite; reached after this time (s).
const Vector3d kTarget(0.05, 1.25, 1.10);
constexpr double kFlightS = 0.32;

Vector3d ballInHand(const Avatar& dancer, double timeS) {
  const Choreography choreography;
  const Pose pose = poseOf(dancer.skeleton(), choreography.at(timeS));
  const ChainMotion still(dancer.skeleton(), pose, pose);
  return still.stateAt(kRightHand, 0.0).pointAt({kBallInHand[0], kBallInHand[1], kBallInHand[2]});
}

/// Bounces off what it would be beyond; what hardly bounces any more rests on the floor.
void keepInRoom(Vector3d& place, Vector3d& velocity) {
  for (int axis = 0; axis < 3; ++axis) {
    const double kept = std::fmin(std::fmax(place[axis], kLowest[axis]), kHighest[axis]);
    if (kept == place[axis]) continue;
    place[axis] = kept;
    const double across = -kBounce * velocity[axis];
    velocity *= kSlide;
    velocity[axis] = std::abs(across) < 0.25 ? 0.0 : across;
  }
}

}  // namespace

std::string throwText(const Avatar& dancer) {
  Vector3d place = ballInHand(dancer, kThrowS);
  const Vector3d fall(0.0, -kGravity, 0.0);
  Vector3d velocity = (kTarget - place) / kFlightS - 0.5 * kFlightS * fall;
  const double stepS = 1.0 / kPosesPerS;
  std::string text = "time,x,y,z\n";
  const long steps = std::lround((Choreography::kDurationS - kThrowS) * kPosesPerS);
  for (long step = 0; step <= steps; ++step) {
    text +=
        fmt::format("{:.6f},{:.5f},{:.5f},{:.5f}\n", kThrowS + static_cast<double>(step) * stepS,
                    place.x(), place.y(), place.z());
    place += stepS * velocity + 0.5 * stepS * stepS * fall;
    velocity += stepS * fall;
    keepInRoom(place, velocity);
  }
  return text;
}

}  // namespace foretouch::examples
