#include "bench/event_readers.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <netinet/in.h>
#include <poll.h>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <sys/time.h>
#include <thread>
#include <utility>
#include <vector>

#include "assets/system_files.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

constexpr std::string_view kWatch = "GET /events HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
constexpr std::string_view kAccepted = "HTTP/1.1 200", kHeadersEnd = "\r\n\r\n";
constexpr int kPollMs = 50;

class Viewer {
 public:
  Viewer() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
  [[nodiscard]] int socket() const { return socket_.get(); }

  /// Sends the request, and reads the headers of the answer.
  [[nodiscard]] bool enters(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{5, 0};
    ::setsockopt(socket(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (::connect(socket(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      return false;
    }
    if (::send(socket(), kWatch.data(), kWatch.size(), MSG_NOSIGNAL) < 0) return false;
    std::string head;
    while (head.find(kHeadersEnd) == std::string::npos) {
      if (!readSome(0, head)) return false;
    }
    return head.rfind(kAccepted, 0) == 0;
  }

  /// Adds what has come to `text`. False if the connection has ended.
  [[nodiscard]] bool readSome(int flags, std::string& text) {
    std::array<char, 65536> bytes;
    const ssize_t got = ::recv(socket(), bytes.data(), bytes.size(), flags);
    if (got > 0) text.append(bytes.data(), countOf(got));
    return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
  }

 private:
  internal::FileDescriptor socket_;
};

}  // namespace

struct EventReaders::Impl {
  std::vector<Viewer> viewers;
  std::atomic<bool> isStopping{false};
  std::int64_t ended = 0;
  std::thread thread;

  ~Impl() { stop(); }
  void stop() {
    isStopping = true;
    if (thread.joinable()) thread.join();
  }

  void run() {
    std::vector<pollfd> polled;
    for (const Viewer& viewer : viewers) polled.push_back({viewer.socket(), POLLIN, 0});
    while (!isStopping) {
      if (::poll(polled.data(), polled.size(), kPollMs) <= 0) continue;
      for (std::size_t i = 0; i < polled.size(); ++i) {
        if (polled[i].fd < 0 || polled[i].revents == 0) continue;
        std::string events;
        if (viewers[i].readSome(MSG_DONTWAIT, events)) continue;
        ++ended;
        polled[i].fd = -1;  // poll() ignores it
      }
    }
  }
};

EventReaders::EventReaders(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EventReaders::EventReaders(EventReaders&&) noexcept = default;
EventReaders::~EventReaders() = default;

Result<EventReaders> EventReaders::start(int count, std::uint16_t port) {
  auto impl = std::make_unique<Impl>();
  for (int i = 0; i < count; ++i) {
    impl->viewers.emplace_back();
    if (impl->viewers.back().enters(port)) continue;
    return Error::inLine("foretouch serve", i, ErrorCode::DeviceFailed, "does not let a viewer in");
  }
  impl->thread = std::thread([&readers = *impl] { readers.run(); });
  return EventReaders(std::move(impl));
}

std::int64_t EventReaders::stop() {
  impl_->stop();
  return impl_->ended;
}

}  // namespace foretouch::tools
