// bench/private_network.h: a private network of this process, in which multicast works and which
// nothing leaves: for measurements and trials of the stream.
#pragma once

#include "articulated/result.h"

namespace foretouch::tools {

/// Moves the calling thread, and every process and thread that it starts from now on, into a new
/// network namespace (of a new user namespace if the user is not root) whose loopback device is up
/// and has the multicast route. Call it before starting other threads. Errors name the step that
/// the system refused.
[[nodiscard]] Result<Done> enterPrivateNetwork();

}  // namespace foretouch::tools
