#include <foretouch/body_t.hpp>
#include <tuple>

#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/wire_fields.h"
#include "network/wire/world_messages.h"

namespace foretouch {
namespace {

static_assert(static_cast<int>(BodyMessageKind::Rigid) == body_t::RIGID);
static_assert(static_cast<int>(BodyMessageKind::Avatar) == body_t::AVATAR);
static_assert(body_t::GONE == 0 && body_t::PRESENT == 1);

using wire::field;
using wire::in;

constexpr auto kBody = std::make_tuple(
    field(&BodyMessage::body, &body_t::body, wire::indexFrom(0)),
    field(&BodyMessage::session, &body_t::session, wire::kWhole),
    field(&BodyMessage::sequence, &body_t::sequence, wire::kWhole),
    field(&BodyMessage::utimeUs, &body_t::utime, wire::kWhole),
    field(&BodyMessage::sendUtimeUs, &body_t::send_utime, wire::kWhole),
    field(&BodyMessage::kind, &body_t::kind, wire::kFlag),
    field(&BodyMessage::isPresent, &body_t::state, wire::kFlag),
    field(&BodyMessage::shape, &body_t::shape, wire::kJointName),
    field(&BodyMessage::shapeHash, &body_t::shape_hash, wire::kAny),
    field(&BodyMessage::carrier, &body_t::carried_by, wire::indexFrom(kNoBody)),
    field(&BodyMessage::carrierLink, &body_t::carried_link, wire::indexFrom(0, kMaxJoints - 1)),
    field(&BodyMessage::movesInFrame, &body_t::moves_in_frame, wire::kFlag),
    field(in(&BodyMessage::pose, &RigidPose::rotation), &body_t::rotation_w, &body_t::rotation_x,
          &body_t::rotation_y, &body_t::rotation_z, wire::kTurn),
    field(in(&BodyMessage::pose, &RigidPose::translation), &body_t::position_x, &body_t::position_y,
          &body_t::position_z, wire::kCoordinate),
    field(&BodyMessage::sinceUs, &body_t::since_utime, wire::kWhole));

Reject checkCarrier(const body_t& wire) {
  if (wire.carried_by == wire.body) return Reject::CarrierLoop;
  const bool isFree = wire.carried_by == kNoBody;
  if (isFree && (wire.carried_link != 0 || wire.moves_in_frame != 0)) return Reject::BadIndex;
  // For an avatar, skeleton_t and pose_t say the rest.
  return wire.kind == body_t::AVATAR && !isFree ? Reject::BadIndex : Reject::None;
}

}  // namespace

Reject decode(ByteView payload, BodyMessage& message) {
  auto& wire = wire::scratch<body_t>();
  Reject reject = fromBytes(PayloadType::Body, payload, wire);
  if (reject == Reject::None) reject = wire::read(wire, kBody, message);
  return reject == Reject::None ? checkCarrier(wire) : reject;
}

void encode(const BodyMessage& message, Bytes& payload) {
  auto& wire = wire::scratch<body_t>();
  wire::write(message, kBody, wire);
  toBytes(PayloadType::Body, wire, payload);
}

}  // namespace foretouch
