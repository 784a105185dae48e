#include "network/service/bounded_http.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <mutex>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include "lss/index.h"
#include "network/wire/loopback.h"

namespace foretouch::internal {
namespace {

using SteadyClock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::size_t kThreads = 4;
/// Accepted connections that wait for a thread.
constexpr std::size_t kMaxWaiting = 16;
/// Notices a stop of the server after this long.
constexpr int kPollMs = 50;

/// One connection with a limit on time and on bytes: the library limits a header's line, not the
/// number of headers, and the time between two bytes, not that of a request.
class BoundedStream final : public httplib::Stream {
 public:
  BoundedStream(socket_t socket, const HttpBounds& bounds, const std::atomic<bool>& isStopping)
      : socket_(socket),
        isStopping_(isStopping),
        readUntil_(SteadyClock::now() + milliseconds(bounds.requestMs)),
        writeUntil_(readUntil_ + milliseconds(bounds.responseMs)),
        buffer_(bounds.requestBytes) {}

  [[nodiscard]] bool is_readable() const override {
    return next_ < held_ || waitFor(POLLIN, readUntil_);
  }
  [[nodiscard]] bool is_writable() const override { return waitFor(POLLOUT, writeUntil_); }

  ssize_t read(char* place, std::size_t size) override {
    if (next_ == held_ && !fill()) return -1;
    const std::size_t taken = std::min(size, held_ - next_);
    std::memcpy(place, buffer_.data() + next_, taken);
    next_ += taken;
    return static_cast<ssize_t>(taken);
  }
  ssize_t write(const char* text, std::size_t size) override {
    if (!is_writable()) return -1;
    const ssize_t sent = ::send(socket_, text, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    return sent < 0 && errno == EAGAIN ? 0 : sent;
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  /// False once everything that one request may have has been read.
  bool fill() {
    if (held_ == buffer_.size() || !waitFor(POLLIN, readUntil_)) return false;
    const ssize_t got = ::recv(socket_, buffer_.data() + held_, buffer_.size() - held_, 0);
    if (got <= 0) return false;
    held_ += countOf(got);
    return true;
  }

  [[nodiscard]] bool waitFor(short events, SteadyClock::time_point until) const {
    while (!isStopping_ && SteadyClock::now() < until) {
      pollfd waited{socket_, events, 0};
      const int ready = ::poll(&waited, 1, kPollMs);
      if (ready > 0) return true;
      if (ready < 0 && errno != EINTR) return false;
    }
    return false;
  }

  const socket_t socket_;
  const std::atomic<bool>& isStopping_;
  const SteadyClock::time_point readUntil_, writeUntil_;
  std::vector<char> buffer_;
  std::size_t next_ = 0, held_ = 0;
};

/// A few threads and a bounded list: while it is full, accepting waits.
class BoundedTasks final : public httplib::TaskQueue {
 public:
  BoundedTasks() {
    for (std::size_t i = 0; i < kThreads; ++i) threads_.emplace_back([this] { run(); });
  }
  ~BoundedTasks() override = default;

  void enqueue(std::function<void()> task) override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return tasks_.size() < kMaxWaiting; });
    tasks_.push_back(std::move(task));
    changed_.notify_all();
  }
  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      isOver_ = true;
      changed_.notify_all();
    }
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  void run() {
    for (;;) {
      std::function<void()> task;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return !tasks_.empty() || isOver_; });
        if (tasks_.empty()) return;
        task = std::move(tasks_.front());
        tasks_.pop_front();
        changed_.notify_all();
      }
      task();  // each closes its connection, even if the server stops
    }
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  std::vector<std::thread> threads_;
  bool isOver_ = false;
};

Error cannotServe(const std::string& what, const std::string& host, std::uint16_t port,
                  const std::string& why) {
  const bool isSix = host.find(':') != std::string::npos;
  return {ErrorCode::OutOfRange, "", -1, -1,
          "cannot serve " + what + " on " + (isSix ? "[" + host + "]" : host) + ":" +
              std::to_string(port) + ": " + why};
}

/// Drops requests for features that cost more than they save on this machine, or many times the
/// size of the page.
void dropCostlyWishes(httplib::Request& request) {
  request.headers.erase("Accept-Encoding");
  request.headers.erase("Range");
  request.ranges.clear();
}

}  // namespace

BoundedHttp::BoundedHttp(const HttpBounds& bounds) : bounds_(bounds) {
  using Handled = httplib::Server::HandlerResponse;
  new_task_queue = [] { return new BoundedTasks; };
  set_payload_max_length(bounds_.requestBytes);
  // The library's own choice lets two services listen on one port.
  set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  // Before a body is read.
  set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    if (request.method == "GET" || request.method == "HEAD") return Handled::Unhandled;
    response.status = 405;
    response.set_header("Allow", "GET, HEAD");
    return Handled::Handled;
  });
}

BoundedHttp::~BoundedHttp() {
  end();
}

void BoundedHttp::end() {
  if (!thread_.joinable()) return;
  isStopping_ = true;
  stop();
  thread_.join();
}

bool BoundedHttp::process_and_close_socket(socket_t socket) {
  bool isAnswered = false;
  try {
    BoundedStream stream(socket, bounds_, isStopping_);
    bool isClosed = false;
    isAnswered = process_request(stream, /*close_connection=*/true, isClosed, &dropCostlyWishes);
  } catch (...) {
    isAnswered = false;  // out of memory: this request is lost, the service is not
  }
  if (takeOver && takeOver(socket, isAnswered)) return isAnswered;
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return isAnswered;
}

Result<Done> BoundedHttp::start(const std::string& what, const std::string& host,
                                std::uint16_t port) {
  if (!isNumericAddress(host) && host != "localhost") {
    return cannotServe(what, host, port, "expected a numeric address or localhost");
  }
  // Resolved here: a machine without /etc/hosts does not know the name.
  const std::string address = host == "localhost" ? "127.0.0.1" : host;
  errno = 0;
  if (port == 0) {
    port_ = bind_to_any_port(address);
  } else {
    port_ = bind_to_port(address, port) ? port : -1;
  }
  if (port_ <= 0) {
    return cannotServe(what, host, port,
                       errno != 0 ? std::generic_category().message(errno) : "the system refuses");
  }
  try {
    thread_ = std::thread([this] {
      try {
        listen_after_bind();
      } catch (...) {
        // The pages are gone; the service continues.
      }
      hasEnded_ = true;
    });
  } catch (const std::system_error& e) {
    return cannotServe(what, host, port, e.what());
  }
  // stop() ignores a server that does not run yet.
  while (!is_running() && !hasEnded_) std::this_thread::sleep_for(milliseconds(1));
  return Done{};
}

}  // namespace foretouch::internal
