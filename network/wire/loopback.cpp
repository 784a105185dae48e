#include "network/wire/loopback.h"

#include <algorithm>
#include <arpa/inet.h>
#include <cstdint>
#include <netinet/in.h>

namespace foretouch {

bool isNumericAddress(const std::string& host) {
  in_addr four{};
  in6_addr six{};
  return ::inet_pton(AF_INET, host.c_str(), &four) == 1 ||
         ::inet_pton(AF_INET6, host.c_str(), &six) == 1;
}

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

bool isLoopbackHost(const std::string& host) {
  constexpr std::size_t kLongestPort = 5;
  std::string name = host, port;
  const bool isBracketed = !host.empty() && host.front() == '[';
  const std::size_t nameEnd = isBracketed ? host.find(']') : host.find(':');
  if (isBracketed) {
    if (nameEnd == std::string::npos) return false;
    name = host.substr(1, nameEnd - 1);
    port = host.substr(nameEnd + 1);
    if (name.find(':') == std::string::npos) return false;
  } else if (nameEnd != std::string::npos) {
    name = host.substr(0, nameEnd);
    port = host.substr(nameEnd);
  }
  if (!port.empty()) {
    const bool isPort =
        port.front() == ':' && port.size() > 1 && port.size() <= 1 + kLongestPort &&
        std::all_of(port.begin() + 1, port.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!isPort) return false;
  }
  return isLoopback(name);
}

bool isOwnOrigin(const std::string& origin, const std::string& host) {
  return origin == "http://" + host;
}

}  // namespace foretouch
