#include "network/service/metrics_server.h"

#include <utility>

#include "articulated/try.h"
#include "network/service/bounded_http.h"

namespace foretouch {
namespace {

using Handled = httplib::Server::HandlerResponse;

/// A page of a stranger, in a browser on this machine, must not read what this machine says to
/// itself. An address that others reach has other names, and hides nothing.
Handled readFromHere(const httplib::Request& request, httplib::Response& response) {
  const bool isRead = request.method == "GET" || request.method == "HEAD";
  if (isRead && !internal::namesForeignHost(request)) return Handled::Unhandled;
  response.status = isRead ? 403 : 405;
  if (!isRead) response.set_header("Allow", "GET, HEAD");
  return Handled::Handled;
}

void addPages(httplib::Server& server, MetricsServer::Pages pages) {
  server.Get("/metrics", [page = std::move(pages.metrics)](const httplib::Request&,
                                                           httplib::Response& response) {
    response.set_content(page(), "text/plain; version=0.0.4; charset=utf-8");
  });
  server.Get("/healthz", [page = std::move(pages.health)](const httplib::Request&,
                                                          httplib::Response& response) {
    const ServiceHealth health = page();
    response.status = health.isWell ? 200 : 503;
    response.set_content(health.text, "text/plain; charset=utf-8");
  });
}

}  // namespace

struct MetricsServer::Impl {
  internal::BoundedHttp server{internal::HttpBounds{kMaxRequestBytes, kRequestMs, kRequestMs}};
};

MetricsServer::MetricsServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MetricsServer::MetricsServer(MetricsServer&&) noexcept = default;
MetricsServer& MetricsServer::operator=(MetricsServer&&) noexcept = default;
MetricsServer::~MetricsServer() = default;

Result<MetricsServer> MetricsServer::start(const std::string& host, std::uint16_t port,
                                           Pages pages) {
  auto impl = std::make_unique<Impl>();
  addPages(impl->server, std::move(pages));
  if (isLoopback(host)) impl->server.set_pre_routing_handler(readFromHere);
  FORETOUCH_CHECK(impl->server.start("metrics", host, port));
  return MetricsServer(std::move(impl));
}

std::uint16_t MetricsServer::port() const {
  return impl_->server.port();
}

}  // namespace foretouch
