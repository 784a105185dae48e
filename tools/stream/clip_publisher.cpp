#include "tools/stream/clip_publisher.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

#include "articulated/try.h"
#include "network/service/clock.h"

namespace foretouch::tools {
namespace {

constexpr std::int64_t kSkeletonEveryUs = 1'000'000;
constexpr std::int64_t kNsPerS = 1'000'000'000;
constexpr std::int64_t kNsPerUs = 1'000;

std::int64_t monotonicNs() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNsPerS + now.tv_nsec;
}

/// One sender's run through a clip.
class Run {
 public:
  Run(const PublishOptions& options, Pace& pace, const MessageSink& sink)
      : options_(options), pace_(pace), sink_(sink) {
    report_.session = options.sender.startUtimeUs;
  }

  /// False if it was stopped.
  Result<bool> send(const ClipSender& sender) {
    // A session's skeleton goes before its poses.
    nextSkeletonUs_ = elapsedOf(sender.utimeOf(0));
    for (std::int64_t pose = 0; pose < sender.numPoses(); ++pose) {
      const std::int64_t dueUs = elapsedOf(sender.utimeOf(pose));
      const auto announced = sendSkeletons(sender, dueUs);
      if (!announced.ok() || !announced.value()) return announced;
      const auto sent = sendPose(sender, pose, dueUs);
      if (!sent.ok() || !sent.value()) return sent;
    }
    return true;
  }

  [[nodiscard]] const PublishReport& report() const { return report_; }

 private:
  /// Time of the pace, since the first pose of all.
  [[nodiscard]] std::int64_t elapsedOf(std::int64_t utimeUs) const {
    if (options_.speed <= 0.0) return 0;
    const auto clipUs = static_cast<double>(utimeUs - options_.sender.startUtimeUs);
    return std::llround(clipUs / options_.speed);
  }

  Result<bool> sendSkeletons(const ClipSender& sender, std::int64_t untilUs) {
    for (; nextSkeletonUs_ <= untilUs; nextSkeletonUs_ += kSkeletonEveryUs) {
      if (!pace_.waitUntil(nextSkeletonUs_)) return false;
      const std::int64_t now = pace_.utimeUs();
      encode(sender.skeleton(now), payload_);
      FORETOUCH_TRY(const auto taken, sink_(options_.channels.skeleton, payload_, now));
      ++report_.skeletons;
      report_.failures += taken ? 0 : 1;
    }
    return true;
  }

  Result<bool> sendPose(const ClipSender& sender, std::int64_t pose, std::int64_t dueUs) {
    const auto lateUs = pace_.waitUntil(dueUs);
    if (!lateUs) return false;
    const std::int64_t now = pace_.utimeUs();
    FORETOUCH_CHECK(sender.fill(pose, now, message_));
    encode(message_, payload_);
    FORETOUCH_TRY(const auto taken, sink_(options_.channels.pose, payload_, now));
    ++report_.poses;
    report_.failures += taken ? 0 : 1;
    if (options_.speed > 0.0) {
      report_.late += *lateUs > PublishReport::kLateUs ? 1 : 0;
      report_.mostLateUs = std::max(report_.mostLateUs, *lateUs);
    }
    return true;
  }

  const PublishOptions& options_;
  Pace& pace_;
  const MessageSink& sink_;
  PublishReport report_;
  std::int64_t nextSkeletonUs_ = 0;
  PoseMessage message_;
  Bytes payload_;
};

}  // namespace

LivePace::LivePace(std::function<bool()> isStopped)
    : isStopped_(std::move(isStopped)), startNs_(monotonicNs()) {}

std::optional<std::int64_t> LivePace::waitUntil(std::int64_t elapsedUs) {
  const std::int64_t dueNs = startNs_ + elapsedUs * kNsPerUs;
  timespec due{};
  due.tv_sec = static_cast<std::time_t>(dueNs / kNsPerS);
  due.tv_nsec = static_cast<long>(dueNs % kNsPerS);
  while (!isStopped_()) {
    if (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) continue;
    return std::max<std::int64_t>(0, (monotonicNs() - dueNs) / kNsPerUs);
  }
  return std::nullopt;
}

std::int64_t LivePace::utimeUs() const {
  return systemClock().utimeUs();
}

std::optional<std::int64_t> RecordedPace::waitUntil(std::int64_t elapsedUs) {
  elapsedUs_ = std::max(elapsedUs_, elapsedUs);
  return 0;
}

Result<PublishReport> publishClip(const PlacedClip& placed, const StepSelection& steps,
                                  const PublishOptions& options, Pace& pace,
                                  const MessageSink& sink) {
  Run run(options, pace, sink);
  SenderOptions session = options.sender;
  do {
    const ClipSender sender(placed, steps, session);
    FORETOUCH_TRY(const auto sent, run.send(sender));
    if (!sent) break;
    session.startUtimeUs = sender.utimeOf(sender.numPoses());
  } while (options.loop);
  return run.report();
}

}  // namespace foretouch::tools
