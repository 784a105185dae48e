#include "tools/results_output.h"

#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/interrupt.h"

namespace foretouch::tools {

bool isSameFile(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code absent;
  const auto whole = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path, absent), absent);
  };
  return fs::equivalent(a, b, absent) || whole(a) == whole(b);
}

Result<Done> checkIsNoInput(const std::string& output, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code missing;
    if (!input.empty() && std::filesystem::equivalent(output, input, missing)) {
      return Error::in(output, ErrorCode::FileUnwritable,
                       "is an input as well; expected another file to write");
    }
  }
  return Done{};
}

Result<Done> checkOutput(const std::string& output, const std::vector<std::string>& inputs) {
  FORETOUCH_CHECK(checkIsNoInput(output, inputs));
  // Opening a pipe and closing it again would signal its end to its reader.
  std::error_code absent;
  const std::filesystem::file_status status = std::filesystem::status(output, absent);
  if (std::filesystem::is_other(status)) return Done{};
  const InterruptGuard guard;  // the trial file must not stay behind
  FORETOUCH_CHECK(PendingFile::create(output));
  return Done{};
}

Result<Done> checkOutputs(const std::string& output, const std::string& report,
                          const std::vector<std::string>& inputs) {
  const auto checked = checkOutput(output, inputs);
  if (!checked.ok() || report.empty()) return checked;
  if (isSameFile(output, report)) {
    return Error::in(report, ErrorCode::FileUnwritable,
                     "is to hold the results as well; expected another file for the report");
  }
  return checkOutput(report, inputs);
}

bool isStandardOutput(const std::string& path) {
  struct stat file {
  }, out{};
  return ::stat(path.c_str(), &file) == 0 && ::fstat(STDOUT_FILENO, &out) == 0 &&
         file.st_dev == out.st_dev && file.st_ino == out.st_ino;
}

}  // namespace foretouch::tools
