#include "network/service/service_counts.h"

#include <chrono>
#include <numeric>
#include <utility>

#include "lss/index.h"

namespace foretouch {
namespace {

std::int64_t steadyMs() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

}  // namespace

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
  // Poses of avatars of other services on the same network are not ours.
  const bool isOurs = reason != Reject::UnknownAvatar;
  const std::int64_t nowMs = steadyMs();
  const std::lock_guard lock(mutex_);
  if (isOurs && !std::exchange(isUnaccepted_, true)) firstRefusedMs_ = nowMs;
  if (isOurs) lastRefusedMs_ = nowMs;
  ++counts_.rejects[slotOf(reason)];
  --counts_.waiting;
}

void ServiceCounter::answeredPose(double latencyUs, double queryUs) {
  const std::lock_guard lock(mutex_);
  ++counts_.answered;
  isUnaccepted_ = false;
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

std::int64_t ServiceCounter::unacceptedMs(std::int64_t idleMs) const {
  const std::lock_guard lock(mutex_);
  if (!isUnaccepted_ || steadyMs() - lastRefusedMs_ > idleMs) return 0;
  return lastRefusedMs_ - firstRefusedMs_;
}

void ServiceCounter::leftOut() {
  const std::lock_guard lock(mutex_);
  ++counts_.unrecorded;
}

void ServiceCounter::lostPoses(std::uint64_t lost, std::uint64_t gaps, std::uint64_t vastGaps) {
  const std::lock_guard lock(mutex_);
  counts_.lost += lost;
  counts_.gaps += gaps;
  counts_.vastGaps += vastGaps;
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
