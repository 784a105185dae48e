// network/service/metrics_server.h: GET /metrics and GET /healthz over HTTP/1.1. A request may take
// a few kilobytes and a second, its response another one; one request per connection. Slow clients
// delay no others. On an address of this machine alone, a request under another host name is
// answered 403 (DNS rebinding). No TLS, no passwords: meant for this machine. Not installed.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "articulated/result.h"
#include "network/service/service.h"
#include "network/wire/loopback.h"

namespace foretouch {

/// The most of a request, headers included: no scraper needs more.
inline constexpr std::size_t kMaxRequestBytes = 4096;
/// From the connection to the last byte of the request, and again to that of the response.
inline constexpr int kRequestMs = 1000;

class MetricsServer {
 public:
  /// Make the pages; called from several threads.
  struct Pages {
    std::function<std::string()> metrics;
    std::function<ServiceHealth()> health;  ///< 200 if it is well, else 503.
  };
  /// `host`: a numeric address or "localhost"; other names are errors, because their resolver would
  /// decide which network we serve. Port 0: any free one. Errors: such a name, an unknown address,
  /// a port in use.
  static Result<MetricsServer> start(const std::string& host, std::uint16_t port, Pages pages);
  MetricsServer(MetricsServer&&) noexcept;
  MetricsServer& operator=(MetricsServer&&) noexcept;
  ~MetricsServer();  ///< Closes open connections.

  [[nodiscard]] std::uint16_t port() const;

 private:
  struct Impl;
  explicit MetricsServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
