#include <foretouch/speaker_t.hpp>

#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"

namespace foretouch {

Reject decode(ByteView payload, SpeakerMessage& message) {
  constexpr std::int32_t kMostPort = 65535;
  speaker_t wire;
  const Reject reject = fromBytes(PayloadType::Speaker, payload, wire);
  if (reject != Reject::None) return reject;
  if (!inRange({wire.avatar, wire.utime, wire.port}) || wire.port > kMostPort) {
    return Reject::OutOfRange;
  }
  message.avatar = wire.avatar;
  message.utimeUs = wire.utime;
  message.address = static_cast<std::uint32_t>(wire.address);
  message.port = static_cast<std::uint16_t>(wire.port);
  return Reject::None;
}

void encode(const SpeakerMessage& message, Bytes& payload) {
  speaker_t wire;
  wire.version = kMessageVersion;
  wire.avatar = message.avatar;
  wire.utime = message.utimeUs;
  wire.address = static_cast<std::int32_t>(message.address);
  wire.port = message.port;
  toBytes(PayloadType::Speaker, wire, payload);
}

}  // namespace foretouch
