#include <cmath>
#include <foretouch/events_t.hpp>
#include <initializer_list>
#include <limits>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
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

using Vector = Eigen::Vector3d;

Reject readHead(const events_t& wire, EventsMessage& message) {
  if (!inRange({wire.timeline, wire.sequence, wire.receive_utime, wire.send_utime}) ||
      !inRange({wire.window_from, wire.window_to}) || wire.window_from > wire.window_to) {
    return Reject::OutOfRange;
  }
  if (!allFinite({wire.tolerance, wire.world_us})) return Reject::NonFinite;
  if (wire.tolerance < 0.0 || wire.world_us < 0.0 || (wire.more != 0 && wire.more != 1)) {
    return Reject::OutOfRange;
  }
  if (countOf(wire.num_events) > kMaxToldEvents) return Reject::Limit;
  message.timeline = wire.timeline;
  message.sequence = wire.sequence;
  message.fromUs = wire.window_from;
  message.toUs = wire.window_to;
  message.hasMore = wire.more != 0;
  message.tolerance = wire.tolerance;
  message.receiveUtimeUs = wire.receive_utime;
  message.sendUtimeUs = wire.send_utime;
  message.worldUs = wire.world_us;
  return Reject::None;
}

Reject readBodies(const events_t& wire, EventsMessage& message) {
  message.bodies.resize(countOf(wire.num_bodies));
  for (std::size_t i = 0; i < message.bodies.size(); ++i) {
    ToldBody& told = message.bodies[i];
    told = {wire.bodies[i], wire.known_until[i], wire.waiting[i] != 0};
    if (told.body < 0 || (i > 0 && told.body <= message.bodies[i - 1].body)) {
      return Reject::BadIndex;
    }
    if (told.knownUntilUs < -1 || told.knownUntilUs > kMaxWireInteger || wire.waiting[i] > 1) {
      return Reject::OutOfRange;
    }
  }
  return Reject::None;
}

Reject readUnknown(const events_t& wire, EventsMessage& message) {
  message.unknown.resize(countOf(wire.num_unknown));
  for (std::size_t i = 0; i < message.unknown.size(); ++i) {
    const std::int64_t from = wire.unknown_from[i], to = wire.unknown_to[i];
    if (wire.unknown_bodies[i] < kEveryBody || wire.unknown_links[i] < kEveryLink ||
        wire.unknown_links[i] >= kMaxJoints) {
      return Reject::BadIndex;
    }
    const std::uint8_t reason = wire.unknown_reasons[i];
    if (reason == 0 || reason >= kNumUndecidedReasons || from < wire.window_from || from > to ||
        to > wire.window_to) {
      return Reject::OutOfRange;
    }
    message.unknown[i] = {wire.unknown_bodies[i], wire.unknown_links[i],
                          static_cast<UndecidedReason>(reason), from, to};
  }
  return Reject::None;
}

bool isSide(const ContactSide& side) {
  return side.body >= kEveryBody && side.link >= kEveryLink && side.link < kMaxJoints &&
         side.lss >= -1 && side.triangle >= -1;
}

Reject readSides(const events_t& wire, std::size_t i, WorldEvent& event) {
  event.a = {wire.body_a[i], wire.link_a[i], wire.lss_a[i], wire.triangle_a[i],
             Vector(wire.point_a_x[i], wire.point_a_y[i], wire.point_a_z[i])};
  event.b = {wire.body_b[i], wire.link_b[i], wire.lss_b[i], wire.triangle_b[i],
             Vector(wire.point_b_x[i], wire.point_b_y[i], wire.point_b_z[i])};
  event.object = wire.object[i];
  return isSide(event.a) && isSide(event.b) && event.object >= -1 ? Reject::None : Reject::BadIndex;
}

