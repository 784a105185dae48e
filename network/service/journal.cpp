#include "network/service/journal.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "network/service/thread_beat.h"

namespace foretouch {
namespace {

struct Event {
  std::int64_t utimeUs = 0;
  std::string channel;
  Bytes payload;
};

/// Events with reusable memory.
struct EventList {
  std::vector<Event> events;
  std::size_t count = 0, bytes = 0;

  void add(std::int64_t utimeUs, const std::string& channel, ByteView payload) {
    if (count == events.size()) events.emplace_back();
    Event& event = events[count++];
    event.utimeUs = utimeUs;
    event.channel = channel;
    event.payload.assign(payload.data, payload.data + payload.size);
    bytes += payload.size;
  }
  void clear() {
    for (std::size_t i = 0; i < count; ++i) {
      if (events[i].payload.capacity() > kKeptBytes) Bytes().swap(events[i].payload);
    }
    if (events.size() > kKeptEvents) events.resize(kKeptEvents);
    count = bytes = 0;
  }

  /// A flood must not hold its memory for ever.
  static constexpr std::size_t kKeptEvents = 1024, kKeptBytes = 64u << 10;
};

}  // namespace

struct Journal::Impl {
  std::unique_ptr<JournalSink> sink;
  JournalOptions options;
  std::function<void()> failed;

  mutable std::mutex mutex;
  std::condition_variable changed;
  EventList waiting;
  std::string lastFailure;
  bool isClosing = false, isDone = false;
  bool isAbandoned = false;  // `failed` may be gone

  EventList written;                   // of the thread
  std::atomic<std::size_t> inHand{0};  // of them
  bool isFlushed = true;
  ThreadBeat beat;
  std::thread thread;

  void note(const Result<Done>& done) {
    if (done.ok()) return;
    const std::lock_guard lock(mutex);
    lastFailure = describe(done.error());
    if (!isAbandoned) failed();
  }

  void write() {
    for (std::size_t i = 0; i < written.count; ++i) {
      const Event& event = written.events[i];
      note(sink->write(event.utimeUs, event.channel, event.payload));
      --inHand;
      beat.beat();
    }
    if (written.count > 0) isFlushed = false;
    written.clear();
  }

  void flush() {
    if (isFlushed) return;
    note(sink->flush());
    isFlushed = true;
  }

  /// Takes the waiting events; false once no more will come.
  bool takeWaiting(std::chrono::steady_clock::time_point until) {
    std::unique_lock lock(mutex);
    changed.wait_until(lock, until, [&] { return waiting.count > 0 || isClosing; });
    std::swap(waiting, written);
    inHand = written.count;
    return written.count > 0 || !isClosing;
  }

  void run() {
    auto flushAt = std::chrono::steady_clock::now() + options.flushEvery;
    while (takeWaiting(flushAt)) {
      beat.beat();
      write();
      if (std::chrono::steady_clock::now() < flushAt) continue;
      flush();
      flushAt = std::chrono::steady_clock::now() + options.flushEvery;
    }
    note(sink->close());
    const std::lock_guard lock(mutex);
    isDone = true;
    changed.notify_all();
  }
};

Journal::Journal(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}
Journal::Journal(Journal&&) noexcept = default;
Journal& Journal::operator=(Journal&& other) noexcept {
  if (this != &other) {
    close();
    impl_ = std::move(other.impl_);
  }
  return *this;
}
Journal::~Journal() {
  close();
}

Result<Journal> Journal::start(std::unique_ptr<JournalSink> sink, const JournalOptions& options,
                               std::function<void()> failed) {
  auto impl = std::make_shared<Impl>();
  impl->sink = std::move(sink);
  impl->options = options;
  impl->failed = std::move(failed);
  try {
    impl->thread = std::thread([journal = impl] { journal->run(); });
  } catch (const std::system_error& e) {
    return Error::of(ErrorCode::LimitExceeded,
                     std::string("cannot start the thread that writes the log: ") + e.what());
  }
  return Journal(std::move(impl));
}

void Journal::add(std::int64_t utimeUs, const std::string& channel, ByteView payload) {
  {
    const std::lock_guard lock(impl_->mutex);
    EventList& waiting = impl_->waiting;
    const bool fits = !impl_->isClosing && waiting.count < impl_->options.maxEvents &&
                      waiting.bytes + payload.size <= impl_->options.maxBytes;
    if (fits) {
      waiting.add(utimeUs, channel, payload);
      impl_->changed.notify_one();
      return;
    }
    impl_->lastFailure = "more events wait to be written than the log's queue holds";
  }
  impl_->failed();
}

void Journal::close() {
  if (!impl_ || !impl_->thread.joinable()) return;
  std::size_t left = 0;
  {
    std::unique_lock lock(impl_->mutex);
    impl_->isClosing = true;
    impl_->changed.notify_all();
    impl_->changed.wait_for(lock, impl_->options.closeWithin, [&] { return impl_->isDone; });
    if (!impl_->isDone) {
      left = impl_->waiting.count + impl_->inHand + 1;  // and the closing
      impl_->isAbandoned = true;
      impl_->lastFailure = "the log did not take what waited for it in time, and is not closed";
    }
  }
  if (left == 0) return impl_->thread.join();
  impl_->thread.detach();  // it shares what it needs
  for (; left > 0; --left) impl_->failed();
}

std::int64_t Journal::idleMs() const {
  return impl_->beat.idleMs();
}

std::string Journal::lastFailure() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->lastFailure;
}

}  // namespace foretouch
