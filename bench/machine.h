// bench/machine.h: what a measurement was taken on.
#pragma once

#include <string>
#include <vector>

#include "bench/report.h"

namespace foretouch::tools {

/// Processor, cores, vector widths, compiler, build type, version and the machine's load now.
[[nodiscard]] std::vector<BenchFact> machineFacts();

/// Now, UTC, "2026-01-31 12:00".
[[nodiscard]] std::string dateNow();

/// The words of a command line, quoted as a shell would need them, the program as "foretouch" and
/// files by their names: where they lie is no reader's business.
[[nodiscard]] std::string commandLine(const std::vector<std::string>& arguments);

/// This process' own command line.
[[nodiscard]] std::string ownCommandLine();

/// Keeps the calling thread on one processor; false where the system refuses.
[[nodiscard]] bool pinToProcessor(int processor);

}  // namespace foretouch::tools
