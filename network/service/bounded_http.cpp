#include "network/service/bounded_http.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "lss/index.h"
#include "network/wire/loopback.h"

namespace foretouch::internal {
namespace {

using SteadyClock = std::chrono::steady_clock;
using Time = SteadyClock::time_point;
using std::chrono::milliseconds;

constexpr int kBacklog = 512;
/// Without descriptors, tries again after this long; also the longest time past a deadline.
constexpr int kPollMs = 50;
/// A response that gets on is not cut off for a newcomer.
constexpr milliseconds kStalledAfter{1000};
/// Then the others have their turn: megabytes to one client would be milliseconds for all.
constexpr std::size_t kMostSentPerTurn = std::size_t{256} << 10;
constexpr char kEndOfHeaders[] = "\r\n\r\n";

/// Part of a response: from a shared text, or from its own.
struct Segment {
  std::shared_ptr<const std::string> owner;
  std::size_t offset = 0, size = 0;
};

std::string addressText(const sockaddr_storage& address) {
  const auto bytes = [](const auto& part) {
    return std::string(reinterpret_cast<const char*>(&part), sizeof part);
  };
  if (address.ss_family == AF_INET) {
    return bytes(reinterpret_cast<const sockaddr_in&>(address).sin_addr);
  }
  return bytes(reinterpret_cast<const sockaddr_in6&>(address).sin6_addr);
}

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

bool namesForeignHost(const httplib::Request& request) {
  const std::size_t count = request.get_header_value_count("Host");
  return count > 1 || (count == 1 && !isLoopbackHost(request.get_header_value("Host")));
}

/// A connection: reads its request, then sends its response.
struct BoundedHttp::Client {
  Client(internal::FileDescriptor from, std::string fromAddress, const HttpBounds& bounds)
      : socket(std::move(from)),
        address(std::move(fromAddress)),
        acceptedAt(SteadyClock::now()),
        movedAt(acceptedAt),
        until(acceptedAt + milliseconds(bounds.requestMs)) {}

  internal::FileDescriptor socket;
  std::string address;
  Time acceptedAt, movedAt, until;
  std::string request;
  std::vector<Segment> response;
  std::size_t segment = 0, sent = 0;
  bool isSending = false, isAnswered = false, isOver = false;
  Taker taker;
};

/// A request that has come whole, and a response that collects in memory.
class BoundedHttp::MemoryStream final : public httplib::Stream {
 public:
  MemoryStream(Client& client, const std::vector<std::shared_ptr<const std::string>>& shared)
      : client_(client), shared_(shared) {}

