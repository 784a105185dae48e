#include "tests/fuzz/http_inputs.h"

#include <algorithm>
#include <netinet/in.h>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <unistd.h>

#include "network/service/metrics_server.h"
#include "tests/fuzz/promise.h"

namespace foretouch::fuzz {
namespace {

constexpr std::string_view kPage = "foretouch_fuzzed 1\n";

MetricsServer& server() {
  static MetricsServer started = [] {
    auto made = MetricsServer::start(
        "127.0.0.1", 0, {[] { return std::string(kPage); }, [] { return ServiceHealth{}; }});
    require(made.ok(), "the server starts");
    return std::move(made).value();
  }();
  return started;
}

int connected() {
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(server().port());
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  require(fd >= 0 && connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0,
          "the server listens");
  // No FIN_WAIT for each of millions.
  const linger atOnce{1, 0};
  setsockopt(fd, SOL_SOCKET, SO_LINGER, &atOnce, sizeof atOnce);
  return fd;
}

std::string answerTo(std::string_view request) {
  const int fd = connected();
  for (std::size_t sent = 0; sent < request.size();) {
    const ssize_t count = send(fd, request.data() + sent, request.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) break;  // it has read enough and closed
    sent += static_cast<std::size_t>(count);
  }
  shutdown(fd, SHUT_WR);
  std::string answer;
  char bytes[4096];
  for (ssize_t count = 0; (count = recv(fd, bytes, sizeof bytes, 0)) > 0;) {
    answer.append(bytes, static_cast<std::size_t>(count));
    require(answer.size() < 65536, "answers are small");
  }
  close(fd);
  return answer;
}

}  // namespace

bool feedHttp(const std::uint8_t* data, std::size_t size) {
  // One byte, that waits for more, would take the server's patience each time.
  if (size == 0) return false;
  const std::string answer = answerTo({reinterpret_cast<const char*>(data), size});
  require(answer.empty() || answer.rfind("HTTP/1.", 0) == 0, "an answer is one of HTTP");
  require(answer.find("Access-Control-") == std::string::npos, "no other page may read it");
  return answer.find(kPage) != std::string::npos;
}

}  // namespace foretouch::fuzz
