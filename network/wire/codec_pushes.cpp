#include <cstddef>
#include <foretouch/pushes_t.hpp>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/push_fields.h"
#include "network/wire/world_messages.h"

namespace foretouch {
namespace {

// The largest message fits.
static_assert((kMaxToldPushes + kMaxToldCrushes) * (kMaxNameBytes + 5 + 4 * 4 + 9 * 8) + 1024 <=
              kMaxMessageBytes);

using wire::field;
using wire::in;

constexpr auto kPushesHead = std::make_tuple(
    field(&PushesMessage::avatar, &pushes_t::avatar, wire::indexFrom(0)),
    field(&PushesMessage::session, &pushes_t::session, wire::kWhole),
    field(&PushesMessage::sequence, &pushes_t::sequence, wire::kWhole),
    field(&PushesMessage::utimeUs, &pushes_t::utime, wire::kWhole),
    field(&PushesMessage::stepUs, &pushes_t::step_us, wire::kWhole),
    field(&PushesMessage::timeline, &pushes_t::timeline, wire::kWhole),
    field(&PushesMessage::isAssumed, &pushes_t::assumed, wire::kFlag),
    field(&PushesMessage::contactsLeftOut, &pushes_t::contacts_left_out, wire::kWhole),
    field(&PushesMessage::crushesLeftOut, &pushes_t::crushes_left_out, wire::kWhole),
    field(&PushesMessage::receiveUtimeUs, &pushes_t::receive_utime, wire::kWhole),
    field(&PushesMessage::sendUtimeUs, &pushes_t::send_utime, wire::kWhole),
    field(&PushesMessage::tickUs, &pushes_t::tick_us, wire::kNotNegative));

constexpr auto kPush =
    std::tuple_cat(wire::pushFields<pushes_t>(&ToldPush::contact, &ToldPush::linkName),
                   std::make_tuple(field(in(&ToldPush::contact, &SolidBodyContact::body),
                                         &pushes_t::bodies, wire::kAny)));

constexpr auto kCrush = std::make_tuple(
    field(in(&ToldCrush::crush, &SolidCrush::body), &pushes_t::crushers, wire::kAny),
    field(in(&ToldCrush::crush, &SolidCrush::link), &pushes_t::crushed_links, wire::kAny),
    field(&ToldCrush::linkName, &pushes_t::crushed_names, wire::kJointName),
    field(in(&ToldCrush::crush, &SolidCrush::sinceUs), &pushes_t::crushed_since, wire::kWhole),
    field(in(&ToldCrush::crush, &SolidCrush::isOver), &pushes_t::over, wire::kFlag),
    field(in(&ToldCrush::crush, &SolidCrush::depth), &pushes_t::depth, wire::kNotNegative));

/// A link of a body, and another body.
template <typename Met>
Reject checkPair(const PushesMessage& message, const Met& met) {
  const bool isPair =
      met.link >= 0 && met.link < kMaxJoints && met.body >= 0 && met.body != message.avatar;
  return isPair ? Reject::None : Reject::BadIndex;
}

}  // namespace

Reject decode(ByteView payload, PushesMessage& message) {
  auto& wire = wire::scratch<pushes_t>();
  Reject reject = fromBytes(PayloadType::Pushes, payload, wire);
  if (reject == Reject::None) reject = wire::read(wire, kPushesHead, message);
  if (reject != Reject::None) return reject;
  if (countOf(wire.num_contacts) > kMaxToldPushes || countOf(wire.num_crushes) > kMaxToldCrushes) {
    return Reject::Limit;
  }
  reject = wire::readRows(
      wire, kPush, &pushes_t::num_contacts, message.contacts,
      [&](const ToldPush& told, std::size_t) { return checkPair(message, told.contact); });
  if (reject != Reject::None) return reject;
  return wire::readRows(
      wire, kCrush, &pushes_t::num_crushes, message.crushes,
      [&](const ToldCrush& told, std::size_t) { return checkPair(message, told.crush); });
}

void encode(const PushesMessage& message, Bytes& payload) {
  FORETOUCH_ASSERT(message.contacts.size() <= kMaxToldPushes);
  FORETOUCH_ASSERT(message.crushes.size() <= kMaxToldCrushes);
  auto& wire = wire::scratch<pushes_t>();
  wire::write(message, kPushesHead, wire);
  wire::writeRows(message.contacts, kPush, &pushes_t::num_contacts, wire);
  wire::writeRows(message.crushes, kCrush, &pushes_t::num_crushes, wire);
  toBytes(PayloadType::Pushes, wire, payload);
}

}  // namespace foretouch
