// tests/network/world_stream/small_world.h: a world of balls and small avatars, and messages about
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "network/wire/codec.h"
#include "network/world_stream/world_solver.h"
#include "tests/network/small_stream.h"

namespace foretouch::test {

inline constexpr double kBallRadius = 0.1;
/// Where it begins, and from pose to pose: microseconds.
inline constexpr std::int64_t kStart = 1'000'000'000, kTick = 10'000;

inline std::int64_t tick(std::int64_t n) {
  return kStart + n * kTick;
}

inline Avatar ball(double radius = kBallRadius) {
  RawSkeleton raw;
  raw.joints.push_back({"ball", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()});
  const Lss lss{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), radius};
  return Avatar::build(Skeleton::build(raw).value(), {{lss}}).value();
}

/// Shapes "dancer" (of avatars 1 to `avatars`) and "ball", and no scene.
inline WorldSetup smallWorld(std::int32_t avatars = 0) {
  WorldSetup setup;
  setup.shapes.push_back({"dancer", smallAvatar(), std::nullopt, 0, std::nullopt});
  setup.shapes.push_back({"ball", ball(), std::nullopt, 0, std::nullopt});
  for (std::int32_t i = 1; i <= avatars; ++i) setup.avatars.push_back({i, 0});
  return setup;
}

/// A ball that is there from its first pose on.
inline BodyMessage ballMessage(BodyNumber body, std::int64_t sequence = 0,
                               std::int64_t session = 1) {
  BodyMessage message;
  message.body = body;
  message.session = session;
  message.sequence = sequence;
  message.shape = "ball";
  return message;
}

inline BodyPose ballAt(BodyNumber body, const Eigen::Vector3d& place) {
  return {body, kTrackedNow, {Quaternion::Identity(), place}};
}

inline RigidPoseMessage rigidPoses(std::int64_t sequence, std::int64_t utimeUs,
                                   std::vector<BodyPose> bodies, std::int64_t session = 1) {
  RigidPoseMessage message;
  message.session = session;
  message.sequence = sequence;
  message.utimeUs = utimeUs;
  message.bodies = std::move(bodies);
  return message;
}

/// What a world has told.
struct ToldWorld {
  std::vector<EventsMessage> answers;
  [[nodiscard]] std::vector<ToldEvent> events() const {
    std::vector<ToldEvent> all;
    for (const EventsMessage& answer : answers) {
      all.insert(all.end(), answer.events.begin(), answer.events.end());
    }
    return all;
  }
  void hear(WorldSolver& solver) {
    std::vector<EventsMessage> next;
    solver.advance(next);
    answers.insert(answers.end(), next.begin(), next.end());
  }
};

}  // namespace foretouch::test
