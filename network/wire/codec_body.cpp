#include <foretouch/body_t.hpp>

#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/rigid_fields.h"
#include "network/wire/world_messages.h"

namespace foretouch {
namespace {

static_assert(static_cast<int>(BodyMessageKind::Rigid) == body_t::RIGID);
static_assert(static_cast<int>(BodyMessageKind::Avatar) == body_t::AVATAR);
static_assert(body_t::GONE == 0 && body_t::PRESENT == 1);

bool isFlag(std::int8_t value) {
  return value == 0 || value == 1;
}

Reject checkCarrier(const body_t& wire) {
  if (wire.carried_by < kNoBody || wire.carried_link < 0 || wire.carried_link >= kMaxJoints) {
    return Reject::BadIndex;
  }
  if (wire.carried_by == wire.body) return Reject::CarrierLoop;
  const bool isFree = wire.carried_by == kNoBody;
  if (isFree && (wire.carried_link != 0 || wire.moves_in_frame != 0)) return Reject::BadIndex;
  // Of an avatar, skeleton_t and pose_t say the rest.
  return wire.kind == body_t::AVATAR && !isFree ? Reject::BadIndex : Reject::None;
}

Reject checkHead(const body_t& wire) {
  if (wire.body < 0) return Reject::BadIndex;
  if (!inRange({wire.session, wire.sequence, wire.utime, wire.send_utime, wire.since_utime}) ||
      !isFlag(wire.kind) || !isFlag(wire.state) || !isFlag(wire.moves_in_frame)) {
    return Reject::OutOfRange;
  }
  if (nameProblem(wire.shape)) return Reject::BadName;
  return checkCarrier(wire);
}

}  // namespace

Reject decode(ByteView payload, BodyMessage& message) {
  body_t wire;
  Reject reject = fromBytes(PayloadType::Body, payload, wire);
  if (reject == Reject::None) reject = checkHead(wire);
  if (reject == Reject::None) {
    reject = readRigid({wire.rotation_w, wire.rotation_x, wire.rotation_y, wire.rotation_z},
                       {wire.position_x, wire.position_y, wire.position_z}, message.pose);
  }
  if (reject != Reject::None) return reject;
  message.body = wire.body;
  message.session = wire.session;
  message.sequence = wire.sequence;
  message.utimeUs = wire.utime;
  message.sendUtimeUs = wire.send_utime;
  message.kind = static_cast<BodyMessageKind>(wire.kind);
  message.isPresent = wire.state == body_t::PRESENT;
  message.shape = wire.shape;
  message.shapeHash = wire.shape_hash;
  message.carrier = wire.carried_by;
  message.carrierLink = wire.carried_link;
  message.movesInFrame = wire.moves_in_frame != 0;
  message.sinceUs = wire.since_utime;
  return Reject::None;
}

void encode(const BodyMessage& message, Bytes& payload) {
  body_t wire;
  wire.version = kMessageVersion;
  wire.body = message.body;
  wire.session = message.session;
  wire.sequence = message.sequence;
  wire.utime = message.utimeUs;
  wire.send_utime = message.sendUtimeUs;
  wire.kind = static_cast<std::int8_t>(message.kind);
  wire.state = message.isPresent ? body_t::PRESENT : body_t::GONE;
  wire.shape = message.shape;
  wire.shape_hash = message.shapeHash;
  wire.carried_by = message.carrier;
  wire.carried_link = message.carrierLink;
  wire.moves_in_frame = message.movesInFrame ? 1 : 0;
  wire.rotation_w = message.pose.rotation.w();
  wire.rotation_x = message.pose.rotation.x();
  wire.rotation_y = message.pose.rotation.y();
  wire.rotation_z = message.pose.rotation.z();
  wire.position_x = message.pose.translation.x();
  wire.position_y = message.pose.translation.y();
  wire.position_z = message.pose.translation.z();
  wire.since_utime = message.sinceUs;
  toBytes(PayloadType::Body, wire, payload);
}

}  // namespace foretouch