Reject readNumbers(const events_t& wire, std::size_t i, WorldEvent& event) {
  event.nhat_BA_W = {wire.normal_x[i], wire.normal_y[i], wire.normal_z[i]};
  event.velocity_W = {wire.velocity_x[i], wire.velocity_y[i], wire.velocity_z[i]};
  event.separation = wire.separation[i];
  event.penetration = wire.penetration[i];
  event.approachSpeed = wire.approach[i];
  event.approachLower = wire.approach_lower[i];
  event.approachUpper = wire.approach_upper[i];
  event.effectiveMass = wire.effective_mass[i];
  if (!event.nhat_BA_W.allFinite() || !event.velocity_W.allFinite() || !event.a.p_W.allFinite() ||
      !event.b.p_W.allFinite() ||
      !allFinite({event.separation, event.penetration, event.approachSpeed, event.approachLower,
                  event.approachUpper, event.effectiveMass})) {
    return Reject::NonFinite;
  }
  constexpr double kMostNormal = 1.0 + 1e-6;
  if (event.nhat_BA_W.norm() > kMostNormal ||
      (event.effectiveMass < 0.0 && event.effectiveMass != kNoMass)) {
    return Reject::OutOfRange;
  }
  if (event.effectiveMass < 0.0) event.effectiveMass = std::numeric_limits<double>::infinity();
  return Reject::None;
}

bool isTime(std::int64_t us, double fraction) {
  return us >= 0 && us <= kMaxWireInteger && fraction >= 0.0 && fraction < 1.0;
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

Reject readWhen(const events_t& wire, std::size_t i, ToldEvent& told) {
  if (!allFinite({wire.fraction[i], wire.since_fraction[i]})) return Reject::NonFinite;
  if (wire.kinds[i] >= kNumEventKinds || wire.causes[i] >= kNumToldCauses ||
      wire.reasons[i] >= kNumUndecidedReasons || wire.marks[i] > 1 ||
      !isTime(wire.utime[i], wire.fraction[i]) ||
      !isTime(wire.since_utime[i], wire.since_fraction[i])) {
    return Reject::OutOfRange;
  }
  told.event.kind = static_cast<EventKind>(wire.kinds[i]);
  told.cause = static_cast<ToldCause>(wire.causes[i]);
  told.event.cause = told.cause == ToldCause::NotAsked ? LeaveCause::NotAsked : LeaveCause::Apart;
  told.event.reason = static_cast<UndecidedReason>(wire.reasons[i]);
  if (isTornApart(told, told.event.reason)) {
    told.event.cause = LeaveCause::Moved;
    told.event.reason = UndecidedReason::None;
  }
  told.event.isAssumed = wire.marks[i] != 0;
  told.event.time = {wire.utime[i], wire.fraction[i]};
  told.event.since = {wire.since_utime[i], wire.since_fraction[i]};
  return Reject::None;
}

/// `point`: the first of the event's own, then of the next one's.
Reject readPoints(const events_t& wire, std::size_t i, std::size_t& point, WorldEvent& event) {
  event.points = {};
  event.numPoints = wire.numbers_of_points[i];
  if (event.numPoints > kMostPoints) return Reject::Limit;
  if (point + event.numPoints > countOf(wire.num_points)) return Reject::BadIndex;
  for (std::size_t k = 0; k < event.numPoints; ++k, ++point) {
    EventPoint& told = event.points[k];
    told.p_WA = {wire.near_a_x[point], wire.near_a_y[point], wire.near_a_z[point]};
    told.p_WB = {wire.near_b_x[point], wire.near_b_y[point], wire.near_b_z[point]};
    told.separation = wire.near_separation[point];
    if (!told.p_WA.allFinite() || !told.p_WB.allFinite() || !std::isfinite(told.separation)) {
      return Reject::NonFinite;
    }
  }
  return Reject::None;
}

Reject readEvents(const events_t& wire, EventsMessage& message) {
  std::size_t point = 0;
  message.events.resize(countOf(wire.num_events));
  for (std::size_t i = 0; i < message.events.size(); ++i) {
    ToldEvent& told = message.events[i];
    Reject reject = readWhen(wire, i, told);
    if (reject == Reject::None) reject = readSides(wire, i, told.event);
    if (reject == Reject::None) reject = readNumbers(wire, i, told.event);
    if (reject == Reject::None) reject = readPoints(wire, i, point, told.event);
    if (reject != Reject::None) return reject;
  }
  return point == countOf(wire.num_points) ? Reject::None : Reject::BadIndex;
}

void writeHead(const EventsMessage& message, events_t& wire) {
  wire.version = kMessageVersion;
  wire.timeline = message.timeline;
  wire.sequence = message.sequence;
  wire.window_from = message.fromUs;
  wire.window_to = message.toUs;
  wire.more = message.hasMore ? 1 : 0;
  wire.tolerance = message.tolerance;
  wire.receive_utime = message.receiveUtimeUs;
  wire.send_utime = message.sendUtimeUs;
  wire.world_us = message.worldUs;
}

void writeBodies(const EventsMessage& message, events_t& wire) {
  FORETOUCH_ASSERT(message.bodies.size() <= kMaxToldBodies);
  const std::size_t n = message.bodies.size();
  wire.num_bodies = static_cast<std::int32_t>(n);
  wire.bodies.resize(n);
  wire.known_until.resize(n);
  wire.waiting.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    wire.bodies[i] = message.bodies[i].body;
    wire.known_until[i] = message.bodies[i].knownUntilUs;
    wire.waiting[i] = message.bodies[i].isWaitedFor ? 1 : 0;
  }
}

