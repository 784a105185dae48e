// tools/commands/serve_command.h: `foretouch serve`.
#pragma once

#include "articulated/result.h"
#include "tools/console.h"
#include "tools/stream/serve_config.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Adds the subcommand; what it ends with goes to `exit`, which must outlive `program`.
void addServeCommand(CLI::App& program, ExitCode& exit);

/// Serves until SIGINT, SIGTERM or SIGHUP; then answers what waits. Says on stdout what it serves,
/// and "ready" on a line of its own once poses are taken. The error is one of starting, or what
/// kept the service from going on.
[[nodiscard]] Result<Done> serve(const ServeConfig& config);

}  // namespace foretouch::tools
