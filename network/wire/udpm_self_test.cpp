#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <netinet/in.h>
#include <sys/socket.h>

#include "network/wire/udpm_socket.h"
#include "network/wire/wire.h"

namespace foretouch {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPatience{1000};

/// The error with the given URL, not with our own port.
Error of(const UdpmUrl& url, Error error) {
  error.file = toString(url);
  return error;
}

/// A token that no other datagram on this port has.
std::array<char, 16> token(const sockaddr_in& address) {
  std::array<char, 16> bytes{};
  const auto now = SteadyClock::now().time_since_epoch().count();
  std::memcpy(bytes.data(), &now, sizeof now);
  std::memcpy(bytes.data() + sizeof now, &address.sin_port, sizeof address.sin_port);
  return bytes;
}

/// Whether exactly these bytes come in time.
bool comesBack(int fd, const std::array<char, 16>& sent) {
  const SteadyClock::time_point deadline = SteadyClock::now() + kPatience;
  while (true) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - SteadyClock::now())
            .count();
    if (left <= 0 || !waitReadable(fd, static_cast<int>(left))) return false;
    std::array<char, 17> got{};
    const ssize_t size = recv(fd, got.data(), got.size(), MSG_DONTWAIT);
    if (size == static_cast<ssize_t>(sent.size()) &&
        std::memcmp(got.data(), sent.data(), sent.size()) == 0) {
      return true;
    }
  }
}

}  // namespace

Result<Done> testMulticast(const UdpmUrl& url) {
  UdpmUrl own = url;
  own.port = 0;
  const auto listener = openListeningSocket(own);
  if (!listener.ok()) return of(url, listener.error());
  const auto speaker = openSendingSocket(own);
  if (!speaker.ok()) return of(url, speaker.error());

  sockaddr_in address{};
  socklen_t size = sizeof address;
  const int listening = listener.value().get();
  if (getsockname(listening, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    return socketError(url, "no port", errno);
  }
  address.sin_addr = addressOf(url).sin_addr;
  const auto sent = token(address);
  if (sendto(speaker.value().get(), sent.data(), sent.size(), MSG_NOSIGNAL,
             reinterpret_cast<const sockaddr*>(&address), sizeof address) < 0) {
    return socketError(url, "cannot send to the group", errno);
  }
  if (comesBack(listening, sent)) return Done{};
  return Error::in(
      toString(url), ErrorCode::FileUnreadable,
      "a datagram sent to the group did not come back; expected it within a second: is multicast "
      "on (ip link set lo multicast on), and does the firewall let it through?");
}

}  // namespace foretouch
