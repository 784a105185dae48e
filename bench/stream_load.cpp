#include "bench/stream_load.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <optional>
#include <thread>
#include <unordered_map>
#include <utility>

#include "articulated/try.h"
#include "bench/garbage.h"
#include "lss/index.h"
#include "network/service/clock.h"
#include "network/wire/codec.h"

namespace foretouch::tools {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;
constexpr int kReceiveTimeoutMs = 100;
constexpr std::chrono::milliseconds kStatusPeriod{1100};
constexpr std::int64_t kPatienceNs = kNsPerS;  // for the last answers

std::int64_t steadyNs() {
  return std::chrono::steady_clock::now().time_since_epoch().count();
}

std::int64_t utimeUs() {
  return systemClock().utimeUs();
}

void sleepUntil(std::int64_t ns) {
  const timespec due{static_cast<time_t>(ns / kNsPerS), static_cast<long>(ns % kNsPerS)};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) == EINTR) {
  }
}

/// When each pose was sent, by sender and sequence; 0: not yet, -1: answered. Written by the
/// sending thread, read and marked by the receiving one.
class SendTimes {
 public:
  explicit SendTimes(const LoadRequest& request) {
    for (const LoadSender& sender : request.senders) {
      const auto count = static_cast<std::size_t>(std::ceil(sender.rateHz * request.durationS)) + 1;
      times_.push_back(std::vector<std::atomic<std::int64_t>>(count));
    }
  }
  [[nodiscard]] std::int64_t count(std::size_t sender) const {
    return static_cast<std::int64_t>(times_[sender].size());
  }
  [[nodiscard]] std::atomic<std::int64_t>& at(std::size_t sender, std::int64_t sequence) {
    return times_[sender][slotOf(sequence)];
  }

 private:
  std::vector<std::vector<std::atomic<std::int64_t>>> times_;
};

class Senders {
 public:
  Senders(const LoadTrack& track, const LoadRequest& request, Publisher& publisher,
          SendTimes& times, LoadOutcome& outcome)
      : track_(track), request_(request), publisher_(publisher), times_(times), outcome_(outcome) {
    startNs_ = steadyNs();
    startUtimeUs_ = utimeUs();
    for (std::size_t s = 0; s < request.senders.size(); ++s) {
      const double period = static_cast<double>(kNsPerS) / request.senders[s].rateHz;
      // Spread over a period, like independent senders.
      const double phase =
          period * static_cast<double>(s) / static_cast<double>(request.senders.size());
      schedule_.push_back({period, phase, 0});
    }
    if (request.moving.props == 0) return;
    const auto first = static_cast<BodyNumber>(request.senders.size()) + 1;
    props_.emplace(request.moving, startUtimeUs_, first);
    schedule_.push_back({static_cast<double>(kNsPerS) / request.moving.rateHz, 0.0, 0});
  }

  [[nodiscard]] std::int64_t session() const { return startUtimeUs_; }

  /// Announces all senders: skeletons, and bodies of a moving world.
  void sendSkeletons() {
    if (props_) props_->tell(publisher_, utimeUs());
    Bytes payload;
    SkeletonMessage skeleton = track_.skeleton;
    for (const LoadSender& sender : request_.senders) {
      skeleton.avatar = sender.avatar;
      skeleton.session = session();
      skeleton.sendUtimeUs = utimeUs();
      skeleton.rateHz = sender.rateHz;
      encode(skeleton, payload);
      publisher_.publish(kSkeletonChannel, payload);
    }
  }

