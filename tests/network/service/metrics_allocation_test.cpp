// A server of pages where memory ends: every allocation from a connection to its response fails
// once. That response may be lost; the next one is not.
#include <cstdint>
#include <netinet/in.h>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "network/service/metrics_server.h"
#include "tests/network/http_client.h"
#include "tests/support/allocation_count.h"

namespace foretouch::test {
namespace {

/// Asks and waits for the connection's end, and allocates nothing itself.
void askWithoutMemory(std::uint16_t port) {
  constexpr std::string_view kRequest = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      ::send(fd, kRequest.data(), kRequest.size(), MSG_NOSIGNAL) > 0) {
    char buffer[1024];
    while (::recv(fd, buffer, sizeof buffer, 0) > 0) {
    }
  }
  ::close(fd);
}

TEST(MetricsServer, SurvivesWhicheverAllocationFails) {
  if (!countsAllocations()) GTEST_SKIP() << "allocations cannot be made to fail here";
  auto server = MetricsServer::start(
      "127.0.0.1", 0,
      {[] { return std::string("some_total 1\n"); }, [] { return ServiceHealth{}; }});
  ASSERT_TRUE(server.ok());
  const std::uint16_t port = server.value().port();
  ASSERT_EQ(statusOf(get(port, "/healthz")), 200);
  int failed = 0;
  for (bool hasFailed = true; hasFailed && failed < 10'000;) {
    failAllocationAfter(failed);
    askWithoutMemory(port);
    hasFailed = stopFailing();
    failed += hasFailed ? 1 : 0;
    ASSERT_EQ(statusOf(get(port, "/healthz")), 200) << failed;
  }
  EXPECT_GT(failed, 5);
}

}  // namespace
}  // namespace foretouch::test
