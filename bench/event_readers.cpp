#include "bench/event_readers.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <netinet/in.h>
#include <poll.h>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <sys/time.h>
#include <thread>
#include <unistd.h>
#include <utility>

#include "lss/index.h"
#include "network/service/clock.h"

namespace foretouch::tools {
namespace {

constexpr std::string_view kWatch = "GET /events HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
constexpr std::string_view kAccepted = "HTTP/1.1 200";
constexpr std::string_view kEnd = "\n\n", kHeadersEnd = "\r\n\r\n";
constexpr int kPollMs = 50;

/// The number right after `name`; 0 if there is none.
std::int64_t numberAfter(std::string_view text, std::string_view name) {
  const std::size_t at = text.find(name);
  std::int64_t value = 0;
  if (at != std::string_view::npos) {
    std::from_chars(text.data() + at + name.size(), text.data() + text.size(), value);
  }
  return value;
}

class Viewer {
 public:
  Viewer() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
  Viewer(Viewer&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), held_(std::move(other.held_)) {}
  Viewer& operator=(Viewer&&) = delete;
  ~Viewer() {
    if (socket_ >= 0) ::close(socket_);
  }
  [[nodiscard]] int socket() const { return socket_; }

  /// Sends the request, and reads the headers of the answer.
  [[nodiscard]] bool enters(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{5, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      return false;
    }
    if (::send(socket_, kWatch.data(), kWatch.size(), MSG_NOSIGNAL) < 0) return false;
    while (held_.find(kHeadersEnd) == std::string::npos) {
      if (!readSome(0)) return false;
    }
    const bool isAccepted = held_.rfind(kAccepted, 0) == 0;
    held_.erase(0, held_.find(kHeadersEnd) + kHeadersEnd.size());
    return isAccepted;
  }

  /// False if the connection has ended.
  [[nodiscard]] bool readSome(int flags) {
    std::array<char, 65536> bytes;
    const ssize_t got = ::recv(socket_, bytes.data(), bytes.size(), flags);
    if (got > 0) held_.append(bytes.data(), countOf(got));
    return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
  }

  /// Passes each whole event to `take`.
  template <typename Take>
  void takeEvents(const Take& take) {
    std::size_t begin = 0;
    for (std::size_t end = held_.find(kEnd); end != std::string::npos;
         end = held_.find(kEnd, begin)) {
      take(std::string_view(held_).substr(begin, end - begin));
      begin = end + kEnd.size();
    }
    held_.erase(0, begin);
  }

 private:
  int socket_ = -1;
  std::string held_;
};

}  // namespace

struct EventReaders::Impl {
  std::vector<Viewer> viewers;
  double periodUs = 0.0;
  std::atomic<bool> isStopping{false};
  ReadEvents read;
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
        if (!viewers[i].readSome(MSG_DONTWAIT)) {
          ++read.ended;
          polled[i].fd = -1;  // poll() ignores it
        }
        const std::int64_t nowUs = systemClock().utimeUs();
        viewers[i].takeEvents([&](std::string_view event) { take(event, nowUs); });
      }
    }
  }

  void take(std::string_view event, std::int64_t nowUs) {
    read.bytes += static_cast<std::int64_t>(event.size());
    if (event.substr(0, 11) != "event: step") return;
    const std::int64_t sequence = numberAfter(event, "\"sequence\":");
    const std::string_view stamps = event.substr(std::min(event.size(), event.find("\"utime\":[")));
    const std::int64_t poseUs = numberAfter(stamps, ",");
    const auto delayUs = static_cast<double>(nowUs - poseUs);
    read.stepDelaysUs.push_back(delayUs);
    const std::size_t list = event.rfind("\"contacts\":[");
    if (list == std::string_view::npos) return;
    std::string_view contacts = event.substr(list);
    read.skippedSteps += numberAfter(contacts, "\"skipped\":");
    constexpr std::string_view kContact = "{\"sequence\":";
    for (std::size_t at = contacts.find(kContact); at != std::string_view::npos;
         at = contacts.find(kContact)) {
      contacts.remove_prefix(at);
      const std::int64_t behind = sequence - numberAfter(contacts, kContact);
      read.contactDelaysUs.push_back(delayUs + static_cast<double>(behind) * periodUs);
      contacts.remove_prefix(kContact.size());
    }
  }
};

EventReaders::EventReaders(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EventReaders::EventReaders(EventReaders&&) noexcept = default;
EventReaders::~EventReaders() = default;

Result<EventReaders> EventReaders::start(int count, std::uint16_t port, double periodUs) {
  auto impl = std::make_unique<Impl>();
  impl->periodUs = periodUs;
  for (int i = 0; i < count; ++i) {
    impl->viewers.emplace_back();
    if (impl->viewers.back().enters(port)) continue;
    return Error::inLine("foretouch serve", i, ErrorCode::DeviceFailed, "does not let a viewer in");
  }
  impl->thread = std::thread([&readers = *impl] { readers.run(); });
  return EventReaders(std::move(impl));
}

ReadEvents EventReaders::stop() {
  impl_->stop();
  return std::move(impl_->read);
}

}  // namespace foretouch::tools
