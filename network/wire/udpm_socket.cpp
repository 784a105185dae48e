#include "network/wire/udpm_socket.h"

#include <algorithm>
#include <arpa/inet.h>
#include <cerrno>
#include <limits>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>

namespace foretouch {
namespace {

// A whole message may leave at once: the system charges a buffer with about twice its bytes.
constexpr int kSendBufferBytes = 2 * static_cast<int>(kMaxMessageBytes);

ip_mreqn membershipOf(const UdpmUrl& url) {
  ip_mreqn membership{};
  membership.imr_multiaddr = addressOf(url).sin_addr;
  return membership;
}

/// Beyond the system's limit where we are privileged, else up to it.
void setBuffer(int fd, int forced, int asked, int bytes) {
  if (setsockopt(fd, SOL_SOCKET, forced, &bytes, sizeof bytes) == 0) return;
  setsockopt(fd, SOL_SOCKET, asked, &bytes, sizeof bytes);
}

bool switchOn(int fd, int option) {
  const int on = 1;
  return setsockopt(fd, SOL_SOCKET, option, &on, sizeof on) == 0;
}

}  // namespace

std::string toString(const UdpmUrl& url) {
  return "udpm://" + url.group + ":" + std::to_string(url.port) + "?ttl=" + std::to_string(url.ttl);
}

sockaddr_in addressOf(const UdpmUrl& url) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(url.port);
  inet_pton(AF_INET, url.group.c_str(), &address.sin_addr);
  return address;
}

Error socketError(const UdpmUrl& url, const std::string& what, int errorNumber) {
  std::string message = what + ": " + std::generic_category().message(errorNumber);
  if (errorNumber == ENODEV || errorNumber == ENETUNREACH || errorNumber == EADDRNOTAVAIL) {
    message +=
        "; expected a multicast route. Within this machine: ip link set lo up && ip link set lo "
        "multicast on && ip route add 224.0.0.0/4 dev lo. To others: ip route add 224.0.0.0/4 dev "
        "INTERFACE, and a ttl of 1 in the URL";
  }
  return {ErrorCode::FileUnreadable, toString(url), -1, -1, message};
}

int joinGroup(int fd, const UdpmUrl& url) {
  const ip_mreqn membership = membershipOf(url);
  const auto join = [&] {
    const bool isJoined =
        setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) == 0;
    return isJoined || errno == EADDRINUSE ? 0 : errno;
  };
  const int fault = join();
  if (fault != ENOBUFS) return fault;
  // Full of memberships on interfaces that no longer exist.
  while (setsockopt(fd, IPPROTO_IP, IP_DROP_MEMBERSHIP, &membership, sizeof membership) == 0) {
  }
  return join();
}

void prepareToListen(int fd, std::size_t bufferBytes) {
  const std::size_t most = std::numeric_limits<int>::max();
  setBuffer(fd, SO_RCVBUFFORCE, SO_RCVBUF, static_cast<int>(std::min(bufferBytes, most)));
  switchOn(fd, SO_TIMESTAMPNS);
  switchOn(fd, SO_RXQ_OVFL);
}

Result<internal::FileDescriptor> openListeningSocket(const UdpmUrl& url) {
  internal::FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int fd = socket.get();
  if (fd < 0) return socketError(url, "no socket", errno);
  // As liblcm does, so that any number of listeners share the port; all of them get everything.
  if (url.port != 0 && !switchOn(fd, SO_REUSEADDR)) {
    return socketError(url, "cannot share the port", errno);
  }
  prepareToListen(fd, url.receiveBufferBytes);
  // Else Linux delivers the groups that any program on this machine has joined on this port.
  const int off = 0;
  setsockopt(fd, IPPROTO_IP, IP_MULTICAST_ALL, &off, sizeof off);
  // To the group, not to any address: datagrams to only this machine are not for us.
  const sockaddr_in address = addressOf(url);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return socketError(url, "cannot listen", errno);
  }
  const int fault = joinGroup(fd, url);
  if (fault != 0) return socketError(url, "cannot join the group", fault);
  return socket;
}

Result<internal::FileDescriptor> openSendingSocket(const UdpmUrl& url) {
  internal::FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int fd = socket.get();
  if (fd < 0) return socketError(url, "no socket", errno);
  if (setsockopt(fd, IPPROTO_IP, IP_MULTICAST_TTL, &url.ttl, sizeof url.ttl) != 0) {
    return socketError(url, "cannot set the ttl", errno);
  }
  setBuffer(fd, SO_SNDBUFFORCE, SO_SNDBUF, kSendBufferBytes);
  return socket;
}

std::size_t receiveBufferOf(int fd) {
  int bytes = 0;
  socklen_t size = sizeof bytes;
  if (getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &bytes, &size) != 0 || bytes < 0) return 0;
  return static_cast<std::size_t>(bytes) / 2;  // Linux counts its bookkeeping and says the double
}

bool waitReadable(int fd, int timeoutMs) {
  pollfd watched{fd, POLLIN, 0};
  return poll(&watched, 1, std::max(timeoutMs, 0)) > 0;
}

}  // namespace foretouch