  [[nodiscard]] bool is_readable() const override { return next_ < client_.request.size(); }
  [[nodiscard]] bool is_writable() const override { return true; }
  ssize_t read(char* place, std::size_t size) override {
    const std::size_t taken = std::min(size, client_.request.size() - next_);
    if (taken == 0) return -1;
    std::memcpy(place, client_.request.data() + next_, taken);
    next_ += taken;
    return static_cast<ssize_t>(taken);
  }
  ssize_t write(const char* text, std::size_t size) override {
    for (const auto& whole : shared_) {
      // std::less has an order for unrelated addresses, the operators have none.
      const std::less_equal<> isUpTo;
      const char* const end = whole->data() + whole->size();
      if (!isUpTo(whole->data(), text) || !isUpTo(text + size, end)) continue;
      client_.response.push_back({whole, static_cast<std::size_t>(text - whole->data()), size});
      return static_cast<ssize_t>(size);
    }
    client_.response.push_back({std::make_shared<const std::string>(text, size), 0, size});
    return static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  [[nodiscard]] socket_t socket() const override { return client_.socket.get(); }

 private:
  Client& client_;
  const std::vector<std::shared_ptr<const std::string>>& shared_;
  std::size_t next_ = 0;
};

BoundedHttp::BoundedHttp(const HttpBounds& bounds)
    : bounds_(bounds), wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  using Handled = httplib::Server::HandlerResponse;
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
  isStopping_ = true;
  const std::uint64_t one = 1;
  static_cast<void>(::write(wake_.get(), &one, sizeof one) < 0);  // a full counter wakes, too
  if (thread_.joinable()) thread_.join();
  const socket_t listening = svr_sock_.exchange(INVALID_SOCKET);
  if (listening != INVALID_SOCKET) ::close(listening);
}

void BoundedHttp::run() {
  while (!isStopping_) {
    try {
      takeTurn();
    } catch (...) {
      // Out of memory: these clients come again, as the service goes on.
      clients_.clear();
      std::this_thread::sleep_for(milliseconds(kPollMs));
    }
  }
  clients_.clear();
}

void BoundedHttp::takeTurn() {
  wait();
  admit();
  for (const auto& client : clients_) serve(*client);
  const auto isOver = [](const auto& client) { return client->isOver; };
  clients_.erase(std::remove_if(clients_.begin(), clients_.end(), isOver), clients_.end());
}

void BoundedHttp::wait() {
  std::vector<pollfd> polled{{wake_.get(), POLLIN, 0}};
  if (isAccepting_) polled.push_back({svr_sock_, POLLIN, 0});
  for (const auto& client : clients_) {
    const auto awaited = static_cast<short>(client->isSending ? POLLOUT : POLLIN);
    polled.push_back({client->socket.get(), awaited, 0});
  }
  // Only deadlines and missing descriptors need a look without a sign.
  const bool waits = isAccepting_ && clients_.empty();
  ::poll(polled.data(), polled.size(), waits ? -1 : kPollMs);
  isAccepting_ = true;
}

void BoundedHttp::admit() {
  for (std::size_t i = 0; i < kMaxHttpConnections; ++i) {
    sockaddr_storage from{};
    socklen_t size = sizeof from;
    internal::FileDescriptor socket(::accept4(svr_sock_, reinterpret_cast<sockaddr*>(&from), &size,
                                              SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (socket.get() < 0) {
      isAccepting_ = errno == EAGAIN || errno == EINTR || errno == ECONNABORTED;
      return;
    }
    std::string address = addressText(from);
    if (!makePlace(address)) continue;
    clients_.push_back(std::make_unique<Client>(std::move(socket), std::move(address), bounds_));
  }
}

/// Where all places are taken, or all of one address, the connection that has been unfinished for
/// longest makes way; false if each of them gets on.
bool BoundedHttp::makePlace(const std::string& address) {
  const auto isOf = [&](const auto& client) { return client->address == address; };
  const auto ofAddress = std::count_if(clients_.begin(), clients_.end(), isOf);
  const bool isCrowded = countOf(ofAddress) >= kMaxHttpPerAddress;
  if (!isCrowded && clients_.size() < kMaxHttpConnections) return true;
  const Time now = SteadyClock::now();
  auto worst = clients_.end();
  const auto rank = [](const auto& client) {
    return std::pair(client->isSending, client->isSending ? client->movedAt : client->acceptedAt);
  };
  for (auto client = clients_.begin(); client != clients_.end(); ++client) {
    if (isCrowded && !isOf(*client)) continue;
    if ((*client)->isSending && now - (*client)->movedAt < kStalledAfter) continue;
    if (worst == clients_.end() || rank(*client) < rank(*worst)) worst = client;
  }
  if (worst == clients_.end()) return false;
  clients_.erase(worst);
  return true;
}

void BoundedHttp::serve(Client& client) {
  if (!client.isSending) read(client);
  if (client.isSending && !client.isOver) send(client);
  if (SteadyClock::now() > client.until) client.isOver = true;
}

void BoundedHttp::read(Client& client) {
  std::array<char, 4096> buffer;
  bool isWhole = false;
  while (!isWhole) {
    const std::size_t room = bounds_.requestBytes - client.request.size();
    const ssize_t got =
        ::recv(client.socket.get(), buffer.data(), std::min(room, buffer.size()), MSG_DONTWAIT);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) return;
    if (got < 0) {
      client.isOver = true;
      return;
    }
    // No more will come: the library says what it thinks of it.
    isWhole = got == 0 || countOf(got) == room;
    const std::size_t from =
        client.request.size() - std::min<std::size_t>(client.request.size(), 3);
    client.request.append(buffer.data(), countOf(got));
    isWhole = isWhole || client.request.find(kEndOfHeaders, from) != std::string::npos;
  }
  handle(client);
}

void BoundedHttp::handle(Client& client) {
  try {
    MemoryStream stream(client, shared_);
    bool isClosed = false;
    client.isAnswered =
        process_request(stream, /*close_connection=*/true, isClosed, &dropCostlyWishes);
    if (takerOfLast) client.taker = takerOfLast();
  } catch (...) {
    client.isOver = true;  // out of memory: this request is lost, the service is not
  }
  client.isSending = true;
  client.movedAt = SteadyClock::now();
  client.until = client.movedAt + milliseconds(bounds_.responseMs);
}

void BoundedHttp::send(Client& client) {
  for (std::size_t turn = 0; client.segment < client.response.size();) {
    if (turn >= kMostSentPerTurn) return;
    const Segment& segment = client.response[client.segment];
    const std::size_t left = std::min(segment.size - client.sent, kMostSentPerTurn - turn);
    const char* const from = segment.owner->data() + segment.offset + client.sent;
    const ssize_t some =
        left == 0 ? 0 : ::send(client.socket.get(), from, left, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (some < 0 && errno == EINTR) continue;
    if (some < 0 && errno == EAGAIN) return;
    if (some < 0) {
      client.isOver = true;
      return;
    }
    client.sent += countOf(some);
    turn += countOf(some);
    client.movedAt = SteadyClock::now();
    if (client.sent < segment.size) continue;
    ++client.segment;
    client.sent = 0;
  }
  client.isOver = true;
  if (client.taker && client.isAnswered && client.taker(client.socket.get())) {
    client.socket.release();
    return;
  }
  ::shutdown(client.socket.get(), SHUT_RDWR);
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
  // The library's own backlog is five.
  if (port_ <= 0 || ::listen(svr_sock_, kBacklog) != 0 || wake_.get() < 0) {
    return cannotServe(what, host, port,
                       errno != 0 ? std::generic_category().message(errno) : "the system refuses");
  }
  const int flags = ::fcntl(svr_sock_, F_GETFL);
  if (flags < 0 || ::fcntl(svr_sock_, F_SETFL, flags | O_NONBLOCK) != 0) {
    return cannotServe(what, host, port, std::generic_category().message(errno));
  }
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error& e) {
    return cannotServe(what, host, port, e.what());
  }
  return Done{};
}

}  // namespace foretouch::internal