  void run(const std::function<void()>& everySecond) {
    std::unique_ptr<Garbage> garbage = makeGarbage();
    double owed = 0.0;
    std::int64_t nextSecondNs = startNs_ + kNsPerS;
    const std::int64_t endNs =
        startNs_ + static_cast<std::int64_t>(request_.durationS * static_cast<double>(kNsPerS));
    for (;;) {
      const std::size_t s = nextSender();
      const std::int64_t dueNs = dueAt(s);
      if (dueNs >= endNs) break;
      sleepUntil(dueNs);
      if (steadyNs() >= nextSecondNs) {
        sendSkeletons();
        if (everySecond) everySecond();
        nextSecondNs += kNsPerS;
      }
      if (s < request_.senders.size()) {
        sendPose(s, dueNs);
      } else {
        moveProps(s, dueNs);
      }
      for (owed += request_.garbageShare; owed >= 1.0; owed -= 1.0) {
        garbage->send();
        ++outcome_.garbage;
      }
    }
  }

 private:
  struct Due {
    double periodNs, phaseNs;
    std::int64_t sequence;
  };

  [[nodiscard]] std::unique_ptr<Garbage> makeGarbage() const {
    Bytes payload;
    encode(track_.poses.front(), payload);
    return std::make_unique<Garbage>(request_.url, payload, request_.seed);
  }
  [[nodiscard]] std::int64_t dueAt(std::size_t s) const {
    const Due& due = schedule_[s];
    return startNs_ + static_cast<std::int64_t>(due.phaseNs +
                                                due.periodNs * static_cast<double>(due.sequence));
  }
  [[nodiscard]] std::size_t nextSender() const {
    std::size_t first = 0;
    for (std::size_t s = 1; s < schedule_.size(); ++s) {
      if (dueAt(s) < dueAt(first)) first = s;
    }
    return first;
  }
  /// The pose, forth and back over the track.
  [[nodiscard]] const PoseMessage& poseAt(std::int64_t sequence) const {
    const auto last = static_cast<std::int64_t>(track_.poses.size()) - 1;
    const std::int64_t place = sequence % (2 * last);
    return track_.poses[slotOf(place <= last ? place : 2 * last - place)];
  }

  void sendPose(std::size_t s, std::int64_t dueNs) {
    Due& due = schedule_[s];
    const std::int64_t sequence = due.sequence++;
    pose_ = poseAt(sequence);
    pose_.avatar = request_.senders[s].avatar;
    if (props_) {
      for (PoseTranslation& moved : pose_.translations) {
        if (moved.joint == 0) moved.translation += placeInCrowd(s);
      }
    }
    pose_.session = session();
    pose_.sequence = sequence;
    pose_.utimeUs = startUtimeUs_ + (dueNs - startNs_) / 1000;
    pose_.sendUtimeUs = utimeUs();
    pose_.skeletonHash = track_.skeleton.hash;
    encode(pose_, payload_);
    const std::int64_t now = steadyNs();
    times_.at(s, sequence).store(now, std::memory_order_relaxed);
    ++outcome_.sent;
    outcome_.lateSends += static_cast<double>(now - dueNs) > due.periodNs ? 1 : 0;
    outcome_.sendFailures += publisher_.publish(kPoseChannel, payload_) ? 0 : 1;
  }

  void moveProps(std::size_t s, std::int64_t dueNs) {
    ++schedule_[s].sequence;
    ++outcome_.propMessages;
    const std::int64_t captureUs = startUtimeUs_ + (dueNs - startNs_) / 1000;
    outcome_.sendFailures += props_->move(publisher_, captureUs, utimeUs()) ? 0 : 1;
  }

  const LoadTrack& track_;
  const LoadRequest& request_;
  Publisher& publisher_;
  SendTimes& times_;
  LoadOutcome& outcome_;
  std::int64_t startNs_ = 0, startUtimeUs_ = 0;
  std::vector<Due> schedule_;  // those of the senders; then of the balls, if there are any
  std::optional<MovingProps> props_;
  PoseMessage pose_;
  Bytes payload_;
};

class Answers {
 public:
  Answers(const LoadRequest& request, Receiver& receiver, SendTimes& times)
      : receiver_(receiver), times_(times) {
    for (std::size_t s = 0; s < request.senders.size(); ++s) {
      senderOf_[request.senders[s].avatar] = s;
    }
  }

