// network/service/bounded_http.h: cpp-httplib within bounds: limits on a request's bytes and total
// time, one request per connection, a few threads, and a bounded number of connections that wait
// for one. GET and HEAD only. Not installed: it exposes cpp-httplib.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <httplib.h>
#include <string>
#include <thread>

#include "articulated/result.h"

namespace foretouch::internal {

struct HttpBounds {
  std::size_t requestBytes = 4096;  ///< Headers included.
  int requestMs = 1000;             ///< From the wait for its first byte to its last byte.
  int responseMs = 0;               ///< More time, for the response.
};

class BoundedHttp final : public httplib::Server {
 public:
  explicit BoundedHttp(const HttpBounds& bounds);
  BoundedHttp(const BoundedHttp&) = delete;
  BoundedHttp& operator=(const BoundedHttp&) = delete;
  ~BoundedHttp() override;  ///< As end().

  /// Called after each request, in the thread that answered it; `isAnswered`: whether that
  /// succeeded. Returns true if it now owns the socket. Must not throw. Set before start().
  std::function<bool(socket_t, bool isAnswered)> takeOver;

  /// Starts to serve. `host`: a numeric address or "localhost"; other names are errors, because
  /// their resolver would decide which network we serve. Port 0: any free one. Errors begin "cannot
  /// serve `what` on": such a name, an unknown address, a port in use.
  [[nodiscard]] Result<Done> start(const std::string& what, const std::string& host,
                                   std::uint16_t port);
  /// Closes open connections.
  void end();
  [[nodiscard]] std::uint16_t port() const { return static_cast<std::uint16_t>(port_); }

 private:
  bool process_and_close_socket(socket_t socket) override;

  const HttpBounds bounds_;
  std::atomic<bool> isStopping_{false}, hasEnded_{false};
  int port_ = 0;
  std::thread thread_;
};

}  // namespace foretouch::internal
