#include <foretouch/speaker_t.hpp>
#include <limits>
#include <tuple>

#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/wire_fields.h"

namespace foretouch {
namespace {

constexpr auto kSpeaker =
    std::make_tuple(wire::field(&SpeakerMessage::avatar, &speaker_t::avatar, wire::kWhole),
                    wire::field(&SpeakerMessage::utimeUs, &speaker_t::utime, wire::kWhole),
                    wire::field(&SpeakerMessage::address, &speaker_t::address, wire::kAny),
                    wire::field(&SpeakerMessage::port, &speaker_t::port,
                                wire::Whole{0, std::numeric_limits<std::uint16_t>::max()}));

}  // namespace

Reject decode(ByteView payload, SpeakerMessage& message) {
  auto& wire = wire::scratch<speaker_t>();
  const Reject reject = fromBytes(PayloadType::Speaker, payload, wire);
  return reject == Reject::None ? wire::read(wire, kSpeaker, message) : reject;
}

void encode(const SpeakerMessage& message, Bytes& payload) {
  auto& wire = wire::scratch<speaker_t>();
  wire::write(message, kSpeaker, wire);
  toBytes(PayloadType::Speaker, wire, payload);
}

}  // namespace foretouch
