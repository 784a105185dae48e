#include "assets/import/run.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "articulated/try.h"
#include "assets/import/process.h"
#include "assets/import/text.h"
#include "assets/import/usable_memory.h"

namespace foretouch::internal {
namespace {

// Below this the importer's own libraries do not load, whatever the file.
constexpr std::size_t kMinMemoryBytes = std::size_t{64} << 20;
constexpr double kMaxTimeS = 1e6;
constexpr std::size_t kQuotedBytes = 200;
// Constant-initialised: other sources' initialisers set it before main().
std::atomic<const char*> packagedImporter{nullptr};

std::string shortest(double number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", number);
  return text.data();
}

/// Half of what there is remains for other processes, whatever the caller allows.
std::size_t memoryFor(const SceneImportOptions& options) {
  const auto usable = usableMemory();
  if (!usable) return options.memoryLimitBytes;
  return std::min(options.memoryLimitBytes, std::max(*usable / 2, kMinMemoryBytes));
}

/// The model itself, and where its parts may lie.
Cage cageFor(const std::string& importer, const std::string& path,
             std::vector<std::string> folders) {
  if (kUnderSanitizer) return {};
  folders.push_back(path);
  const char* const libraries = std::getenv("LD_LIBRARY_PATH");
  return Cage(importer, folders, libraries == nullptr ? "" : libraries);
}

std::string errorText(int error) {
  return std::generic_category().message(error);
}

std::optional<Error> badOption(const std::string& path, const SceneImportOptions& options) {
  const double scale = options.scale.value_or(1.0);
  if (!std::isfinite(scale) || !(scale > 0.0)) {
    return importError(path, ErrorCode::OutOfRange,
                       "expected a finite scale above 0, found " + shortest(scale));
  }
  if (!(options.timeLimitS > 0.0 && options.timeLimitS <= kMaxTimeS)) {
    return importError(path, ErrorCode::OutOfRange,
                       "expected a time limit above 0 and at most 1000000 seconds, found " +
                           shortest(options.timeLimitS));
  }
  if (options.memoryLimitBytes < kMinMemoryBytes) {
    return importError(path, ErrorCode::OutOfRange,
                       "expected a memory limit of at least " + std::to_string(kMinMemoryBytes) +
                           " bytes, found " + std::to_string(options.memoryLimitBytes));
  }
  return std::nullopt;
}

/// Errors that need no reader: does not start the importer for such a path.
std::optional<Error> badPath(const std::string& path) {
  if (path.empty() || path.find('\0') != std::string::npos) {
    return importError(path.c_str(), ErrorCode::FileNotFound, "expected the path of a model file");
  }
  // O_NONBLOCK: opening a pipe would wait for its writer.
  const int fd = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) {
    return importError(path, ErrorCode::FileNotFound, "cannot open the file: " + errorText(errno));
  }
  struct stat status {};
  const bool known = fstat(fd, &status) == 0;
  const int error = errno;
  close(fd);
  if (!known) return importError(path, ErrorCode::FileUnreadable, errorText(error));
  if (S_ISDIR(status.st_mode)) {
    return importError(path, ErrorCode::FileUnreadable, "expected a model file, found a directory");
  }
  if (!S_ISREG(status.st_mode)) {
    return importError(path, ErrorCode::FileUnreadable,
                       "expected a model file, found something that is not a regular file");
  }
  if (status.st_size == 0) {
    return importError(path, ErrorCode::Empty, "expected a model, found an empty file");
  }
  if (std::filesystem::path(path).extension().string().size() < 2) {
    return importError(path, ErrorCode::UnknownName,
                       "expected an extension that names the format, such as .obj, .glb or .ply");
  }
  return std::nullopt;
}

bool isProgram(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
         access(path.c_str(), X_OK) == 0;
}

/// Possible places of the importer; the first that exists counts. A place that the user names is
/// the only one: no other program must run instead.
std::vector<std::string> importerPlaces(const SceneImportOptions& options) {
  if (!options.importer.empty()) return {options.importer};
  const char* named = std::getenv("FORETOUCH_IMPORTER");
  if (named != nullptr && *named != '\0') return {named};
  std::vector<std::string> places;
  std::error_code unknown;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (!unknown) {
    const auto folder = self.parent_path();
    places.push_back((folder / "foretouch-import").string());
    places.push_back((folder.parent_path() / "libexec/foretouch/foretouch-import").string());
  }
  if (const char* const place = packagedImporter) places.emplace_back(place);
  places.emplace_back(FORETOUCH_INSTALLED_IMPORTER);
  return places;
}

/// The last line that is not empty, in brackets: assertions and loaders explain there why they
/// ended.
std::string lastWords(const std::string& errorOutput) {
  std::string_view rest = errorOutput;
  while (!rest.empty()) {
    const std::size_t start = rest.find_last_of('\n') + 1;  // npos + 1 is 0
    const std::string line = readableText(rest.substr(start), kQuotedBytes);
    if (!line.empty()) return " (its last words: " + line + ")";
    rest = rest.substr(0, start == 0 ? 0 : start - 1);
  }
  return "";
}

Error reportedFailure(const std::string& path, const SceneImportOptions& options,
                      const FrameReader& reader) {
  const std::string& text = reader.failureText();
  switch (reader.failure()) {
    case ImportFailure::UnknownFormat:
      return importError(path, ErrorCode::UnknownName,
                         "expected a known model format, found the extension " + text);
    case ImportFailure::TooLarge:
      return importError(path, ErrorCode::LimitExceeded, "the model is too large: " + text);
    case ImportFailure::OutOfMemory:
      // The importer says which limit: its own grows with the bytes that it has read.
      return importError(
          path, ErrorCode::ImportCrashed,
          "the importer ran out of its memory limit of " +
              (text.empty() ? std::to_string(memoryFor(options)) : text) +
              " bytes: the model is too large for its file's size, or its counts lie");
    case ImportFailure::None:
    case ImportFailure::Refused: break;
  }
  return importError(path, ErrorCode::ImportFailed, "the importer refused the file: " + text);
}

std::string endText(const std::string& importer, const SceneImportOptions& options,
                    const ProcessEnd& end) {
  switch (end.kind) {
    case ProcessEnd::Kind::NotStarted:
      return "cannot run the importer " + importer + ": " + errorText(end.code);
    case ProcessEnd::Kind::Signalled: {
      const char* name = sigabbrev_np(end.code);
      return "the importer crashed on the file with signal " + std::to_string(end.code) +
             (name != nullptr ? std::string(" (SIG") + name + ")" : "");
    }
    case ProcessEnd::Kind::TimedOut:
      return "the importer ran out of its time limit of " + shortest(options.timeLimitS) +
             " seconds";
    case ProcessEnd::Kind::Exited:
      return "the importer ended with status " + std::to_string(end.code) +
             " before its answer was complete";
    case ProcessEnd::Kind::Stopped:
    case ProcessEnd::Kind::Lost: break;
  }
  return "the importer's answer ended before it was complete";
}

Error failureOfRun(const std::string& path, const std::string& importer,
                   const SceneImportOptions& options, const FrameReader& reader,
                   const ProcessEnd& end) {
  if (reader.state() == FrameReader::State::Failed) {
    return reportedFailure(path, options, reader);
  }
  if (reader.state() == FrameReader::State::Broken) {
    return importError(path, reader.greeted() ? ErrorCode::ImportFailed : ErrorCode::Mismatch,
                       "the answer of the importer " + importer +
                           " cannot be used: " + reader.broken() + lastWords(end.errorOutput));
  }
  return importError(
      path,
      end.kind == ProcessEnd::Kind::NotStarted ? ErrorCode::ImportFailed : ErrorCode::ImportCrashed,
      endText(importer, options, end) + lastWords(end.errorOutput));
}

}  // namespace

