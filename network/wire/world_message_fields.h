// network/wire/world_message_fields.h: the fields of the messages of world_messages.h, as
// message_fields.h has those of messages.h.
#pragma once

#include <cstddef>
#include <foretouch/events_t.hpp>
#include <foretouch/pushes_t.hpp>
#include <tuple>

#include "network/wire/message_fields.h"
#include "network/wire/world_messages.h"

namespace foretouch::wire {

// Events.

inline constexpr auto kEvents =
    std::make_tuple(field(&EventsMessage::timeline, &events_t::timeline, kWhole),
                    field(&EventsMessage::sequence, &events_t::sequence, kWhole),
                    field(&EventsMessage::hasMore, &events_t::more, kFlag));
inline constexpr auto kEventsOptions = std::make_tuple(
    field("tolerance", &EventsMessage::tolerance, &events_t::tolerance, kNotNegative));
inline constexpr auto kEventsWindow =
    std::make_tuple(field("window_from", &EventsMessage::fromUs, &events_t::window_from, kWhole),
                    field("window_to", &EventsMessage::toUs, &events_t::window_to, kWhole));
inline constexpr auto kEventsStamps =
    stamps("world_us", &EventsMessage::worldUs, &events_t::world_us);

inline constexpr auto kToldBody = std::make_tuple(
    field(&ToldBody::body, &events_t::bodies, indexFrom(0)),
    field("known_until", &ToldBody::knownUntilUs, &events_t::known_until, Whole{-1}),
    field("waiting", &ToldBody::isWaitedFor, &events_t::waiting, kFlag));

inline constexpr auto kUnknownPart = std::make_tuple(
    field(&UnknownPart::body, &events_t::unknown_bodies, indexFrom(kEveryBody)),
    field(&UnknownPart::link, &events_t::unknown_links, indexFrom(kEveryLink, kMaxJoints - 1)),
    field(&UnknownPart::reason, &events_t::unknown_reasons, Whole{1, kNumUndecidedReasons - 1}),
    field(&UnknownPart::fromUs, &events_t::unknown_from, kWhole),
    field(&UnknownPart::toUs, &events_t::unknown_to, kWhole));

template <typename Member>
constexpr auto ofEvent(Member member) {
  return in(&ToldEvent::event, member);
}
template <typename Numbers, typename Points>
constexpr auto sideFields(ContactSide WorldEvent::*side, Numbers body, Numbers link, Numbers lss,
                          Numbers triangle, Points x, Points y, Points z) {
  const auto of = ofEvent(side);
  return std::make_tuple(
      field("body", in(of, &ContactSide::body), body, indexFrom(kEveryBody)),
      field("link", in(of, &ContactSide::link), link, indexFrom(kEveryLink, kMaxJoints - 1)),
      field("lss", in(of, &ContactSide::lss), lss, indexFrom(-1)),
      field("triangle", in(of, &ContactSide::triangle), triangle, indexFrom(-1)),
      field("point", in(of, &ContactSide::p_W), x, y, z, kFinite));
}
inline constexpr auto kEventKind = std::make_tuple(
    field("kind", ofEvent(&WorldEvent::kind), &events_t::kinds, codeBelow(kNumEventKinds)));
inline constexpr auto kEventObject = std::make_tuple(
    field("object", ofEvent(&WorldEvent::object), &events_t::object, indexFrom(-1)));
inline constexpr Real kPartOfMicrosecond{0.0, 0x1.fffffffffffffp-1};  // below 1
inline constexpr auto kEventTimes = std::make_tuple(
    field(in(ofEvent(&WorldEvent::time), &WorldTime::us), &events_t::utime, kWhole),
    field(in(ofEvent(&WorldEvent::time), &WorldTime::fraction), &events_t::fraction,
          kPartOfMicrosecond),
    field(in(ofEvent(&WorldEvent::since), &WorldTime::us), &events_t::since_utime, kWhole),
    field(in(ofEvent(&WorldEvent::since), &WorldTime::fraction), &events_t::since_fraction,
          kPartOfMicrosecond));
inline constexpr auto kEventA = sideFields(
    &WorldEvent::a, &events_t::body_a, &events_t::link_a, &events_t::lss_a, &events_t::triangle_a,
    &events_t::point_a_x, &events_t::point_a_y, &events_t::point_a_z);
inline constexpr auto kEventB = sideFields(
    &WorldEvent::b, &events_t::body_b, &events_t::link_b, &events_t::lss_b, &events_t::triangle_b,
    &events_t::point_b_x, &events_t::point_b_y, &events_t::point_b_z);
inline constexpr auto kEvent = std::make_tuple(
    field("cause", &ToldEvent::cause, &events_t::causes, codeBelow(kNumToldCauses)),
    field("reason", ofEvent(&WorldEvent::reason), &events_t::reasons,
          codeBelow(kNumUndecidedReasons)),
    field("assumed", ofEvent(&WorldEvent::isAssumed), &events_t::marks, kFlag),
    field("separation", ofEvent(&WorldEvent::separation), &events_t::separation, kFinite),
    field("penetration", ofEvent(&WorldEvent::penetration), &events_t::penetration, kFinite),
    field("normal", ofEvent(&WorldEvent::nhat_BA_W), &events_t::normal_x, &events_t::normal_y,
          &events_t::normal_z, kUnit),
    field("velocity", ofEvent(&WorldEvent::velocity_W), &events_t::velocity_x,
          &events_t::velocity_y, &events_t::velocity_z, kFinite),
    field("approach", ofEvent(&WorldEvent::approachSpeed), &events_t::approach, kFinite),
    field("approach_lower", ofEvent(&WorldEvent::approachLower), &events_t::approach_lower,
          kFinite),
    field("approach_upper", ofEvent(&WorldEvent::approachUpper), &events_t::approach_upper,
          kFinite),
    field("effective_mass", ofEvent(&WorldEvent::effectiveMass), &events_t::effective_mass,
          kFinite),
    field("points", ofEvent(&WorldEvent::numPoints), &events_t::numbers_of_points,
          Whole{0, WorldEvent::kMostPoints, Reject::Limit}));

inline constexpr auto kEventPoint =
    std::make_tuple(field(&EventPoint::p_WA, &events_t::near_a_x, &events_t::near_a_y,
                          &events_t::near_a_z, kFinite),
                    field(&EventPoint::p_WB, &events_t::near_b_x, &events_t::near_b_y,
                          &events_t::near_b_z, kFinite),
                    field(&EventPoint::separation, &events_t::near_separation, kFinite));

// Pushes.

inline constexpr auto kPushesKey = std::tuple_cat(
    poseKey<PushesMessage, pushes_t>(indexFrom(0)),
    std::make_tuple(field("step_us", &PushesMessage::stepUs, &pushes_t::step_us, kWhole)));
inline constexpr auto kPushes =
    std::make_tuple(field("timeline", &PushesMessage::timeline, &pushes_t::timeline, kWhole),
                    sparse("assumed", &PushesMessage::isAssumed, &pushes_t::assumed, kFlag));
inline constexpr auto kPushesLeftOut = std::make_tuple(sparse(
    "contacts_left_out", &PushesMessage::contactsLeftOut, &pushes_t::contacts_left_out, kWhole));
inline constexpr auto kCrushesLeftOut = std::make_tuple(sparse(
    "crushes_left_out", &PushesMessage::crushesLeftOut, &pushes_t::crushes_left_out, kWhole));
inline constexpr auto kPushesStamps = stamps("tick_us", &PushesMessage::tickUs, &pushes_t::tick_us);

inline constexpr auto kPush =
    std::tuple_cat(pushedLink<pushes_t>(&ToldPush::contact, &ToldPush::linkName),
                   std::make_tuple(field("body", in(&ToldPush::contact, &SolidBodyContact::body),
                                         &pushes_t::bodies, kAny)),
                   pushFields<pushes_t, SolidBodyContact>(&ToldPush::contact));
inline constexpr auto kCrush = std::make_tuple(
    field("body", in(&ToldCrush::crush, &SolidCrush::body), &pushes_t::crushers, kAny),
    field(in(&ToldCrush::crush, &SolidCrush::link), &pushes_t::crushed_links, kAny),
    field("link", &ToldCrush::linkName, &pushes_t::crushed_names, kJointName),
    field("since", in(&ToldCrush::crush, &SolidCrush::sinceUs), &pushes_t::crushed_since, kWhole),
    sparse("over", in(&ToldCrush::crush, &SolidCrush::isOver), &pushes_t::over, kFlag),
    field("depth", in(&ToldCrush::crush, &SolidCrush::depth), &pushes_t::depth, kNotNegative));

}  // namespace foretouch::wire
