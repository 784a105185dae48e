#include "bench/slow_clients.h"

#include <array>
#include <chrono>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "network/wire/descriptor.h"

namespace foretouch::tools {
namespace {

/// A second is longer than any attacker here needs, and lets threads end.
constexpr timeval kPatience{1, 0}, kProbePatience{60, 0};

Descriptor connectedTo(std::uint16_t port, const timeval& patience, int receiveBytes = 0) {
  Descriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  if (receiveBytes > 0) {
    ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVBUF, &receiveBytes, sizeof receiveBytes);
  }
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return Descriptor();
  }
  return socket;
}

bool sendTo(const Descriptor& socket, const std::string& text) {
  return ::send(socket.get(), text.data(), text.size(), MSG_NOSIGNAL) ==
         static_cast<ssize_t>(text.size());
}

std::string requestFor(const std::string& path) {
  return "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
}

}  // namespace

SlowClients::SlowClients(Kind kind, int count, std::uint16_t port) {
  for (int i = 0; i < count; ++i) threads_.emplace_back([this, kind, port] { run(kind, port); });
}

SlowClients::~SlowClients() {
  stop_ = true;
  for (std::thread& thread : threads_) thread.join();
}

void SlowClients::run(Kind kind, std::uint16_t port) {
  while (!stop_) {
    const bool isMute = kind == Kind::NoRead;
    const Descriptor socket = connectedTo(port, kPatience, isMute ? 4096 : 0);
    if (!sendTo(socket, isMute ? requestFor("/view.json") : "G")) continue;
    while (isMute && !stop_) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    char byte = 0;
    static_cast<void>(::recv(socket.get(), &byte, 1, 0));
  }
}

double secondsToGet(const std::string& path, std::uint16_t port) {
  const auto begin = std::chrono::steady_clock::now();
  const Descriptor socket = connectedTo(port, kProbePatience);
  if (!sendTo(socket, requestFor(path))) return -1.0;
  std::string head;
  std::array<char, 65536> bytes;
  for (ssize_t got = 0; (got = ::recv(socket.get(), bytes.data(), bytes.size(), 0)) > 0;) {
    if (head.empty()) head.assign(bytes.data(), static_cast<std::size_t>(got));
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  return head.rfind("HTTP/1.1 200", 0) == 0 ? taken.count() : -1.0;
}

}  // namespace foretouch::tools
