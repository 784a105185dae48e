#include <algorithm>
#include <foretouch/rigid_pose_t.hpp>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/wire_fields.h"
#include "network/wire/world_messages.h"

namespace foretouch {
namespace {

static_assert(kJointValid == rigid_pose_t::VALID);
static_assert(kJointTracked == rigid_pose_t::TRACKED);
static_assert(kJointInferred == rigid_pose_t::INFERRED);

using wire::field;
using wire::in;

constexpr auto kRigidHead =
    std::make_tuple(field(&RigidPoseMessage::session, &rigid_pose_t::session, wire::kWhole),
                    field(&RigidPoseMessage::sequence, &rigid_pose_t::sequence, wire::kWhole),
                    field(&RigidPoseMessage::utimeUs, &rigid_pose_t::utime, wire::kWhole),
                    field(&RigidPoseMessage::sendUtimeUs, &rigid_pose_t::send_utime, wire::kWhole));

constexpr auto kBodyNumber =
    std::make_tuple(field(&BodyPose::body, &rigid_pose_t::bodies, wire::indexFrom(0)),
                    field(&BodyPose::flags, &rigid_pose_t::flags, wire::kKnownFlags));

/// Meaningless unless kJointValid.
constexpr auto kPlace =
    std::make_tuple(field(in(&BodyPose::pose, &RigidPose::rotation), &rigid_pose_t::rotation_w,
                          &rigid_pose_t::rotation_x, &rigid_pose_t::rotation_y,
                          &rigid_pose_t::rotation_z, wire::kTurn),
                    field(in(&BodyPose::pose, &RigidPose::translation), &rigid_pose_t::position_x,
                          &rigid_pose_t::position_y, &rigid_pose_t::position_z, wire::kCoordinate));

/// Also for thousands of bodies, in the time of sorting them.
bool areDifferent(const std::vector<BodyPose>& told) {
  std::vector<BodyNumber> bodies;
  bodies.reserve(told.size());
  for (const BodyPose& pose : told) bodies.push_back(pose.body);
  std::sort(bodies.begin(), bodies.end());
  return std::adjacent_find(bodies.begin(), bodies.end()) == bodies.end();
}

}  // namespace

Reject decode(ByteView payload, RigidPoseMessage& message) {
  auto& wire = wire::scratch<rigid_pose_t>();
  Reject reject = fromBytes(PayloadType::RigidPose, payload, wire);
  if (reject == Reject::None) reject = wire::read(wire, kRigidHead, message);
  if (reject != Reject::None) return reject;
  const auto readPlace = [&](BodyPose& told, std::size_t i) {
    told.pose = RigidPose{};
    return (told.flags & kJointValid) == 0 ? Reject::None : wire::read(wire, kPlace, told, i);
  };
  reject = wire::readRows(wire, kBodyNumber, &rigid_pose_t::num_bodies, message.bodies, readPlace);
  if (reject == Reject::None && !areDifferent(message.bodies)) reject = Reject::BadIndex;
  return reject;
}

void encode(const RigidPoseMessage& message, Bytes& payload) {
  auto& wire = wire::scratch<rigid_pose_t>();
  wire::write(message, kRigidHead, wire);
  wire::writeRows(message.bodies, std::tuple_cat(kBodyNumber, kPlace), &rigid_pose_t::num_bodies,
                  wire);
  toBytes(PayloadType::RigidPose, wire, payload);
}

}  // namespace foretouch
