#include <algorithm>
#include <foretouch/rigid_pose_t.hpp>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/rigid_fields.h"
#include "network/wire/world_messages.h"

namespace foretouch {
namespace {

static_assert(kJointValid == rigid_pose_t::VALID);
static_assert(kJointTracked == rigid_pose_t::TRACKED);
static_assert(kJointInferred == rigid_pose_t::INFERRED);
constexpr int kKnownFlags = kJointValid | kJointTracked | kJointInferred;

/// Of thousands of bodies, in the time of sorting them.
bool areDifferent(std::vector<std::int32_t> bodies) {
  std::sort(bodies.begin(), bodies.end());
  return std::adjacent_find(bodies.begin(), bodies.end()) == bodies.end();
}

Reject readBody(const rigid_pose_t& wire, std::size_t i, BodyPose& told) {
  told.body = wire.bodies[i];
  told.flags = wire.flags[i];
  told.pose = RigidPose{};
  if (told.body < 0) return Reject::BadIndex;
  if ((told.flags & ~kKnownFlags) != 0) return Reject::OutOfRange;
  if ((told.flags & kJointValid) == 0) return Reject::None;
  return readRigid({wire.rotation_w[i], wire.rotation_x[i], wire.rotation_y[i], wire.rotation_z[i]},
                   {wire.position_x[i], wire.position_y[i], wire.position_z[i]}, told.pose);
}

void resize(std::size_t n, rigid_pose_t& wire) {
  wire.num_bodies = static_cast<std::int32_t>(n);
  wire.bodies.resize(n);
  wire.flags.resize(n);
  for (auto* const part : {&wire.rotation_w, &wire.rotation_x, &wire.rotation_y, &wire.rotation_z,
                           &wire.position_x, &wire.position_y, &wire.position_z}) {
    part->resize(n);
  }
}

/// Keeps its memory: a stream has dozens of messages per second.
rigid_pose_t& scratch() {
  static thread_local rigid_pose_t wire;
  return wire;
}

}  // namespace

Reject decode(ByteView payload, RigidPoseMessage& message) {
  rigid_pose_t& wire = scratch();
  Reject reject = fromBytes(PayloadType::RigidPose, payload, wire);
  if (reject != Reject::None) return reject;
  if (!inRange({wire.session, wire.sequence, wire.utime, wire.send_utime})) {
    return Reject::OutOfRange;
  }
  message.session = wire.session;
  message.sequence = wire.sequence;
  message.utimeUs = wire.utime;
  message.sendUtimeUs = wire.send_utime;
  message.bodies.resize(countOf(wire.num_bodies));
  for (std::size_t i = 0; i < message.bodies.size() && reject == Reject::None; ++i) {
    reject = readBody(wire, i, message.bodies[i]);
  }
  if (reject == Reject::None && !areDifferent(wire.bodies)) reject = Reject::BadIndex;
  return reject;
}

void encode(const RigidPoseMessage& message, Bytes& payload) {
  rigid_pose_t& wire = scratch();
  wire.version = kMessageVersion;
  wire.session = message.session;
  wire.sequence = message.sequence;
  wire.utime = message.utimeUs;
  wire.send_utime = message.sendUtimeUs;
  resize(message.bodies.size(), wire);
  for (std::size_t i = 0; i < message.bodies.size(); ++i) {
    const BodyPose& told = message.bodies[i];
    wire.bodies[i] = told.body;
    wire.flags[i] = told.flags;
    wire.rotation_w[i] = told.pose.rotation.w();
    wire.rotation_x[i] = told.pose.rotation.x();
    wire.rotation_y[i] = told.pose.rotation.y();
    wire.rotation_z[i] = told.pose.rotation.z();
    wire.position_x[i] = told.pose.translation.x();
    wire.position_y[i] = told.pose.translation.y();
    wire.position_z[i] = told.pose.translation.z();
  }
  toBytes(PayloadType::RigidPose, wire, payload);
}

}  // namespace foretouch