  void receiveUntilStopped() {
    std::vector<WireMessage> messages;
    while (!stop_.load(std::memory_order_relaxed)) {
      messages.clear();
      if (!receiver_.receive(messages, kReceiveTimeoutMs).ok()) return;
      const std::int64_t now = steadyNs();
      for (const WireMessage& message : messages) take(message, now);
    }
  }
  void stop() { stop_ = true; }
  [[nodiscard]] std::int64_t answered() const { return answered_.load(std::memory_order_relaxed); }

  std::int64_t session = 0;  // set before the first pose is sent
  std::vector<LoadAnswer> answers;
  std::int64_t repeated = 0, gaps = 0;
  StatusMessage status;
  MovingAnswers world;

 private:
  void take(const WireMessage& message, std::int64_t now) {
    if (message.channel == kStatusChannel) {
      if (decode(message.payload, heard_) == Reject::None) status = heard_;
      return;
    }
    if (message.channel == kEventsChannel) return world.take(message.payload);
    if (decode(message.payload, contacts_) != Reject::None || contacts_.session != session) return;
    const auto found = senderOf_.find(contacts_.avatar);
    if (found == senderOf_.end()) return;
    const std::size_t s = found->second;
    if (contacts_.sequenceTo < 0 || contacts_.sequenceTo >= times_.count(s)) return;
    const std::int64_t sent = times_.at(s, contacts_.sequenceTo).exchange(-1);
    if (sent < 0) {
      ++repeated;
      return;
    }
    gaps += contacts_.kind == StepKind::AcrossGap ? 1 : 0;
    LoadAnswer answer;
    answer.roundTripUs = static_cast<float>(static_cast<double>(now - sent) * 1e-3);
    answer.serviceUs = static_cast<float>(contacts_.sendUtimeUs - contacts_.receiveUtimeUs);
    answer.queryUs = static_cast<float>(contacts_.queryUs);
    answer.sender = static_cast<std::int32_t>(s);
    answers.push_back(answer);
    answered_.fetch_add(1, std::memory_order_relaxed);
  }

  Receiver& receiver_;
  SendTimes& times_;
  std::unordered_map<std::int32_t, std::size_t> senderOf_;
  ContactsMessage contacts_;
  StatusMessage heard_;
  std::atomic<bool> stop_{false};
  std::atomic<std::int64_t> answered_{0};
};

void waitForTheLast(const Answers& answers, std::int64_t sent) {
  const std::int64_t until = steadyNs() + kPatienceNs;
  while (answers.answered() < sent && steadyNs() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

Result<LoadOutcome> runLoad(const LoadTrack& track, const LoadRequest& request,
                            const std::function<void()>& everySecond) {
  FORETOUCH_TRY(auto receiver,
                openUdpmReceiver(request.url, {kContactsChannel, kStatusChannel, kEventsChannel}));
  FORETOUCH_TRY(auto publisher, openUdpmPublisher(request.url));
  LoadOutcome outcome;
  SendTimes times(request);
  Answers answers(request, *receiver, times);
  Senders senders(track, request, *publisher, times, outcome);
  answers.session = senders.session();
  std::thread listening([&] { answers.receiveUntilStopped(); });
  senders.sendSkeletons();
  senders.run(everySecond);
  waitForTheLast(answers, outcome.sent);
  std::this_thread::sleep_for(kStatusPeriod);  // for the status that includes everything
  answers.stop();
  listening.join();
  outcome.answers = std::move(answers.answers);
  outcome.repeated = answers.repeated;
  outcome.gaps = answers.gaps;
  outcome.status = std::move(answers.status);
  outcome.world = std::move(answers.world);
  outcome.unanswered = outcome.sent - static_cast<std::int64_t>(outcome.answers.size());
  outcome.ownDrops = static_cast<std::int64_t>(receiver->counts().kernelDrops);
  return outcome;
}

}  // namespace foretouch::tools
