#include <cstddef>
#include <tuple>

#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/message_fields.h"

namespace foretouch {
namespace {

constexpr auto kStatus =
    std::tuple_cat(wire::kStatus, wire::kStatusFailures, wire::kStatusLatency, wire::kStatusQuery);

}  // namespace

Reject decode(ByteView payload, StatusMessage& message) {
  status_t wire;
  Reject reject = fromBytes(PayloadType::Status, payload, wire);
  if (reject == Reject::None) reject = wire::read(wire, kStatus, message);
  if (reject != Reject::None) return reject;
  return wire::readRows(wire, wire::kStatusReason, &status_t::num_reasons, message.counts,
                        wire::kAnyRow);
}

void encode(const StatusMessage& message, Bytes& payload) {
  status_t wire;
  wire::write(message, kStatus, wire);
  wire::writeRows(message.counts, wire::kStatusReason, &status_t::num_reasons, wire);
  toBytes(PayloadType::Status, wire, payload);
}

}  // namespace foretouch
