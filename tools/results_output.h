// tools/results_output.h: where a command's results go.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

/// Refuses an output that is one of the inputs, and one that cannot be written, before any work.
[[nodiscard]] Result<Done> checkOutput(const std::string& output,
                                       const std::vector<std::string>& inputs);

/// The same of two outputs, which must not be one file. An empty `report` is none.
[[nodiscard]] Result<Done> checkOutputs(const std::string& output, const std::string& report,
                                        const std::vector<std::string>& inputs);

/// Files that go to standard output leave it to them: the summary then goes to stderr.
[[nodiscard]] bool isStandardOutput(const std::string& path);

}  // namespace foretouch::tools
