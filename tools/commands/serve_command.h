// tools/commands/serve_command.h: `foretouch serve`.
#pragma once

#include "articulated/result.h"
#include "tools/settings/command_line.h"
#include "tools/settings/serve_settings.h"

namespace foretouch::tools {

[[nodiscard]] Command serveCommand();

/// Serves until SIGINT, SIGTERM or SIGHUP; then answers what waits. Says on stdout what it serves,
/// and "ready" on a line of its own once poses are taken. The error is one of starting, or what
/// kept the service from going on.
[[nodiscard]] Result<Done> serve(const ServeConfig& config);

}  // namespace foretouch::tools
