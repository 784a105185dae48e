// network/wire/loopback.h: which hosts are this machine, and which requests come from a page that
// it serves itself. A browser runs the pages of strangers beside ours: it tells, in each request,
// the name by which it found us and the page that asks.
#pragma once

#include <string>

namespace foretouch {

/// A numeric address of either family.
[[nodiscard]] bool isNumericAddress(const std::string& host);

/// "localhost" and numeric addresses of this machine alone.
[[nodiscard]] bool isLoopback(const std::string& host);

/// Whether the Host of a request is this machine by one of those names, with or without a port
/// ("[::1]:9465"). A stranger's name that has been made to lead here (DNS rebinding) is none. The
/// port may be another one: that of a tunnel.
[[nodiscard]] bool isLoopbackHost(const std::string& host);

/// Whether the Origin of a request is the page that `host` serves: "http://" and the same text.
[[nodiscard]] bool isOwnOrigin(const std::string& origin, const std::string& host);

}  // namespace foretouch
