#include "network/metrics_server.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <httplib.h>
#include <mutex>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace foretouch {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::size_t kThreads = 4;
/// Accepted connections that wait for a thread.
constexpr std::size_t kMaxWaiting = 16;
/// A server that stops is noticed after this long.
constexpr int kPollMs = 50;

/// One connection with a limit on time and on bytes: the library bounds a header's line, not how
/// many there are, and the time between two bytes, not that of a request.
class BoundedStream final : public httplib::Stream {
 public:
  BoundedStream(socket_t socket, const std::atomic<bool>& isStopping)
      : socket_(socket),
        isStopping_(isStopping),
        until_(SteadyClock::now() + std::chrono::milliseconds(kRequestMs)) {}

  [[nodiscard]] bool is_readable() const override { return next_ < held_ || waitFor(POLLIN); }
  [[nodiscard]] bool is_writable() const override { return waitFor(POLLOUT); }

  ssize_t read(char* place, std::size_t size) override {
    if (next_ == held_ && !fill()) return -1;
    const std::size_t taken = std::min(size, held_ - next_);
    std::memcpy(place, buffer_.data() + next_, taken);
    next_ += taken;
    return static_cast<ssize_t>(taken);
  }
  ssize_t write(const char* text, std::size_t size) override {
    return waitFor(POLLOUT) ? ::send(socket_, text, size, MSG_NOSIGNAL) : -1;
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  /// False once everything that one request may have has been read.
  bool fill() {
    if (held_ == buffer_.size() || !waitFor(POLLIN)) return false;
    const ssize_t got = ::recv(socket_, buffer_.data() + held_, buffer_.size() - held_, 0);
    if (got <= 0) return false;
    held_ += static_cast<std::size_t>(got);
    return true;
  }

  [[nodiscard]] bool waitFor(short events) const {
    while (!isStopping_ && SteadyClock::now() < until_) {
      pollfd waited{socket_, events, 0};
      const int ready = ::poll(&waited, 1, kPollMs);
      if (ready > 0) return true;
      if (ready < 0 && errno != EINTR) return false;
    }
    return false;
  }

  const socket_t socket_;
  const std::atomic<bool>& isStopping_;
  const SteadyClock::time_point until_;
  std::array<char, kMaxRequestBytes> buffer_{};
  std::size_t next_ = 0, held_ = 0;
};

/// A few threads and a bounded list: where it is full, accepting waits.
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
      task();  // each closes its connection, also where the server stops
    }
  }
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  std::vector<std::thread> threads_;
  bool isOver_ = false;
};

class BoundedServer final : public httplib::Server {
 public:
  BoundedServer() {
    new_task_queue = [] { return new BoundedTasks; };
    set_payload_max_length(kMaxRequestBytes);
    // The library's own choice lets two services listen on one port.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
  }
  std::atomic<bool> isStopping{false};

 private:
  bool process_and_close_socket(socket_t socket) override {
    bool answered = false;
    try {
      BoundedStream stream(socket, isStopping);
      bool isClosed = false;
      answered = process_request(stream, /*close_connection=*/true, isClosed, nullptr);
    } catch (...) {
      answered = false;  // out of memory: this request is lost, the service is not
    }
    ::shutdown(socket, SHUT_RDWR);
    ::close(socket);
    return answered;
  }
};

void addPages(httplib::Server& server, MetricsServer::Pages pages) {
  using Handled = httplib::Server::HandlerResponse;
  // Before a body is read.
  server.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    if (request.method == "GET" || request.method == "HEAD") return Handled::Unhandled;
    response.status = 405;
    response.set_header("Allow", "GET, HEAD");
    return Handled::Handled;
  });
  server.Get("/metrics", [page = std::move(pages.metrics)](const httplib::Request&,
                                                           httplib::Response& response) {
    response.set_content(page(), "text/plain; version=0.0.4; charset=utf-8");
  });
  server.Get("/healthz", [page = std::move(pages.health)](const httplib::Request&,
                                                          httplib::Response& response) {
    const ServiceHealth health = page();
    response.status = health.isWell ? 200 : 503;
    response.set_content(health.text, "text/plain; charset=utf-8");
  });
}

bool isNumeric(const std::string& host) {
  in_addr four{};
  in6_addr six{};
  return ::inet_pton(AF_INET, host.c_str(), &four) == 1 ||
         ::inet_pton(AF_INET6, host.c_str(), &six) == 1;
}

Error cannotListen(const std::string& host, std::uint16_t port, const std::string& why) {
  const bool isSix = host.find(':') != std::string::npos;
  return {ErrorCode::OutOfRange, "", -1, -1,
          "cannot serve metrics on " + (isSix ? "[" + host + "]" : host) + ":" +
              std::to_string(port) + ": " + why};
}

}  // namespace

bool isLoopback(const std::string& host) {
  in_addr four{};
  in6_addr six{};
  constexpr std::uint32_t kLoopbackNet = 127;
  if (::inet_pton(AF_INET, host.c_str(), &four) == 1) {
    return (ntohl(four.s_addr) >> 24) == kLoopbackNet;
  }
  if (::inet_pton(AF_INET6, host.c_str(), &six) == 1) return IN6_IS_ADDR_LOOPBACK(&six);
  return host == "localhost";
}

struct MetricsServer::Impl {
  BoundedServer server;
  int port = 0;
  std::atomic<bool> hasEnded{false};
  std::thread thread;

  ~Impl() {
    if (!thread.joinable()) return;
    server.isStopping = true;
    server.stop();
    thread.join();
  }
};

MetricsServer::MetricsServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MetricsServer::MetricsServer(MetricsServer&&) noexcept = default;
MetricsServer& MetricsServer::operator=(MetricsServer&&) noexcept = default;
MetricsServer::~MetricsServer() = default;

Result<MetricsServer> MetricsServer::start(const std::string& host, std::uint16_t port,
                                           Pages pages) {
  if (!isNumeric(host) && host != "localhost") {
    return cannotListen(host, port, "expected a numeric address or localhost");
  }
  // By itself: a machine without /etc/hosts does not know the name.
  const std::string address = host == "localhost" ? "127.0.0.1" : host;
  auto impl = std::make_unique<Impl>();
  addPages(impl->server, std::move(pages));
  errno = 0;
  if (port == 0) {
    impl->port = impl->server.bind_to_any_port(address);
  } else {
    impl->port = impl->server.bind_to_port(address, port) ? port : -1;
  }
  if (impl->port <= 0) {
    return cannotListen(host, port,
                        errno != 0 ? std::generic_category().message(errno) : "the system refuses");
  }
  try {
    impl->thread = std::thread([&parts = *impl] {
      try {
        parts.server.listen_after_bind();
      } catch (...) {
        // The pages are gone; the service goes on.
      }
      parts.hasEnded = true;
    });
  } catch (const std::system_error& e) {
    return cannotListen(host, port, e.what());
  }
  // stop() passes over a server that does not run yet.
  while (!impl->server.is_running() && !impl->hasEnded) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return MetricsServer(std::move(impl));
}

std::uint16_t MetricsServer::port() const {
  return static_cast<std::uint16_t>(impl_->port);
}

}  // namespace foretouch
