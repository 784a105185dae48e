#include "network/watch/view_server.h"

#include <optional>
#include <utility>

#include "articulated/try.h"
#include "network/service/bounded_http.h"
#include "network/wire/loopback.h"

namespace foretouch {
namespace {

using httplib::Request;
using httplib::Response;
using Handled = httplib::Server::HandlerResponse;

constexpr int kRequestMs = 2000;
/// Enough for megabytes to a busy browser.
constexpr int kResponseMs = 15'000;

/// The seat of the viewer whose request this thread answers: the library's handlers do not know the
/// connection, and one thread handles each connection.
thread_local std::optional<Audience::Seat> seatInHand;

/// The header's value; nothing if it is missing or repeated: two are a trick.
std::optional<std::string> onlyHeader(const Request& request, const char* name) {
  const std::size_t count = request.get_header_value_count(name);
  if (count > 1) return std::nullopt;
  return request.get_header_value(name);
}

/// Whether the request is this machine's user's own, and not from another site's page in the user's
/// browser.
bool isOurs(const Request& request) {
  const auto host = onlyHeader(request, "Host");
  if (!host || host->empty() || internal::namesForeignHost(request)) return false;
  const auto origin = onlyHeader(request, "Origin");
  if (!origin || (request.has_header("Origin") && !isOwnOrigin(*origin, *host))) return false;
  // Browsers send this even without an Origin. Other sites may link to the page itself.
  const std::string site = request.get_header_value("Sec-Fetch-Site");
  return site.empty() || site == "same-origin" || site == "none" || request.path == "/";
}

void refuse(Response& response, int status, const char* why) {
  response.status = status;
  response.set_content(std::string(why) + "\n", "text/plain; charset=utf-8");
}

Handled checked(const Request& request, Response& response) {
  seatInHand.reset();
  if (request.method != "GET" && request.method != "HEAD") {
    response.set_header("Allow", "GET, HEAD");
    refuse(response, 405, "GET only");
    return Handled::Handled;
  }
  if (isOurs(request)) return Handled::Unhandled;
  refuse(response, 403, "only for this machine, by its own name, and for its own page");
  return Handled::Handled;
}

/// The page's own policy, which names the hashes of its script and style; without one, nothing
/// runs.
std::string policyOf(const std::string& page) {
  const std::string begin = "<meta http-equiv=\"Content-Security-Policy\" content=\"";
  const std::size_t at = page.find(begin);
  const std::size_t end = at == std::string::npos ? at : page.find('"', at + begin.size());
  const std::string own = end == std::string::npos
                              ? "default-src 'none'; base-uri 'none'; form-action 'none'"
                              : page.substr(at + begin.size(), end - at - begin.size());
  return own + "; frame-ancestors 'none'";
}

httplib::Headers safetyHeaders(const std::string& page) {
  return {{"Cache-Control", "no-store"},
          {"X-Content-Type-Options", "nosniff"},
          {"Referrer-Policy", "no-referrer"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Content-Security-Policy", policyOf(page)}};
}

void serveText(internal::BoundedHttp& server, const char* path, std::string content,
               const char* type) {
  const auto text = std::make_shared<const std::string>(std::move(content));
  server.share(text);
  server.Get(path, [text, type](const Request&, Response& response) {
    if (text->empty()) return response.set_content("", type);
    response.set_content_provider(
        text->size(), type,
        [text](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
          return sink.write(text->data() + offset, length);
        });
  });
}

void serveEvents(httplib::Server& server, Audience& audience) {
  server.Get("/events", [&audience](const Request& request, Response& response) {
    if (request.method == "GET") {
      std::optional<Audience::Seat> seat = audience.claimSeat();
      if (!seat) {
        response.set_header("Retry-After", "10");
        return refuse(response, 503, "too many are watching");
      }
      seatInHand.emplace(std::move(*seat));
    }
    // Headers now; the audience sends the rest.
    response.set_content_provider("text/event-stream", [](std::size_t, httplib::DataSink& sink) {
      sink.done();
      return true;
    });
  });
}

constexpr internal::HttpBounds kBounds{kMaxViewRequestBytes, kRequestMs, kResponseMs};

}  // namespace

struct ViewServer::Impl {
  explicit Impl(Audience started) : audience(std::move(started)) {}
  Audience audience;
  internal::BoundedHttp server{kBounds};
};

ViewServer::ViewServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ViewServer::ViewServer(ViewServer&&) noexcept = default;
ViewServer& ViewServer::operator=(ViewServer&&) noexcept = default;
ViewServer::~ViewServer() = default;

Result<ViewServer> ViewServer::start(const std::string& host, std::uint16_t port, Pages pages,
                                     const AudienceOptions& options) {
  if (!isLoopback(host)) {
    return Error::of(
        ErrorCode::OutOfRange,
        "cannot serve the view on " + host +
            ": expected localhost or a numeric address of this machine alone; to watch "
            "from another one, use a tunnel: ssh -L");
  }
  FORETOUCH_TRY(auto audience, Audience::start(std::move(pages.events), options));
  auto impl = std::make_unique<Impl>(std::move(audience));
  internal::BoundedHttp& server = impl->server;
  server.set_default_headers(safetyHeaders(pages.page));
  server.set_pre_routing_handler(checked);
  serveText(server, "/", std::move(pages.page), "text/html; charset=utf-8");
  serveText(server, "/view.json", std::move(pages.document), "application/json");
  serveEvents(server, impl->audience);
  server.takerOfLast = []() -> internal::BoundedHttp::Taker {
    std::optional<Audience::Seat> seat = std::exchange(seatInHand, std::nullopt);
    if (!seat) return {};
    const auto held = std::make_shared<Audience::Seat>(std::move(*seat));
    return [held](socket_t socket) { return held->take(socket); };
  };
  FORETOUCH_CHECK(server.start("the view", host, port));
  return ViewServer(std::move(impl));
}

std::uint16_t ViewServer::port() const {
  return impl_->server.port();
}

std::size_t ViewServer::numViewers() const {
  return impl_->audience.size();
}

}  // namespace foretouch
