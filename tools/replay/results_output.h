// tools/replay/results_output.h: where a command's results go.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

/// Refuses an output that is one of the inputs, and one that cannot be written, before any work.
[[nodiscard]] Result<Done> checkOutput(const std::string& output,
                                       const std::vector<std::string>& inputs);

/// Results that go to standard output leave it to them: the summary then goes to stderr.
[[nodiscard]] bool isStandardOutput(const std::string& path);

}  // namespace foretouch::tools
