// network/service/service_counts.h: a service's counts since it started, as plain values, and the
// one place where its threads count. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>

#include "network/service/latency_histogram.h"
#include "network/wire/messages.h"
#include "network/wire/wire.h"

namespace foretouch {

/// Facts that do not change while a service runs.
struct ServiceFacts {
  std::string build, scene;
  std::size_t numAvatars = 0;
  int numWorkers = 0;
  std::int64_t startUtimeUs = 0;
};

/// The counts at one moment; at every moment received == answered + rejected() + waiting.
struct ServiceCounts {
  std::uint64_t received = 0;  ///< Poses, accepted or not.
  std::uint64_t answered = 0;  ///< One contacts_t per accepted pose, even if sending it failed.
  std::uint64_t waiting = 0;   ///< In the mailboxes, or in work.
  std::uint64_t lost = 0;      ///< Poses that never came, by the gaps in sequence.
  std::uint64_t gaps = 0;      ///< Answers across a gap.
  std::uint64_t vastGaps = 0;  ///< Those across more than kMostCountedLost poses: not in `lost`.
  std::uint64_t skeletons = 0;
  RejectCounts rejects{};          ///< Refused poses.
  RejectCounts skeletonRejects{};  ///< Refused skeletons.
  std::uint64_t publishFailures = 0, journalFailures = 0;
  std::uint64_t unrecorded = 0;  ///< Refused messages that the log leaves out on purpose.
  WireCounts wire;
  std::int64_t lastPoseUtimeUs = 0;  ///< When the last pose arrived; 0: none has.

  [[nodiscard]] std::uint64_t rejected() const;
};

/// Latencies of the answers in some span of time.
struct AnswerTimes {
  LatencyHistogram latency;  ///< From receiving the pose to having sent its answer.
  LatencyHistogram query;    ///< The query's part of it.
};

class ServiceCounter {
 public:
  void receivedPose(std::int64_t utimeUs);
  /// For a pose that was received.
  void rejectedPose(Reject reason);
  void answeredPose(double latencyUs, double queryUs);
  void receivedSkeleton();
  void rejectedSkeleton(Reject reason);
  void lostPoses(std::uint64_t lost, std::uint64_t gaps, std::uint64_t vastGaps);
  void leftOut();
  /// How long poses for avatars of the service have come and none was accepted; 0 if one was since
  /// the last refusal, or if none has come for `idleMs`.
  [[nodiscard]] std::int64_t unacceptedMs(std::int64_t idleMs) const;
  void failedPublish();
  void failedJournal();
  void wire(const WireCounts& counts);

  [[nodiscard]] ServiceCounts counts() const;
  /// The times since the start.
  [[nodiscard]] AnswerTimes times() const;
  /// The times since the last call of this.
  [[nodiscard]] AnswerTimes takeRecentTimes();

 private:
  mutable std::mutex mutex_;
  ServiceCounts counts_;
  AnswerTimes all_, recent_;
  // Refused poses since the last accepted one (steady clock, ms).
  bool isUnaccepted_ = false;
  std::int64_t firstRefusedMs_ = 0, lastRefusedMs_ = 0;
};

}  // namespace foretouch
