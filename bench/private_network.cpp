#include "bench/private_network.h"

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <sched.h>
#include <string>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "articulated/try.h"

namespace foretouch::tools {
namespace {

constexpr char kLoopback[] = "lo";

Error refused(const std::string& step) {
  return Error::in("private network", ErrorCode::DeviceFailed,
                   "the system refused " + step + ": " + std::strerror(errno));
}

bool write(const char* path, const std::string& text) {
  const int file = ::open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::close(file);
  return done;
}

/// The caller is root in the new user namespace, so that it may set up its own network.
Result<Done> enterNamespaces() {
  if (::unshare(CLONE_NEWNET) == 0) return Done{};
  const std::string user = std::to_string(::geteuid()), group = std::to_string(::getegid());
  if (::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return refused("a network namespace");
  if (!write("/proc/self/setgroups", "deny") || !write("/proc/self/uid_map", "0 " + user + " 1") ||
      !write("/proc/self/gid_map", "0 " + group + " 1")) {
    return refused("the map of a user namespace");
  }
  return Done{};
}

void fill(sockaddr& address, std::uint32_t host) {
  sockaddr_in ip{};
  ip.sin_family = AF_INET;
  ip.sin_addr.s_addr = htonl(host);
  std::memcpy(&address, &ip, sizeof ip);
}

Result<Done> setUpLoopback(int socket) {
  ifreq device{};
  std::memcpy(device.ifr_name, kLoopback, sizeof kLoopback);
  if (::ioctl(socket, SIOCGIFFLAGS, &device) != 0) return refused("the flags of lo");
  device.ifr_flags = static_cast<short>(device.ifr_flags | IFF_UP | IFF_MULTICAST);
  if (::ioctl(socket, SIOCSIFFLAGS, &device) != 0) return refused("ip link set lo up");
  rtentry route{};
  fill(route.rt_dst, 0xE0000000u);      // 224.0.0.0
  fill(route.rt_genmask, 0xF0000000u);  // /4
  fill(route.rt_gateway, INADDR_ANY);
  route.rt_flags = RTF_UP;
  char name[] = "lo";
  route.rt_dev = name;
  if (::ioctl(socket, SIOCADDRT, &route) != 0) return refused("ip route add 224.0.0.0/4 dev lo");
  return Done{};
}

}  // namespace

Result<Done> enterPrivateNetwork() {
  FORETOUCH_CHECK(enterNamespaces());
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return refused("a socket");
  const auto done = setUpLoopback(socket);
  ::close(socket);
  return done;
}

}  // namespace foretouch::tools