void writeUnknown(const EventsMessage& message, events_t& wire) {
  FORETOUCH_ASSERT(message.unknown.size() <= kMaxToldUnknown);
  const std::size_t n = message.unknown.size();
  wire.num_unknown = static_cast<std::int32_t>(n);
  wire.unknown_bodies.resize(n);
  wire.unknown_links.resize(n);
  wire.unknown_reasons.resize(n);
  wire.unknown_from.resize(n);
  wire.unknown_to.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const UnknownPart& part = message.unknown[i];
    wire.unknown_bodies[i] = part.body;
    wire.unknown_links[i] = part.link;
    wire.unknown_reasons[i] = static_cast<std::uint8_t>(part.reason);
    wire.unknown_from[i] = part.fromUs;
    wire.unknown_to[i] = part.toUs;
  }
}

void resizeEvents(std::size_t n, std::size_t points, events_t& wire) {
  wire.num_events = static_cast<std::int32_t>(n);
  wire.num_points = static_cast<std::int32_t>(points);
  for (auto* const part :
       {&wire.kinds, &wire.causes, &wire.reasons, &wire.marks, &wire.numbers_of_points}) {
    part->resize(n);
  }
  for (auto* const part : {&wire.utime, &wire.since_utime}) part->resize(n);
  for (auto* const part : {&wire.body_a, &wire.link_a, &wire.lss_a, &wire.triangle_a, &wire.body_b,
                           &wire.link_b, &wire.lss_b, &wire.triangle_b, &wire.object}) {
    part->resize(n);
  }
  for (auto* const part :
       {&wire.fraction,    &wire.since_fraction, &wire.point_a_x,      &wire.point_a_y,
        &wire.point_a_z,   &wire.point_b_x,      &wire.point_b_y,      &wire.point_b_z,
        &wire.normal_x,    &wire.normal_y,       &wire.normal_z,       &wire.separation,
        &wire.penetration, &wire.velocity_x,     &wire.velocity_y,     &wire.velocity_z,
        &wire.approach,    &wire.approach_lower, &wire.approach_upper, &wire.effective_mass}) {
    part->resize(n);
  }
  for (auto* const part : {&wire.near_a_x, &wire.near_a_y, &wire.near_a_z, &wire.near_b_x,
                           &wire.near_b_y, &wire.near_b_z, &wire.near_separation}) {
    part->resize(points);
  }
}

