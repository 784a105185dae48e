#include <cstddef>
#include <foretouch/status_t.hpp>
#include <utility>

#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"

namespace foretouch {
namespace {

Reject check(const status_t& wire) {
  const bool integers =
      inRange({wire.utime, wire.start_utime, wire.num_avatars, wire.num_workers}) &&
      inRange({wire.received, wire.answered, wire.rejected, wire.lost, wire.gaps, wire.waiting}) &&
      inRange({wire.publish_failures, wire.journal_failures, wire.kernel_drops});
  if (!integers) return Reject::OutOfRange;
  for (std::size_t i = 0; i < static_cast<std::size_t>(wire.num_reasons); ++i) {
    if (!inRange({wire.counts[i]})) return Reject::OutOfRange;
  }
  for (const double duration : {wire.latency_p50, wire.latency_p99, wire.latency_max,
                                wire.query_p50, wire.query_p99, wire.query_max}) {
    if (!std::isfinite(duration)) return Reject::NonFinite;
    if (duration < 0.0) return Reject::OutOfRange;
  }
  return Reject::None;
}

void readCounts(status_t& wire, StatusMessage& message) {
  message.received = wire.received;
  message.answered = wire.answered;
  message.rejected = wire.rejected;
  message.lost = wire.lost;
  message.gaps = wire.gaps;
  message.waiting = wire.waiting;
  message.publishFailures = wire.publish_failures;
  message.journalFailures = wire.journal_failures;
  message.kernelDrops = wire.kernel_drops;
  message.counts.resize(static_cast<std::size_t>(wire.num_reasons));
  for (std::size_t i = 0; i < message.counts.size(); ++i) {
    message.counts[i] = {std::move(wire.reasons[i]), wire.counts[i]};
  }
}

void writeCounts(const StatusMessage& message, status_t& wire) {
  wire.received = message.received;
  wire.answered = message.answered;
  wire.rejected = message.rejected;
  wire.lost = message.lost;
  wire.gaps = message.gaps;
  wire.waiting = message.waiting;
  wire.publish_failures = message.publishFailures;
  wire.journal_failures = message.journalFailures;
  wire.kernel_drops = message.kernelDrops;
  wire.num_reasons = static_cast<std::int32_t>(message.counts.size());
  for (const StatusMessage::Count& count : message.counts) {
    wire.reasons.push_back(count.reason);
    wire.counts.push_back(count.count);
  }
}

}  // namespace

Reject decode(ByteView payload, StatusMessage& message) {
  status_t wire;
  Reject reject = fromBytes(PayloadType::Status, payload, wire);
  if (reject == Reject::None) reject = check(wire);
  if (reject != Reject::None) return reject;
  message.utimeUs = wire.utime;
  message.startUtimeUs = wire.start_utime;
  message.build = wire.build;
  message.scene = wire.scene;
  message.numAvatars = wire.num_avatars;
  message.numWorkers = wire.num_workers;
  readCounts(wire, message);
  message.latencyP50Us = wire.latency_p50;
  message.latencyP99Us = wire.latency_p99;
  message.latencyMaxUs = wire.latency_max;
  message.queryP50Us = wire.query_p50;
  message.queryP99Us = wire.query_p99;
  message.queryMaxUs = wire.query_max;
  return Reject::None;
}

void encode(const StatusMessage& message, Bytes& payload) {
  status_t wire;
  wire.version = kMessageVersion;
  wire.utime = message.utimeUs;
  wire.start_utime = message.startUtimeUs;
  wire.build = message.build;
  wire.scene = message.scene;
  wire.num_avatars = message.numAvatars;
  wire.num_workers = message.numWorkers;
  writeCounts(message, wire);
  wire.latency_p50 = message.latencyP50Us;
  wire.latency_p99 = message.latencyP99Us;
  wire.latency_max = message.latencyMaxUs;
  wire.query_p50 = message.queryP50Us;
  wire.query_p99 = message.queryP99Us;
  wire.query_max = message.queryMaxUs;
  toBytes(PayloadType::Status, wire, payload);
}

}  // namespace foretouch
