#include <cstddef>
#include <foretouch/status_t.hpp>
#include <tuple>

#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/wire_fields.h"

namespace foretouch {
namespace {

using wire::field;

constexpr auto kStatusHead = std::make_tuple(
    field(&StatusMessage::utimeUs, &status_t::utime, wire::kWhole),
    field(&StatusMessage::startUtimeUs, &status_t::start_utime, wire::kWhole),
    field(&StatusMessage::build, &status_t::build, wire::kAny),
    field(&StatusMessage::scene, &status_t::scene, wire::kAny),
    field(&StatusMessage::numAvatars, &status_t::num_avatars, wire::kWhole),
    field(&StatusMessage::numWorkers, &status_t::num_workers, wire::kWhole),
    field(&StatusMessage::received, &status_t::received, wire::kWhole),
    field(&StatusMessage::answered, &status_t::answered, wire::kWhole),
    field(&StatusMessage::rejected, &status_t::rejected, wire::kWhole),
    field(&StatusMessage::lost, &status_t::lost, wire::kWhole),
    field(&StatusMessage::gaps, &status_t::gaps, wire::kWhole),
    field(&StatusMessage::waiting, &status_t::waiting, wire::kWhole),
    field(&StatusMessage::publishFailures, &status_t::publish_failures, wire::kWhole),
    field(&StatusMessage::journalFailures, &status_t::journal_failures, wire::kWhole),
    field(&StatusMessage::kernelDrops, &status_t::kernel_drops, wire::kWhole),
    field(&StatusMessage::latencyP50Us, &status_t::latency_p50, wire::kNotNegative),
    field(&StatusMessage::latencyP99Us, &status_t::latency_p99, wire::kNotNegative),
    field(&StatusMessage::latencyMaxUs, &status_t::latency_max, wire::kNotNegative),
    field(&StatusMessage::queryP50Us, &status_t::query_p50, wire::kNotNegative),
    field(&StatusMessage::queryP99Us, &status_t::query_p99, wire::kNotNegative),
    field(&StatusMessage::queryMaxUs, &status_t::query_max, wire::kNotNegative));

constexpr auto kReason =
    std::make_tuple(field(&StatusMessage::Count::reason, &status_t::reasons, wire::kAny),
                    field(&StatusMessage::Count::count, &status_t::counts, wire::kWhole));

}  // namespace

Reject decode(ByteView payload, StatusMessage& message) {
  status_t wire;
  Reject reject = fromBytes(PayloadType::Status, payload, wire);
  if (reject == Reject::None) reject = wire::read(wire, kStatusHead, message);
  if (reject != Reject::None) return reject;
  return wire::readRows(wire, kReason, &status_t::num_reasons, message.counts, wire::kAnyRow);
}

void encode(const StatusMessage& message, Bytes& payload) {
  status_t wire;
  wire::write(message, kStatusHead, wire);
  wire::writeRows(message.counts, kReason, &status_t::num_reasons, wire);
  toBytes(PayloadType::Status, wire, payload);
}

}  // namespace foretouch
