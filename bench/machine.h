// bench/machine.h: the machine of a measurement.
#pragma once

#include <string>
#include <vector>

#include "bench/report.h"

namespace foretouch::tools {

/// Processor, cores, vector widths, compiler, build type, version and the machine's load now.
[[nodiscard]] std::vector<BenchFact> machineFacts();

/// Now, UTC, "2026-01-31 12:00".
[[nodiscard]] std::string dateNow();

/// The words of a command line, quoted for a shell, the program as "foretouch" and files by their
/// names, without their folders, which do not concern readers.
[[nodiscard]] std::string commandLine(const std::vector<std::string>& arguments);

/// This process' own command line.
[[nodiscard]] std::string ownCommandLine();

/// Keeps the calling thread on one processor; false if the system refuses.
[[nodiscard]] bool pinToProcessor(int processor);

/// Processor time of this thread (us): other work on the machine does not count.
[[nodiscard]] double threadTimeUs();

}  // namespace foretouch::tools
