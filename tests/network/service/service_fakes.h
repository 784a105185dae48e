// tests/network/service/service_fakes.h: fakes of a service's environment, in this process and
// under a test's control. A service owns its half of each pair; the test keeps the other.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "network/service/clock.h"
#include "network/service/journal.h"
#include "network/wire/wire.h"

namespace foretouch::test {

/// Long enough for any machine; only a failing test waits so long.
inline constexpr std::chrono::seconds kServicePatience{60};

template <typename Condition>
bool eventually(const Condition& isMet) {
  const auto until = std::chrono::steady_clock::now() + kServicePatience;
  while (!isMet()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// While closed, it blocks threads that pass.
class Gate {
 public:
  void pass() {
    std::unique_lock lock(mutex_);
    ++atGate_;
    changed_.wait(lock, [&] { return isOpen_; });
    --atGate_;
  }
  void set(bool isOpen) {
    const std::lock_guard lock(mutex_);
    isOpen_ = isOpen;
    changed_.notify_all();
  }
  [[nodiscard]] int held() const {
    const std::lock_guard lock(mutex_);
    return atGate_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool isOpen_ = true;
  int atGate_ = 0;
};

/// Arriving messages.
class Inbox {
 public:
  void send(const std::string& channel, Bytes payload, std::int64_t receiveUtimeUs = 1,
            const UdpmSender& sender = {}) {
    const std::lock_guard lock(mutex_);
    messages_.push_back({channel, std::move(payload), receiveUtimeUs, sender});
    changed_.notify_all();
  }
  void die() {
    const std::lock_guard lock(mutex_);
    isDead_ = true;
    changed_.notify_all();
  }
  Result<Done> receive(std::vector<WireMessage>& messages, int timeoutMs) {
    constexpr std::size_t kAtOnce = 16;
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::milliseconds(timeoutMs),
                      [&] { return !messages_.empty() || isDead_; });
    if (isDead_) return Error::of(ErrorCode::DeviceFailed, "the socket is gone");
    for (std::size_t i = 0; i < kAtOnce && !messages_.empty(); ++i) {
      messages.push_back(std::move(messages_.front()));
      messages_.pop_front();
    }
    return Done{};
  }
  [[nodiscard]] bool isEmpty() const {
    const std::lock_guard lock(mutex_);
    return messages_.empty();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<WireMessage> messages_;
  bool isDead_ = false;
};

class FakeReceiver final : public Receiver {
 public:
  explicit FakeReceiver(std::shared_ptr<Inbox> inbox) : inbox_(std::move(inbox)) {}
  Result<Done> receive(std::vector<WireMessage>& messages, int timeoutMs) override {
    return inbox_->receive(messages, timeoutMs);
  }
  [[nodiscard]] WireCounts counts() const override { return {}; }

 private:
  std::shared_ptr<Inbox> inbox_;
};

struct Said {
  std::string channel;
  Bytes payload;
};

/// Sent messages.
class Outbox {
 public:
  Gate gate;        ///< Of answers.
  Gate worldsGate;  ///< Of a world's events.
  std::atomic<bool> refuses{false};

  bool take(std::string_view channel, ByteView payload) {
    if (channel.find("CONTACTS") != std::string_view::npos) gate.pass();
    if (channel.find("EVENTS") != std::string_view::npos) worldsGate.pass();
    if (refuses) return false;
    const std::lock_guard lock(mutex_);
    said_.push_back({std::string(channel), Bytes(payload.data, payload.data + payload.size)});
    return true;
  }
  [[nodiscard]] std::vector<Bytes> on(const std::string& channel) const {
    const std::lock_guard lock(mutex_);
    std::vector<Bytes> payloads;
    for (const Said& said : said_) {
      if (said.channel == channel) payloads.push_back(said.payload);
    }
    return payloads;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Said> said_;
};

class FakePublisher final : public Publisher {
 public:
  explicit FakePublisher(std::shared_ptr<Outbox> outbox) : outbox_(std::move(outbox)) {}
  bool publish(std::string_view channel, ByteView payload) override {
    return outbox_->take(channel, payload);
  }

 private:
  std::shared_ptr<Outbox> outbox_;
};

struct Recorded {
  std::int64_t utimeUs = 0;
  std::string channel;
  Bytes payload;
};

/// Recorded events.
class Book {
 public:
  Gate gate;
  std::atomic<bool> isFull{false};
  std::atomic<int> flushes{0}, closes{0};

  Result<Done> write(std::int64_t utimeUs, const std::string& channel, ByteView payload) {
    gate.pass();
    if (isFull) return Error::of(ErrorCode::FileUnwritable, "No space left on device");
    const std::lock_guard lock(mutex_);
    events_.push_back({utimeUs, channel, Bytes(payload.data, payload.data + payload.size)});
    return Done{};
  }
  [[nodiscard]] std::vector<Recorded> events() const {
    const std::lock_guard lock(mutex_);
    return events_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Recorded> events_;
};

class FakeSink final : public JournalSink {
 public:
  explicit FakeSink(std::shared_ptr<Book> book) : book_(std::move(book)) {}
  Result<Done> write(std::int64_t utimeUs, const std::string& channel, ByteView payload) override {
    return book_->write(utimeUs, channel, payload);
  }
  Result<Done> flush() override {
    ++book_->flushes;
    return Done{};
  }
  Result<Done> close() override {
    ++book_->closes;
    return Done{};
  }

 private:
  std::shared_ptr<Book> book_;
};

/// Advances one microsecond per call.
class FakeClock final : public foretouch::Clock {
 public:
  [[nodiscard]] std::int64_t utimeUs() const override { return ++now_; }

 private:
  mutable std::atomic<std::int64_t> now_{1'000'000};
};

}  // namespace foretouch::test
