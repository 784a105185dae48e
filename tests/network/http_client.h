// tests/network/http_client.h: HTTP as bytes: requests of browsers, and requests that no browser
// would send.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>
#include <utility>

#include <gtest/gtest.h>

namespace foretouch::test {

/// One TCP connection to this machine.
class Connection {
 public:
  /// `receiveBytes`: the system's buffer for unread bytes; 0: its own choice.
  explicit Connection(std::uint16_t port, int receiveBytes = 0)
      : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{30, 0};  // only a failing test waits so long
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    if (receiveBytes > 0) {
      ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receiveBytes, sizeof receiveBytes);
    }
    isOpen_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  Connection(Connection&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), isOpen_(other.isOpen_) {}
  ~Connection() {
    if (socket_ >= 0) ::close(socket_);
  }
  [[nodiscard]] bool isOpen() const { return isOpen_; }
  bool send(const std::string& text) {
    std::size_t sent = 0;
    while (sent < text.size()) {
      const ssize_t some = ::send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
      if (some <= 0) return false;
      sent += static_cast<std::size_t>(some);
    }
    return true;
  }
  void sendNoMore() { ::shutdown(socket_, SHUT_WR); }
  /// The next bytes; empty if the connection has ended.
  std::string receivedNext() {
    if (!held_.empty()) return std::exchange(held_, {});
    char buffer[4096];
    const ssize_t got = ::recv(socket_, buffer, sizeof buffer, 0);
    return got > 0 ? std::string(buffer, static_cast<std::size_t>(got)) : std::string();
  }
  /// Up to and with `text`, and no more; or to the end of the connection or of patience.
  std::string receivedUpTo(const std::string& text) {
    std::string received;
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    for (std::size_t from = 0; std::chrono::steady_clock::now() < until;) {
      const std::string next = receivedNext();
      if (next.empty()) break;
      received += next;
      const std::size_t found = received.find(text, from);
      if (found != std::string::npos) {
        held_ = received.substr(found + text.size());
        return received.substr(0, found + text.size());
      }
      from = received.size() - std::min(received.size(), text.size());
    }
    return received;
  }
  /// To the end of the connection.
  std::string received() {
    std::string text = std::exchange(held_, {});
    char buffer[4096];
    for (ssize_t got = 0; (got = ::recv(socket_, buffer, sizeof buffer, 0)) > 0;) {
      text.append(buffer, static_cast<std::size_t>(got));
    }
    return text;
  }

 private:
  int socket_ = -1;
  bool isOpen_ = false;
  std::string held_;  // read, but not returned yet
};

inline std::string asked(std::uint16_t port, const std::string& request) {
  Connection connection(port);
  EXPECT_TRUE(connection.isOpen());
  connection.send(request);
  return connection.received();
}

inline std::string get(std::uint16_t port, const std::string& path) {
  return asked(port, "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
}

inline int statusOf(const std::string& response) {
  return response.rfind("HTTP/1.1 ", 0) == 0 ? std::stoi(response.substr(9, 3)) : 0;
}

}  // namespace foretouch::test
