#include "network/service/service_counts.h"

#include <numeric>

#include "lss/index.h"

namespace foretouch {

std::uint64_t ServiceCounts::rejected() const {
  return std::accumulate(rejects.begin(), rejects.end(), std::uint64_t{0});
}

void ServiceCounter::receivedPose(std::int64_t utimeUs) {
  const std::lock_guard lock(mutex_);
  ++counts_.received;
  ++counts_.waiting;
  counts_.lastPoseUtimeUs = utimeUs;
}

void ServiceCounter::rejectedPose(Reject reason) {
  const std::lock_guard lock(mutex_);
  ++counts_.rejects[slotOf(reason)];
  --counts_.waiting;
}

void ServiceCounter::answeredPose(double latencyUs, double queryUs) {
  const std::lock_guard lock(mutex_);
  ++counts_.answered;
  --counts_.waiting;
  for (AnswerTimes* times : {&all_, &recent_}) {
    times->latency.record(latencyUs);
    times->query.record(queryUs);
  }
}

void ServiceCounter::receivedSkeleton() {
  const std::lock_guard lock(mutex_);
  ++counts_.skeletons;
}

void ServiceCounter::rejectedSkeleton(Reject reason) {
  const std::lock_guard lock(mutex_);
  ++counts_.skeletonRejects[slotOf(reason)];
}

void ServiceCounter::lostPoses(std::uint64_t lost, std::uint64_t gaps) {
  const std::lock_guard lock(mutex_);
  counts_.lost += lost;
  counts_.gaps += gaps;
}

void ServiceCounter::failedPublish() {
  const std::lock_guard lock(mutex_);
  ++counts_.publishFailures;
}

void ServiceCounter::failedJournal() {
  const std::lock_guard lock(mutex_);
  ++counts_.journalFailures;
}

void ServiceCounter::wire(const WireCounts& counts) {
  const std::lock_guard lock(mutex_);
  counts_.wire = counts;
}

ServiceCounts ServiceCounter::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

AnswerTimes ServiceCounter::times() const {
  const std::lock_guard lock(mutex_);
  return all_;
}

AnswerTimes ServiceCounter::takeRecentTimes() {
  const std::lock_guard lock(mutex_);
  const AnswerTimes taken = recent_;
  recent_ = AnswerTimes();
  return taken;
}

}  // namespace foretouch