void write(const Vector& vector, double& x, double& y, double& z) {
  x = vector.x();
  y = vector.y();
  z = vector.z();
}

void writeSides(const WorldEvent& event, std::size_t i, events_t& wire) {
  wire.body_a[i] = event.a.body;
  wire.link_a[i] = event.a.link;
  wire.lss_a[i] = event.a.lss;
  wire.triangle_a[i] = event.a.triangle;
  write(event.a.p_W, wire.point_a_x[i], wire.point_a_y[i], wire.point_a_z[i]);
  wire.body_b[i] = event.b.body;
  wire.link_b[i] = event.b.link;
  wire.lss_b[i] = event.b.lss;
  wire.triangle_b[i] = event.b.triangle;
  write(event.b.p_W, wire.point_b_x[i], wire.point_b_y[i], wire.point_b_z[i]);
  wire.object[i] = event.object;
}

void writeEvent(const ToldEvent& told, std::size_t i, std::size_t& point, events_t& wire) {
  const WorldEvent& event = told.event;
  wire.kinds[i] = static_cast<std::uint8_t>(event.kind);
  wire.causes[i] = static_cast<std::uint8_t>(told.cause);
  wire.reasons[i] = static_cast<std::uint8_t>(wireReasonOf(told));
  wire.marks[i] = event.isAssumed ? 1 : 0;
  wire.utime[i] = event.time.us;
  wire.fraction[i] = event.time.fraction;
  wire.since_utime[i] = event.since.us;
  wire.since_fraction[i] = event.since.fraction;
  writeSides(event, i, wire);
  write(event.nhat_BA_W, wire.normal_x[i], wire.normal_y[i], wire.normal_z[i]);
  write(event.velocity_W, wire.velocity_x[i], wire.velocity_y[i], wire.velocity_z[i]);
  wire.separation[i] = event.separation;
  wire.penetration[i] = event.penetration;
  wire.approach[i] = event.approachSpeed;
  wire.approach_lower[i] = event.approachLower;
  wire.approach_upper[i] = event.approachUpper;
  wire.effective_mass[i] = std::isfinite(event.effectiveMass) ? event.effectiveMass : kNoMass;
  wire.numbers_of_points[i] = static_cast<std::uint8_t>(event.numPoints);
  for (std::size_t k = 0; k < event.numPoints; ++k, ++point) {
    const EventPoint& near = event.points[k];
    write(near.p_WA, wire.near_a_x[point], wire.near_a_y[point], wire.near_a_z[point]);
    write(near.p_WB, wire.near_b_x[point], wire.near_b_y[point], wire.near_b_z[point]);
    wire.near_separation[point] = near.separation;
  }
}

/// Keeps its memory: a world has hundreds of windows per second.
events_t& scratch() {
  static thread_local events_t wire;
  return wire;
}

}  // namespace

Reject decode(ByteView payload, EventsMessage& message) {
  events_t& wire = scratch();
  Reject reject = fromBytes(PayloadType::Events, payload, wire);
  if (reject == Reject::None) reject = readHead(wire, message);
  if (reject == Reject::None) reject = readBodies(wire, message);
  if (reject == Reject::None) reject = readUnknown(wire, message);
  if (reject == Reject::None) reject = readEvents(wire, message);
  return reject;
}

void encode(const EventsMessage& message, Bytes& payload) {
  FORETOUCH_ASSERT(message.events.size() <= kMaxToldEvents);
  events_t& wire = scratch();
  writeHead(message, wire);
  writeBodies(message, wire);
  writeUnknown(message, wire);
  std::size_t points = 0;
  for (const ToldEvent& told : message.events) points += told.event.numPoints;
  resizeEvents(message.events.size(), points, wire);
  points = 0;
  for (std::size_t i = 0; i < message.events.size(); ++i) {
    writeEvent(message.events[i], i, points, wire);
  }
  toBytes(PayloadType::Events, wire, payload);
}

}  // namespace foretouch
