// tools/results_output.h: the destination of a command's results.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

/// Whether two paths name one file, which need not be there yet.
[[nodiscard]] bool isSameFile(const std::string& a, const std::string& b);

/// Refuses an output that is one of the inputs. Skips empty paths.
[[nodiscard]] Result<Done> checkIsNoInput(const std::string& output,
                                          const std::vector<std::string>& inputs);

/// Refuses an output that is one of the inputs, or is not writable, before any work.
[[nodiscard]] Result<Done> checkOutput(const std::string& output,
                                       const std::vector<std::string>& inputs);

/// The same for two outputs, which must not be one file. An empty `report` means none.
[[nodiscard]] Result<Done> checkOutputs(const std::string& output, const std::string& report,
                                        const std::vector<std::string>& inputs);

/// True: the file takes standard output, so the summary goes to stderr.
[[nodiscard]] bool isStandardOutput(const std::string& path);

}  // namespace foretouch::tools
