#include <cmath>
#include <limits>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/world_message_fields.h"

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

constexpr auto kEvents =
    std::tuple_cat(wire::kEvents, wire::kEventsOptions, wire::kEventsWindow, wire::kEventsStamps);
constexpr auto kEvent = std::tuple_cat(wire::kEventKind, wire::kEventTimes, wire::kEventA,
                                       wire::kEventB, wire::kEventObject, wire::kEvent);

Reject checkHead(const events_t& wire) {
  if (wire.window_from > wire.window_to) return Reject::OutOfRange;
  return countOf(wire.num_events) <= kMaxToldEvents ? Reject::None : Reject::Limit;
}

/// Readers from before LeaveCause::Moved know three causes, and refuse others. They look only at
/// the reason of what is unresolved, so the reason of a LEAVE can say whether it is a Moved.
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
    const Reject reject = wire::read(wire, wire::kEventPoint, event.points[k], point);
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
  wire::resize(numPoints, wire::kEventPoint, &events_t::num_points, wire);
  for (std::size_t i = 0; i < message.events.size(); ++i) {
    const WorldEvent& event = message.events[i].event;
    wire.reasons[i] = static_cast<std::uint8_t>(wireReasonOf(message.events[i]));
    if (!std::isfinite(event.effectiveMass)) wire.effective_mass[i] = kNoMass;
    for (std::size_t k = 0; k < event.numPoints; ++k) {
      wire::write(event.points[k], wire::kEventPoint, wire, point++);
    }
  }
}

}  // namespace

Reject decode(ByteView payload, EventsMessage& message) {
  auto& wire = wire::scratch<events_t>();
  Reject reject = fromBytes(PayloadType::Events, payload, wire);
  if (reject == Reject::None) reject = wire::read(wire, kEvents, message);
  if (reject == Reject::None) reject = checkHead(wire);
  if (reject != Reject::None) return reject;
  reject = wire::readRows(wire, wire::kToldBody, &events_t::num_bodies, message.bodies,
                          [&](const ToldBody& told, std::size_t i) {
                            const bool isNext = i == 0 || told.body > message.bodies[i - 1].body;
                            return isNext ? Reject::None : Reject::BadIndex;
                          });
  if (reject != Reject::None) return reject;
  reject = wire::readRows(wire, wire::kUnknownPart, &events_t::num_unknown, message.unknown,
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
  wire::write(message, kEvents, wire);
  wire::writeRows(message.bodies, wire::kToldBody, &events_t::num_bodies, wire);
  wire::writeRows(message.unknown, wire::kUnknownPart, &events_t::num_unknown, wire);
  writeEvents(message, wire);
  toBytes(PayloadType::Events, wire, payload);
}

}  // namespace foretouch
