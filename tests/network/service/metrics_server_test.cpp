#include "network/service/metrics_server.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/network/http_client.h"

namespace foretouch {
namespace {

using test::asked;
using test::Connection;
using test::get;
using test::statusOf;

using SteadyClock = std::chrono::steady_clock;
using std::chrono::milliseconds;

class Metrics : public testing::Test {
 protected:
  Metrics() : server_(MetricsServer::start("127.0.0.1", 0, pages()).value()) {}
  MetricsServer::Pages pages() {
    return {[this] {
              ++asked_;
              return std::string("some_total 1\n");
            },
            [this] {
              return ServiceHealth{isWell_, isWell_ ? "ok\n" : "stuck\n"};
            }};
  }
  [[nodiscard]] std::uint16_t port() const { return server_.port(); }
  void expectAnswers() { EXPECT_EQ(statusOf(get(port(), "/metrics")), 200); }

  std::atomic<bool> isWell_{true};
  std::atomic<int> asked_{0};
  MetricsServer server_;
};

TEST_F(Metrics, AreServedAsPrometheusReadsThem) {
  const std::string response = get(port(), "/metrics");
  EXPECT_EQ(statusOf(response), 200);
  EXPECT_NE(response.find("Content-Type: text/plain; version=0.0.4"), std::string::npos);
  EXPECT_NE(response.find("\r\n\r\nsome_total 1\n"), std::string::npos);
  EXPECT_EQ(asked_, 1);
  EXPECT_EQ(statusOf(asked(port(), "HEAD /metrics HTTP/1.0\r\n\r\n")), 200);
}

TEST_F(Metrics, TellHealthByTheStatus) {
  EXPECT_EQ(statusOf(get(port(), "/healthz")), 200);
  isWell_ = false;
  const std::string response = get(port(), "/healthz");
  EXPECT_EQ(statusOf(response), 503);
  EXPECT_NE(response.find("stuck"), std::string::npos);
}

TEST_F(Metrics, AreAllThereIs) {
  for (const char* path : {"/", "/metrics/", "/metricsx", "/../etc/passwd", "/%2e%2e/etc/passwd"}) {
    EXPECT_EQ(statusOf(get(port(), path)), 404) << path;
  }
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS"}) {
    const std::string response =
        asked(port(), std::string(method) + " /metrics HTTP/1.1\r\nContent-Length: 3\r\n\r\nabc");
    EXPECT_EQ(statusOf(response), 405) << method;
  }
  EXPECT_EQ(asked_, 0);
}

TEST_F(Metrics, SurviveGarbage) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::string bytes(random() % 3000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    if (i % 3 == 0) bytes = "GET /metrics HTTP/1.1\r\n" + bytes + "\r\n\r\n";
    Connection connection(port());
    ASSERT_TRUE(connection.isOpen());
    connection.send(bytes);
    connection.sendNoMore();
    connection.received();
  }
  expectAnswers();
}

TEST_F(Metrics, SurviveCraftedRequests) {
  const std::string line = "GET /metrics HTTP/1.1\r\n";
  std::string ranges = "Range: bytes=0-0";
  while (ranges.size() < kMaxRequestBytes - 100) ranges += ",0-0";
  std::string manyHeaders;
  for (int i = 0; i < 500; ++i) manyHeaders += "X" + std::to_string(i) + ": y\r\n";
  const std::vector<std::string> requests{
      "",
      "\r\n\r\n",
      "GET",
      "GET /metrics HTTP/9.9\r\n\r\n",
      "GET /metrics\r\n\r\n",
      line + ranges + "\r\n\r\n",
      line + "Range: bytes=99999999999999999999-\r\n\r\n",
      line + "Range: bytes=-99999999999999999999\r\n\r\n",
      line + "Content-Length: -1\r\n\r\n",
      line + "Content-Length: 99999999999999999999\r\n\r\n",
      "POST /metrics HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n",
      "POST /metrics HTTP/1.1\r\nExpect: 100-continue\r\nContent-Length: 4\r\n\r\n",
      "GET /" + std::string(3 * kMaxRequestBytes, 'a') + " HTTP/1.1\r\n\r\n",
      line + manyHeaders + "\r\n",
      line + "X: " + std::string(kMaxRequestBytes, 'y') + "\r\n\r\n",
      line + "Accept-Encoding: gzip, br, deflate\r\n\r\n",
      "GET /metrics%00 HTTP/1.1\r\n\r\n",
      "GET /metrics?" + std::string(2000, '&') + " HTTP/1.1\r\n\r\n"};
  for (const std::string& request : requests) {
    Connection connection(port());
    ASSERT_TRUE(connection.isOpen());
    connection.send(request);
    connection.sendNoMore();
    connection.received();
    expectAnswers();
  }
}