Result<std::string> findImporter(const std::string& path, const SceneImportOptions& options) {
  std::string tried;
  for (const std::string& place : importerPlaces(options)) {
    if (isProgram(place)) return place;
    tried += (tried.empty() ? "" : ", ") + place;
  }
  return importError(path, ErrorCode::FileNotFound,
                     "expected the program foretouch-import at " + tried +
                         "; the environment variable FORETOUCH_IMPORTER may name it");
}

bool notePackagedImporter(const char* path) {
  packagedImporter = path;
  return true;
}

Error importError(const std::string& path, ErrorCode code, std::string message) {
  return Error::in(path, code, std::move(message));
}

std::optional<Error> runImporter(const std::string& path, const SceneImportOptions& options,
                                 const std::vector<std::string>& arguments,
                                 const std::vector<std::string>& folders, FrameReader& reader) {
  if (auto error = badOption(path, options)) return error;
  if (auto error = badPath(path)) return error;
  FORETOUCH_TRY(const auto importer, findImporter(path, options));
  const ProcessEnd end = runLimited(
      importer, arguments,
      {memoryFor(options), options.timeLimitS, cageFor(importer, path, folders)},
      [&](std::string_view bytes) { return reader.feed(bytes) == FrameReader::State::Reading; });
  if (reader.state() == FrameReader::State::Complete) return std::nullopt;
  return failureOfRun(path, importer, options, reader, end);
}

}  // namespace foretouch::internal
