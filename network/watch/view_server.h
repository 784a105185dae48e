// network/watch/view_server.h: a page that shows what a service does, for browsers of this machine:
//   GET /           the page
//   GET /view.json  the data that it shows, as of the start of the service
//   GET /events     everything from now on, as server-sent events
//
// Read-only, and only for this machine: it listens on a loopback address, and answers 403 to
// requests under another host name (DNS rebinding) or from another site's page. There is no
// password: anybody who can run a program on this machine can watch. No header allows another
// origin. Not installed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "articulated/result.h"
#include "network/watch/audience.h"
#include "network/watch/view_event.h"

namespace foretouch {

/// The most of a request, headers included: a browser may send localhost other programs' cookies.
inline constexpr std::size_t kMaxViewRequestBytes = 16384;

class ViewServer {
 public:
  struct Pages {
    std::string page;      ///< HTML.
    std::string document;  ///< JSON.
    std::unique_ptr<EventSource> events;
  };
  /// `host`: "localhost" or a numeric address of this machine; others are errors. Port 0: any free
  /// one. Errors: another host, an unknown address, a port in use.
  static Result<ViewServer> start(const std::string& host, std::uint16_t port, Pages pages,
                                  const AudienceOptions& options = {});
  ViewServer(ViewServer&&) noexcept;
  ViewServer& operator=(ViewServer&&) noexcept;
  ~ViewServer();  ///< Closes open connections.

  [[nodiscard]] std::uint16_t port() const;
  [[nodiscard]] std::size_t numViewers() const;

 private:
  struct Impl;
  explicit ViewServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