// Connections that say nothing, or a byte now and then, have their time and are closed.
TEST_F(Metrics, OutliveThoseWhoDripBytes) {
  std::vector<Connection> silent;
  for (int i = 0; i < 8; ++i) silent.emplace_back(port());
  Connection dripping(port());
  const auto start = SteadyClock::now();
  bool isOpen = dripping.send("GET /metrics HTTP/1.1\r\n");
  while (isOpen && SteadyClock::now() - start < milliseconds(120 * kRequestMs)) {
    std::this_thread::sleep_for(milliseconds(50));
    isOpen = dripping.send("X");
  }
  EXPECT_FALSE(isOpen);
  expectAnswers();
}

TEST_F(Metrics, AreReadByNoPageOfAStranger) {
  const auto withHosts = [&](const std::string& hosts) {
    return statusOf(asked(port(), "GET /healthz HTTP/1.1\r\n" + hosts + "\r\n"));
  };
  EXPECT_EQ(withHosts(""), 200);  // no browser
  for (const char* host : {"localhost", "127.0.0.1:9464", "[::1]:9464"}) {
    EXPECT_EQ(withHosts("Host: " + std::string(host) + "\r\n"), 200) << host;
  }
  for (const char* host : {"example.org", "127.0.0.1.example.org", "10.0.0.1", "localhost."}) {
    EXPECT_EQ(withHosts("Host: " + std::string(host) + "\r\n"), 403) << host;
  }
  EXPECT_EQ(withHosts("Host: localhost\r\nHost: localhost\r\n"), 403);
  EXPECT_EQ(asked_, 0);
}

/// Connections that say a byte and then nothing, opened again whenever one is closed.
class SlowClients {
 public:
  SlowClients(std::uint16_t port, std::size_t count) : port_(port) {
    for (std::size_t i = 0; i < count; ++i) open();
  }
  void openAnother() {
    open();
    connections_.pop_front();
  }

 private:
  void open() {
    connections_.emplace_back(port_);
    connections_.back().send("G");
  }
  std::uint16_t port_;
  std::deque<Connection> connections_;
};

// Whoever waits for the slow ones waits until their time is over: so the answer shows who waited.
TEST_F(Metrics, DoNotWaitForSlowClients) {
  for (const std::size_t count : {24, 63, 64, 200}) {
    SCOPED_TRACE(count);
    SlowClients slow(port(), count);
    for (int i = 0; i < 20; ++i) {
      expectAnswers();
      slow.openAnother();
    }
  }
}

TEST_F(Metrics, EndWithConnectionsOpen) {
  std::vector<Connection> silent;
  for (int i = 0; i < 4; ++i) silent.emplace_back(port());
  for (Connection& connection : silent) connection.send("GET ");
  const auto start = SteadyClock::now();
  { const MetricsServer ended = std::move(server_); }
  EXPECT_LT(SteadyClock::now() - start, milliseconds(60 * kRequestMs));
  server_ = MetricsServer::start("127.0.0.1", 0, pages()).value();
  expectAnswers();
}

TEST_F(Metrics, ShareNoPort) {
  const auto second = MetricsServer::start("127.0.0.1", port(), pages());
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().message.find("127.0.0.1:" + std::to_string(port())), std::string::npos);
  EXPECT_NE(second.error().message.find("in use"), std::string::npos) << second.error().message;
}

TEST(MetricsServer, TakesAddressesAndNoNames) {
  EXPECT_FALSE(MetricsServer::start("example.org", 0, {}).ok());
  EXPECT_FALSE(MetricsServer::start("", 0, {}).ok());
  EXPECT_TRUE(MetricsServer::start("localhost", 0, {}).ok());
  for (const char* host : {"localhost", "127.0.0.1", "127.1.2.3", "::1"}) {
    EXPECT_TRUE(isLoopback(host)) << host;
  }
  for (const char* host : {"0.0.0.0", "10.0.0.1", "::", "example.org", "", "128.0.0.1"}) {
    EXPECT_FALSE(isLoopback(host)) << host;
  }
}

}  // namespace
}  // namespace foretouch
