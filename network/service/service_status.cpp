#include "network/service/service_status.h"

#include <string>
#include <vector>

namespace foretouch {
namespace {

void addReasons(const ServiceCounts& counts, std::vector<StatusMessage::Count>& reasons) {
  const auto add = [&](const std::string& reason, std::uint64_t count) {
    if (count > 0) reasons.push_back({reason, static_cast<std::int64_t>(count)});
  };
  for (std::size_t i = 0; i < kNumRejects; ++i) {
    add(toString(static_cast<Reject>(i)), counts.rejects[i] + counts.skeletonRejects[i]);
  }
  add("datagram-foreign", counts.wire.foreign);
  for (std::size_t i = 0; i < kNumDatagramFaults; ++i) {
    add(std::string("datagram-") + toString(static_cast<DatagramFault>(i)),
        i == 0 ? 0 : counts.wire.faults[i]);
  }
}

/// In the list of counts, as status_t has no other place: its fields are out.
void addWorld(const WorldCounts& world, std::vector<StatusMessage::Count>& reasons) {
  const auto add = [&](const std::string& what, std::uint64_t count) {
    reasons.push_back({"world-" + what, static_cast<std::int64_t>(count)});
  };
  add("bodies", world.bodies);
  add("advances", world.advances);
  add("taken", world.taken);
  add("waiting", world.waiting);
  add("silent", world.silent);
  if (world.silences > 0) add("silences", world.silences);
  if (world.gaps > 0) add("gaps", world.gaps);
  if (world.lateChanges > 0) add("late-changes", world.lateChanges);
  if (world.forgotten > 0) add("forgotten", world.forgotten);
  if (world.failures > 0) add("failures", world.failures);
  if (world.refusedBodies > 0) add("refused-bodies", world.refusedBodies);
  for (const RefusedBody& body : world.refusedLongest) {
    add("refused-body-" + std::to_string(body.body) + "-" + toString(body.reason), body.poses);
  }
  for (std::size_t i = 1; i < kNumRejects; ++i) {
    if (world.rejects[i] == 0) continue;
    add(std::string("refused-") + toString(static_cast<Reject>(i)), world.rejects[i]);
  }
}

void addTimes(const AnswerTimes& recent, StatusMessage& message) {
  constexpr double kMedian = 0.5, kTail = 0.99;
  message.latencyP50Us = recent.latency.quantileUs(kMedian);
  message.latencyP99Us = recent.latency.quantileUs(kTail);
  message.latencyMaxUs = recent.latency.maxUs();
  message.queryP50Us = recent.query.quantileUs(kMedian);
  message.queryP99Us = recent.query.quantileUs(kTail);
  message.queryMaxUs = recent.query.maxUs();
}

}  // namespace

StatusMessage statusOf(const ServiceFacts& facts, const ServiceCounts& counts,
                       const AnswerTimes& recent, std::int64_t utimeUs, const WorldCounts* world) {
  StatusMessage message;
  message.utimeUs = utimeUs;
  message.startUtimeUs = facts.startUtimeUs;
  message.build = facts.build;
  message.scene = facts.scene;
  message.numAvatars = static_cast<std::int32_t>(facts.numAvatars);
  message.numWorkers = facts.numWorkers;
  const auto whole = [](std::uint64_t count) { return static_cast<std::int64_t>(count); };
  message.received = whole(counts.received);
  message.answered = whole(counts.answered);
  message.rejected = whole(counts.rejected());
  message.lost = whole(counts.lost);
  message.gaps = whole(counts.gaps);
  message.waiting = whole(counts.waiting);
  message.publishFailures = whole(counts.publishFailures);
  message.journalFailures = whole(counts.journalFailures);
  message.kernelDrops = whole(counts.wire.kernelDrops);
  addReasons(counts, message.counts);
  if (world != nullptr) addWorld(*world, message.counts);
  addTimes(recent, message);
  return message;
}

}  // namespace foretouch
