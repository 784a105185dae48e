// tools/commands/serve_command.h: `foretouch serve`.
#pragma once

#include "articulated/result.h"
#include "tools/settings/command_line.h"
#include "tools/settings/serve_settings.h"

namespace foretouch::tools {

[[nodiscard]] Command serveCommand();

/// Serves until SIGINT, SIGTERM or SIGHUP; then answers the waiting poses. Prints what it serves on
/// stdout, and "ready" on a line of its own once it accepts poses. Errors: a failed start, or the
/// failure that stopped the service.
[[nodiscard]] Result<Done> serve(const ServeConfig& config);

}  // namespace foretouch::tools
