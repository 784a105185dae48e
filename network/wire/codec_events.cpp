#include <cmath>
#include <foretouch/events_t.hpp>
#include <limits>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/wire_fields.h"
#include "network/wire/world_messages.h"

namespace foretouch {
namespace {

static_assert(static_cast<int>(EventKind::Leave) == events_t::LEAVE);
static_assert(static_cast<int>(EventKind::UnresolvedTo) == events_t::UNRESOLVED_TO);
static_assert(static_cast<int>(EventKind::StartsInside) == events_t::STARTS_INSIDE);
static_assert(static_cast<int>(EventKind::Enter) == events_t::ENTER);
static_assert(static_cast<int>(EventKind::UnresolvedFrom) == events_t::UNRESOLVED_FROM);
static_assert(static_cast<int>(ToldCause::Apart) == events_t::APART);
static_assert(static_cast<int>(ToldCause::NotAsked) == events_t::NOT_ASKED);
static_assert(static_cast<int>(ToldCause::BodyGone) == events_t::BODY_GONE);

constexpr std::size_t kMostPoints = WorldEvent::kMostPoints;
static_assert(kMaxToldEvents * kMostPoints <= countOf(kMaxListed));
// The largest message fits.
static_assert(kMaxToldBodies * 13 + kMaxToldUnknown * 25 + kMaxToldEvents * 217 +
                  kMaxToldEvents * kMostPoints * 56 + 1024 <=
              kMaxMessageBytes);
/// In messages: neither side weighs anything.
constexpr double kNoMass = -1.0;

using wire::field;
using wire::in;
using wire::indexFrom;

constexpr auto kEventsHead =
    std::make_tuple(field(&EventsMessage::timeline, &events_t::timeline, wire::kWhole),
                    field(&EventsMessage::sequence, &events_t::sequence, wire::kWhole),
                    field(&EventsMessage::fromUs, &events_t::window_from, wire::kWhole),
                    field(&EventsMessage::toUs, &events_t::window_to, wire::kWhole),
                    field(&EventsMessage::hasMore, &events_t::more, wire::kFlag),
                    field(&EventsMessage::tolerance, &events_t::tolerance, wire::kNotNegative),
                    field(&EventsMessage::receiveUtimeUs, &events_t::receive_utime, wire::kWhole),
                    field(&EventsMessage::sendUtimeUs, &events_t::send_utime, wire::kWhole),
                    field(&EventsMessage::worldUs, &events_t::world_us, wire::kNotNegative));

constexpr auto kToldBody =
    std::make_tuple(field(&ToldBody::body, &events_t::bodies, indexFrom(0)),
                    field(&ToldBody::knownUntilUs, &events_t::known_until, wire::Whole{-1}),
                    field(&ToldBody::isWaitedFor, &events_t::waiting, wire::kFlag));

constexpr auto kUnknownPart = std::make_tuple(
    field(&UnknownPart::body, &events_t::unknown_bodies, indexFrom(kEveryBody)),
    field(&UnknownPart::link, &events_t::unknown_links, indexFrom(kEveryLink, kMaxJoints - 1)),
    field(&UnknownPart::reason, &events_t::unknown_reasons,
          wire::Whole{1, kNumUndecidedReasons - 1}),
    field(&UnknownPart::fromUs, &events_t::unknown_from, wire::kWhole),
    field(&UnknownPart::toUs, &events_t::unknown_to, wire::kWhole));

/// In [0, 1).
constexpr wire::Real kPartOfMicrosecond{0.0, 0x1.fffffffffffffp-1};
template <typename Member>
constexpr auto ofEvent(Member member) {
  return in(&ToldEvent::event, member);
}
template <typename Member>
constexpr auto ofA(Member member) {
  return in(ofEvent(&WorldEvent::a), member);
}
template <typename Member>
constexpr auto ofB(Member member) {
  return in(ofEvent(&WorldEvent::b), member);
}
constexpr auto kEvent = std::make_tuple(
    field(ofEvent(&WorldEvent::kind), &events_t::kinds, wire::codeBelow(kNumEventKinds)),
    field(&ToldEvent::cause, &events_t::causes, wire::codeBelow(kNumToldCauses)),
    field(ofEvent(&WorldEvent::reason), &events_t::reasons, wire::codeBelow(kNumUndecidedReasons)),
    field(ofEvent(&WorldEvent::isAssumed), &events_t::marks, wire::kFlag),
    field(in(ofEvent(&WorldEvent::time), &WorldTime::us), &events_t::utime, wire::kWhole),
    field(in(ofEvent(&WorldEvent::time), &WorldTime::fraction), &events_t::fraction,
          kPartOfMicrosecond),
    field(in(ofEvent(&WorldEvent::since), &WorldTime::us), &events_t::since_utime, wire::kWhole),
    field(in(ofEvent(&WorldEvent::since), &WorldTime::fraction), &events_t::since_fraction,
          kPartOfMicrosecond),
    field(ofA(&ContactSide::body), &events_t::body_a, indexFrom(kEveryBody)),
    field(ofA(&ContactSide::link), &events_t::link_a, indexFrom(kEveryLink, kMaxJoints - 1)),
    field(ofA(&ContactSide::lss), &events_t::lss_a, indexFrom(-1)),
    field(ofA(&ContactSide::triangle), &events_t::triangle_a, indexFrom(-1)),
    field(ofA(&ContactSide::p_W), &events_t::point_a_x, &events_t::point_a_y, &events_t::point_a_z,
          wire::kFinite),
    field(ofB(&ContactSide::body), &events_t::body_b, indexFrom(kEveryBody)),
    field(ofB(&ContactSide::link), &events_t::link_b, indexFrom(kEveryLink, kMaxJoints - 1)),
    field(ofB(&ContactSide::lss), &events_t::lss_b, indexFrom(-1)),
    field(ofB(&ContactSide::triangle), &events_t::triangle_b, indexFrom(-1)),
    field(ofB(&ContactSide::p_W), &events_t::point_b_x, &events_t::point_b_y, &events_t::point_b_z,
          wire::kFinite),
    field(ofEvent(&WorldEvent::object), &events_t::object, indexFrom(-1)),
    field(ofEvent(&WorldEvent::nhat_BA_W), &events_t::normal_x, &events_t::normal_y,
          &events_t::normal_z, wire::kUnit),
    field(ofEvent(&WorldEvent::separation), &events_t::separation, wire::kFinite),
    field(ofEvent(&WorldEvent::penetration), &events_t::penetration, wire::kFinite),
    field(ofEvent(&WorldEvent::velocity_W), &events_t::velocity_x, &events_t::velocity_y,
          &events_t::velocity_z, wire::kFinite),
    field(ofEvent(&WorldEvent::approachSpeed), &events_t::approach, wire::kFinite),
    field(ofEvent(&WorldEvent::approachLower), &events_t::approach_lower, wire::kFinite),
    field(ofEvent(&WorldEvent::approachUpper), &events_t::approach_upper, wire::kFinite),
    field(ofEvent(&WorldEvent::effectiveMass), &events_t::effective_mass, wire::kFinite),
    field(ofEvent(&WorldEvent::numPoints), &events_t::numbers_of_points,
          wire::Whole{0, kMostPoints, Reject::Limit}));

constexpr auto kPoint =
    std::make_tuple(field(&EventPoint::p_WA, &events_t::near_a_x, &events_t::near_a_y,
                          &events_t::near_a_z, wire::kFinite),
                    field(&EventPoint::p_WB, &events_t::near_b_x, &events_t::near_b_y,
                          &events_t::near_b_z, wire::kFinite),
                    field(&EventPoint::separation, &events_t::near_separation, wire::kFinite));

Reject checkHead(const events_t& wire) {
  if (wire.window_from > wire.window_to) return Reject::OutOfRange;
  return countOf(wire.num_events) <= kMaxToldEvents ? Reject::None : Reject::Limit;
}

/// Readers of before LeaveCause::Moved know three causes, and refuse others. They look at the
/// reason of what is unresolved alone, so that of a LEAVE tells whether it is one.
constexpr UndecidedReason kReasonOfMoved = UndecidedReason::Gap;
bool isTornApart(const ToldEvent& told, UndecidedReason reason) {
  return told.event.kind == EventKind::Leave && told.cause == ToldCause::Apart &&
         reason == kReasonOfMoved;
}

UndecidedReason wireReasonOf(const ToldEvent& told) {
  const bool isMoved = told.event.cause == LeaveCause::Moved;
  return isMoved && isTornApart(told, kReasonOfMoved) ? kReasonOfMoved : told.event.reason;
}

/// From what messages say to what the kernel does.
Reject settle(ToldEvent& told) {
  WorldEvent& event = told.event;
  event.cause = told.cause == ToldCause::NotAsked ? LeaveCause::NotAsked : LeaveCause::Apart;
  if (isTornApart(told, event.reason)) {
    event.cause = LeaveCause::Moved;
    event.reason = UndecidedReason::None;
  }
  if (event.effectiveMass >= 0.0) return Reject::None;
  if (event.effectiveMass != kNoMass) return Reject::OutOfRange;
  event.effectiveMass = std::numeric_limits<double>::infinity();
  return Reject::None;
}

/// `point`: the first of the event's own, then of the next one's.
Reject readPoints(const events_t& wire, std::size_t& point, WorldEvent& event) {
  event.points = {};
  if (point + event.numPoints > countOf(wire.num_points)) return Reject::BadIndex;
  for (std::size_t k = 0; k < event.numPoints; ++k, ++point) {
    const Reject reject = wire::read(wire, kPoint, event.points[k], point);
    if (reject != Reject::None) return reject;
  }
  return Reject::None;
}

Reject readEvents(const events_t& wire, EventsMessage& message) {
  std::size_t point = 0;
  const Reject reject = wire::readRows(
      wire, kEvent, &events_t::num_events, message.events, [&](ToldEvent& told, std::size_t) {
        const Reject wrong = settle(told);
        return wrong == Reject::None ? readPoints(wire, point, told.event) : wrong;
      });
  if (reject != Reject::None) return reject;
  return point == countOf(wire.num_points) ? Reject::None : Reject::BadIndex;
}

void writeEvents(const EventsMessage& message, events_t& wire) {
  std::size_t numPoints = 0, point = 0;
  for (const ToldEvent& told : message.events) numPoints += told.event.numPoints;
  wire::writeRows(message.events, kEvent, &events_t::num_events, wire);
  wire::resize(numPoints, kPoint, &events_t::num_points, wire);
  for (std::size_t i = 0; i < message.events.size(); ++i) {
    const WorldEvent& event = message.events[i].event;
    wire.reasons[i] = static_cast<std::uint8_t>(wireReasonOf(message.events[i]));
    if (!std::isfinite(event.effectiveMass)) wire.effective_mass[i] = kNoMass;
    for (std::size_t k = 0; k < event.numPoints; ++k) {
      wire::write(event.points[k], kPoint, wire, point++);
    }
  }
}

}  // namespace

Reject decode(ByteView payload, EventsMessage& message) {
  auto& wire = wire::scratch<events_t>();
  Reject reject = fromBytes(PayloadType::Events, payload, wire);
  if (reject == Reject::None) reject = wire::read(wire, kEventsHead, message);
  if (reject == Reject::None) reject = checkHead(wire);
  if (reject != Reject::None) return reject;
  reject = wire::readRows(wire, kToldBody, &events_t::num_bodies, message.bodies,
                          [&](const ToldBody& told, std::size_t i) {
                            const bool isNext = i == 0 || told.body > message.bodies[i - 1].body;
                            return isNext ? Reject::None : Reject::BadIndex;
                          });
  if (reject != Reject::None) return reject;
  reject = wire::readRows(wire, kUnknownPart, &events_t::num_unknown, message.unknown,
                          [&](const UnknownPart& part, std::size_t) {
                            const bool isInside = wire.window_from <= part.fromUs &&
                                                  part.fromUs <= part.toUs &&
                                                  part.toUs <= wire.window_to;
                            return isInside ? Reject::None : Reject::OutOfRange;
                          });
  return reject == Reject::None ? readEvents(wire, message) : reject;
}

void encode(const EventsMessage& message, Bytes& payload) {
  FORETOUCH_ASSERT(message.events.size() <= kMaxToldEvents);
  FORETOUCH_ASSERT(message.bodies.size() <= kMaxToldBodies);
  FORETOUCH_ASSERT(message.unknown.size() <= kMaxToldUnknown);
  auto& wire = wire::scratch<events_t>();
  wire::write(message, kEventsHead, wire);
  wire::writeRows(message.bodies, kToldBody, &events_t::num_bodies, wire);
  wire::writeRows(message.unknown, kUnknownPart, &events_t::num_unknown, wire);
  writeEvents(message, wire);
  toBytes(PayloadType::Events, wire, payload);
}

}  // namespace foretouch
