// tools/stream/serve_options.h: what is typed after `foretouch serve`, over what its configuration
// says.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "tools/stream/serve_config.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Values as typed in; empty: not given.
struct ServeTexts {
  std::string config, scene, up, sceneScale, url, suffix, receiver, workers, queue, budgetUs, log,
      http, view, tolerance, fidelity, maxStep, confirmations;
  std::vector<std::string> avatars, ignore;
  bool unmatchedAtRest = false;
};

/// Adds the options to the command; they fill `texts`.
void addServeOptions(CLI::App& command, const std::shared_ptr<ServeTexts>& texts);

/// The configuration file's values where there is one, each replaced by the option that is given.
/// Errors name the option, or the file and its line.
[[nodiscard]] Result<ServeConfig> settledServeConfig(const ServeTexts& texts);

}  // namespace foretouch::tools
