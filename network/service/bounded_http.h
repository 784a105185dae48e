// network/service/bounded_http.h: cpp-httplib's handlers behind a server within bounds. One thread
// reads all requests and sends all responses, and waits for no client: a slow one costs the others
// nothing. Only complete requests reach a handler, in that thread. One request per connection;
// limits on its bytes and time, on the connections, and on those of one address, whose oldest
// unfinished one makes way for a new one. GET and HEAD only. Not installed: it exposes cpp-httplib.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <httplib.h>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "articulated/result.h"
#include "assets/system_files.h"

namespace foretouch::internal {

struct HttpBounds {
  std::size_t requestBytes = 4096;  ///< Headers included.
  int requestMs = 1000;             ///< From accepting the connection to the last byte.
  int responseMs = 1000;            ///< More time, for the response.
};

/// Connections at a time, and those from one address.
inline constexpr std::size_t kMaxHttpConnections = 128;
inline constexpr std::size_t kMaxHttpPerAddress = kMaxHttpConnections / 2;

/// Whether the request names a host that is not this machine: a stranger's name that leads here
/// (DNS rebinding), or several names. A request that no browser sends may name none.
[[nodiscard]] bool namesForeignHost(const httplib::Request& request);

class BoundedHttp final : public httplib::Server {
 public:
  explicit BoundedHttp(const HttpBounds& bounds);
  BoundedHttp(const BoundedHttp&) = delete;
  BoundedHttp& operator=(const BoundedHttp&) = delete;
  ~BoundedHttp() override;  ///< As end().

  /// Takes a socket whose response was sent; false: it did not.
  using Taker = std::function<bool(socket_t)>;
  /// Called after a request was handled, in the same thread: what takes the socket afterwards;
  /// empty: it is closed. Set before start().
  std::function<Taker()> takerOfLast;
  /// A response that is part of this text refers to it instead of copying it. Before start().
  void share(std::shared_ptr<const std::string> text) { shared_.push_back(std::move(text)); }

  /// Starts to serve. `host`: a numeric address or "localhost"; other names are errors, because
  /// their resolver would decide which network we serve. Port 0: any free one. Errors begin "cannot
  /// serve `what` on": such a name, an unknown address, a port in use.
  [[nodiscard]] Result<Done> start(const std::string& what, const std::string& host,
                                   std::uint16_t port);
  /// Closes open connections.
  void end();
  [[nodiscard]] std::uint16_t port() const { return static_cast<std::uint16_t>(port_); }

 private:
  struct Client;
  class MemoryStream;
  void run();
  void takeTurn();
  void wait();
  void admit();
  bool makePlace(const std::string& address);
  void serve(Client& client);
  void read(Client& client);
  void handle(Client& client);
  void send(Client& client);

  const HttpBounds bounds_;
  std::atomic<bool> isStopping_{false};
  int port_ = 0;
  internal::FileDescriptor wake_;
  std::vector<std::shared_ptr<const std::string>> shared_;
  std::vector<std::unique_ptr<Client>> clients_;  // the thread's
  bool isAccepting_ = true;                       // the system has descriptors
  std::thread thread_;
};

}  // namespace foretouch::internal
