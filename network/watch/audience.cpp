#include "network/watch/audience.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <poll.h>
#include <sys/eventfd.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include "network/watch/viewer_connection.h"
#include "network/wire/udpm_socket.h"

namespace foretouch {
namespace {

using SteadyClock = std::chrono::steady_clock;
using Time = SteadyClock::time_point;

/// A browser reconnects this long (ms) after its connection ended.
constexpr char kOpening[] = "retry: 1000\n\n";
constexpr char kHeartbeat[] = ":\n\n";

Error refused(const std::string& what) {
  return {ErrorCode::LimitExceeded, "", -1, -1, "the system gives no " + what};
}

}  // namespace

struct Audience::Impl {
  Impl(std::unique_ptr<EventSource> from, const AudienceOptions& chosen)
      : options(chosen), source(std::move(from)) {}

  const AudienceOptions options;
  std::unique_ptr<EventSource> source;
  internal::FileDescriptor wake{::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
  std::atomic<std::size_t> taken{0};  // seats
  std::atomic<bool> isStopping{false};
  std::mutex mutex;                                 // of newcomers
  std::vector<internal::FileDescriptor> newcomers;  // not yet among the viewers
  std::thread thread;

  // For the thread only.
  std::vector<ViewerConnection> viewers;
  std::map<std::size_t, std::pair<ViewEvent, SharedText>> latest;  // by topic, the last event
  std::vector<ViewEvent> events;
  std::vector<pollfd> polled;
  Time nextCollect, nextRest;
  const SharedText opening = std::make_shared<const std::string>(kOpening);
  const SharedText heartbeat = std::make_shared<const std::string>(kHeartbeat);

  void wakeUp() const {
    const std::uint64_t one = 1;
    // A full counter has already woken the thread.
    static_cast<void>(::write(wake.get(), &one, sizeof one) < 0);
  }

  void run() {
    nextCollect = nextRest = SteadyClock::now();
    while (!isStopping) {
      wait();
      const Time now = SteadyClock::now();
      admit(now);
      if (viewers.empty()) {
        rest(now);
      } else if (now >= nextCollect) {
        nextCollect = std::max(nextCollect + options.collectEvery, now);
        collect(now);
      }
      serve(now);
    }
  }

  void wait() {
    polled.clear();
    polled.push_back({wake.get(), POLLIN, 0});
    for (const ViewerConnection& viewer : viewers) {
      const auto awaited = static_cast<short>(POLLIN | (viewer.isWaiting() ? POLLOUT : 0));
      polled.push_back({viewer.socket(), awaited, 0});
    }
    const Time until = viewers.empty() ? nextRest : nextCollect;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - SteadyClock::now());
    ::poll(polled.data(), polled.size(), static_cast<int>(std::max<std::int64_t>(0, left.count())));
    for (std::size_t i = 0; i < viewers.size(); ++i) {
      if ((polled[i + 1].revents & ~POLLOUT) != 0) viewers[i].hear();
    }
    std::uint64_t count = 0;
    static_cast<void>(::read(wake.get(), &count, sizeof count) < 0);
  }

  /// Newcomers get the current state at once: the last event of every topic.
  void admit(Time now) {
    std::vector<internal::FileDescriptor> sockets;
    {
      const std::lock_guard lock(mutex);
      sockets.swap(newcomers);
    }
    if (sockets.empty()) return;
    source->setViewers(viewers.size() + sockets.size());
    collect(now);
    for (internal::FileDescriptor& socket : sockets) {
      viewers.emplace_back(std::move(socket), options.maxBacklogBytes, now);
      viewers.back().say(opening, now);
      for (const auto& [topic, event] : latest) viewers.back().add(event.first, event.second, now);
    }
  }

  void rest(Time now) {
    if (now < nextRest) return;
    nextRest = now + options.restEvery;
    source->rest();
  }

  void collect(Time now) {
    events.clear();
    source->collect(now, events);
    for (ViewEvent& event : events) {
      const auto whole = std::make_shared<const std::string>(sentText(event));
      for (ViewerConnection& viewer : viewers) viewer.add(event, whole, now);
      latest[event.topic] = {std::move(event), whole};
    }
  }

  void serve(Time now) {
    const std::size_t before = viewers.size();
    const auto isGone = [&](ViewerConnection& viewer) {
      if (now - viewer.lastMoved() > options.heartbeatAfter && !viewer.isWaiting()) {
        viewer.say(heartbeat, now);
      }
      if (viewer.isWaiting()) viewer.flush(now);
      return viewer.isOver() ||
             (viewer.isWaiting() && now - viewer.lastMoved() > options.stalledAfter);
    };
    viewers.erase(std::remove_if(viewers.begin(), viewers.end(), isGone), viewers.end());
    if (viewers.size() == before) return;
    taken -= before - viewers.size();
    source->setViewers(viewers.size());
    if (viewers.empty()) nextRest = now + options.restEvery;
  }

  void stop() {
    isStopping = true;
    wakeUp();
    if (thread.joinable()) thread.join();
  }
};

Audience::Audience(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Audience::Audience(Audience&&) noexcept = default;
Audience& Audience::operator=(Audience&& other) noexcept {
  if (this != &other) {
    if (impl_) impl_->stop();
    impl_ = std::move(other.impl_);
  }
  return *this;
}
Audience::~Audience() {
  if (impl_) impl_->stop();
}

Result<Audience> Audience::start(std::unique_ptr<EventSource> source,
                                 const AudienceOptions& options) {
  auto impl = std::make_unique<Impl>(std::move(source), options);
  if (impl->wake.get() < 0) return refused("descriptor for waking up");
  try {
    impl->thread = std::thread([&parts = *impl] {
      try {
        parts.run();
      } catch (...) {
        parts.isStopping = true;  // no viewer gets anything more; the service continues
      }
      parts.source->setViewers(0);
    });
  } catch (const std::system_error& e) {
    return refused(std::string("thread: ") + e.what());
  }
  return Audience(std::move(impl));
}

std::optional<Audience::Seat> Audience::claimSeat() {
  std::size_t taken = impl_->taken.load();
  do {
    if (taken >= impl_->options.maxViewers || impl_->isStopping) return std::nullopt;
  } while (!impl_->taken.compare_exchange_weak(taken, taken + 1));
  return Seat(impl_.get());
}

std::size_t Audience::size() const {
  return impl_->taken.load();
}

Audience::Seat::Seat(Seat&& other) noexcept : audience_(std::exchange(other.audience_, nullptr)) {}

Audience::Seat::~Seat() {
  if (audience_ != nullptr) --audience_->taken;
}

bool Audience::Seat::take(int socket) noexcept {
  try {
    const std::lock_guard lock(audience_->mutex);
    audience_->newcomers.reserve(audience_->newcomers.size() + 1);
    audience_->newcomers.emplace_back(socket);
  } catch (...) {
    return false;
  }
  std::exchange(audience_, nullptr)->wakeUp();
  return true;
}

}  // namespace foretouch
