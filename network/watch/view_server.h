// network/watch/view_server.h: a page that shows what a service does, for browsers of this machine:
//   GET /           the page
//   GET /view.json  what it shows, as it stands when the service starts
//   GET /events     what happens from now on, as server-sent events
//
// Read only, and only by this machine: it listens on a loopback address, and answers 403 to
// requests that found it by another name (DNS rebinding) or that the page of somebody else makes.
// There is no password: whoever can run a program on this machine can watch. No header allows
// another origin.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "articulated/result.h"
#include "network/watch/audience.h"
#include "network/watch/view_event.h"

namespace foretouch {

/// Of a request, its headers and all: of localhost, a browser may send cookies of other programs.
inline constexpr std::size_t kMaxViewRequestBytes = 16384;

class ViewServer {
 public:
  struct Pages {
    std::string page;      ///< HTML.
    std::string document;  ///< JSON.
    std::unique_ptr<EventSource> events;
  };
  /// `host`: "localhost" or a numeric address of this machine; others are refused. Port 0: one that
  /// is free. Errors: another host, an address that is not there, a port that is taken.
  static Result<ViewServer> start(const std::string& host, std::uint16_t port, Pages pages,
                                  const AudienceOptions& options = {});
  ViewServer(ViewServer&&) noexcept;
  ViewServer& operator=(ViewServer&&) noexcept;
  ~ViewServer();  ///< Ends open connections.

  [[nodiscard]] std::uint16_t port() const;
  [[nodiscard]] std::size_t numViewers() const;

 private:
  struct Impl;
  explicit ViewServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
