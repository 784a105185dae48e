// bench/private_network.h: a network of this process' own, in which multicast works and from
// which nothing leaves: for measurements and trials of the stream.
#pragma once

#include "articulated/result.h"

namespace foretouch::tools {

/// Moves the calling thread, and every process and thread that it starts from now on, into a new
/// network namespace (of a new user namespace where the user is not root) whose loopback device is
/// up and has the route of multicast. Call it before there are other threads. Errors say which step
/// the system refused.
[[nodiscard]] Result<Done> enterPrivateNetwork();

}  // namespace foretouch::tools
