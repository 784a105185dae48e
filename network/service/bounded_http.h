// network/service/bounded_http.h: cpp-httplib within bounds: a request has so many bytes and so
// much time in all, one connection one request, a few threads, and a bounded number of connections
// that wait for one. GET and HEAD alone. Not installed: it shows the library.
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
  std::size_t requestBytes = 4096;  ///< Its headers and all.
  int requestMs = 1000;             ///< From the first byte that is waited for to its last.
  int responseMs = 0;               ///< More time, for the response.
};

class BoundedHttp final : public httplib::Server {
 public:
  explicit BoundedHttp(const HttpBounds& bounds);
  BoundedHttp(const BoundedHttp&) = delete;
  BoundedHttp& operator=(const BoundedHttp&) = delete;
  ~BoundedHttp() override;  ///< As end().

  /// Called after each request, in the thread that answered it, and told whether it could be; true:
  /// the socket has another owner now. Throws nothing. Set before start().
  std::function<bool(socket_t, bool isAnswered)> takeOver;

  /// Serves from here on. `host`: a numeric address or "localhost"; other names are refused, as it
  /// would be their resolver who says which network is served. Port 0: one that is free. Errors
  /// begin "cannot serve `what` on": such a name, an address that is not there, a port that is
  /// taken.
  [[nodiscard]] Result<Done> start(const std::string& what, const std::string& host,
                                   std::uint16_t port);
  /// Ends open connections.
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
