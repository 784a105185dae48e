// network/wire/loopback.h: which hosts are this machine, and which requests come from a page that
// it serves itself. A browser runs other sites' pages beside ours: each request carries the host
// name it used and the page it comes from. Not installed.
#pragma once

#include <string>

namespace foretouch {

/// True for a numeric address of either family.
[[nodiscard]] bool isNumericAddress(const std::string& host);

/// True only for "localhost" and numeric addresses of this machine.
[[nodiscard]] bool isLoopback(const std::string& host);

/// Whether the Host of a request is this machine by one of those names, with or without a port
/// ("[::1]:9465"). A foreign name that resolves to this machine (DNS rebinding) is not. The port
/// may differ: that of a tunnel.
[[nodiscard]] bool isLoopbackHost(const std::string& host);

/// Whether the Origin of a request is the page that `host` serves: "http://" and the same text.
[[nodiscard]] bool isOwnOrigin(const std::string& origin, const std::string& host);

}  // namespace foretouch
