#include <cstddef>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/world_message_fields.h"

namespace foretouch {
namespace {

// The largest message fits.
static_assert((kMaxToldPushes + kMaxToldCrushes) * (kMaxNameBytes + 5 + 4 * 4 + 9 * 8) + 1024 <=
              kMaxMessageBytes);

constexpr auto kPushes = std::tuple_cat(wire::kPushesKey, wire::kPushes, wire::kPushesLeftOut,
                                        wire::kCrushesLeftOut, wire::kPushesStamps);

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
  if (reject == Reject::None) reject = wire::read(wire, kPushes, message);
  if (reject != Reject::None) return reject;
  if (countOf(wire.num_contacts) > kMaxToldPushes || countOf(wire.num_crushes) > kMaxToldCrushes) {
    return Reject::Limit;
  }
  reject = wire::readRows(
      wire, wire::kPush, &pushes_t::num_contacts, message.contacts,
      [&](const ToldPush& told, std::size_t) { return checkPair(message, told.contact); });
  if (reject != Reject::None) return reject;
  return wire::readRows(
      wire, wire::kCrush, &pushes_t::num_crushes, message.crushes,
      [&](const ToldCrush& told, std::size_t) { return checkPair(message, told.crush); });
}

void encode(const PushesMessage& message, Bytes& payload) {
  FORETOUCH_ASSERT(message.contacts.size() <= kMaxToldPushes);
  FORETOUCH_ASSERT(message.crushes.size() <= kMaxToldCrushes);
  auto& wire = wire::scratch<pushes_t>();
  wire::write(message, kPushes, wire);
  wire::writeRows(message.contacts, wire::kPush, &pushes_t::num_contacts, wire);
  wire::writeRows(message.crushes, wire::kCrush, &pushes_t::num_crushes, wire);
  toBytes(PayloadType::Pushes, wire, payload);
}

}  // namespace foretouch
