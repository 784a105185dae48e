#include "tools/batch/job_record.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "articulated/try.h"
#include "assets/json_writer.h"
#include "assets/text_file.h"
#include "tools/settings/file_mark.h"

namespace foretouch::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr char kCheck[] = ",\"check\":\"";
constexpr std::size_t kMostRecordBytes = std::size_t{16} << 20;

/// One worker's turn in a folder, until it is destroyed; it does not wait if there are no locks.
class Turn {
 public:
  explicit Turn(const fs::path& folder)
      : lock_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    while (lock_ >= 0 && ::flock(lock_, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
  ~Turn() {
    if (lock_ >= 0) ::close(lock_);
  }

 private:
  int lock_;
};

Error unwritten(const std::string& path) {
  return Error::in(path, ErrorCode::FileUnwritable,
                   std::string("writing failed: ") + std::strerror(errno));
}

std::string textIn(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

std::optional<std::string> lastingSummary(std::string_view line) {
  Json summary = Json::parse(line, nullptr, false);
  if (!summary.is_object()) return std::nullopt;
  for (const char* const key : {"motion", "scene", "latency_us", "threads", "output", "report"}) {
    summary.erase(key);
  }
  return summary.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string recordLine(const JobRecord& record) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("format", "foretouch-batch-result");
  out.field("version", 2);
  out.field("job", record.name);
  out.field("state", record.isDone ? "done" : "failed");
  if (record.isDone) {
    out.field("results", record.mark);
    out.rawField("summary", record.summary);
  } else {
    out.field("error", record.error);
  }
  const std::string check = markOfText(text);
  return text + kCheck + check + "\"}\n";
}

std::optional<JobRecord> parseRecord(std::string_view line, const std::string& name) {
  const std::size_t check = line.rfind(kCheck);
  if (check == std::string_view::npos) return std::nullopt;
  const std::string_view said = line.substr(check + sizeof kCheck - 1);
  if (said != markOfText(line.substr(0, check)) + "\"}\n") return std::nullopt;
  const Json read = Json::parse(line, nullptr, false);
  if (!read.is_object() || textIn(read, "job") != name) return std::nullopt;
  JobRecord record;
  record.name = name;
  record.isDone = textIn(read, "state") == "done";
  record.error = textIn(read, "error");
  if (!record.isDone) return record;
  const auto summary = read.find("summary");
  record.mark = textIn(read, "results");
  if (summary == read.end() || !summary->is_object()) return std::nullopt;
  record.summary = summary->dump();
  return record;
}

std::string ResultFolder::placeOf(const std::string& name, const char* ending) {
  return name.substr(0, 2) + "/" + name + ending;
}

std::optional<JobRecord> ResultFolder::find(const std::string& name) const {
  const auto line = readWholeFile(fileOf(name, ".json"), kMostRecordBytes);
  if (!line.ok()) return std::nullopt;
  auto record = parseRecord(line.value(), name);
  if (!record || !record->isDone) return record;
  const auto mark = markOfFile(fileOf(name, ending_));
  if (!mark.ok() || mark.value() != record->mark) return std::nullopt;
  return record;
}

Result<bool> ResultFolder::put(const JobRecord& record, const std::string& scratch,
                               const std::vector<const char*>& endings) const {
  const Turn turn(fs::path(fileOf(record.name, "")).parent_path());
  const auto there = find(record.name);
  if (there && there->isDone) return false;
  const auto move = [&](const char* ending) -> Result<Done> {
    errno = 0;
    if (std::rename((scratch + "/" + record.name + ending).c_str(),
                    fileOf(record.name, ending).c_str()) == 0) {
      return Done{};
    }
    return unwritten(fileOf(record.name, ending));
  };
  for (const char* const ending : endings) FORETOUCH_CHECK(move(ending));
  // Not flushed to the disk: after a loss of power it is whole or, by its check sum, not there.
  const std::string written = scratch + "/" + record.name + ".json";
  errno = 0;
  std::FILE* const file = std::fopen(written.c_str(), "wb");
  if (file == nullptr) return unwritten(fileOf(record.name, ".json"));
  const std::string line = recordLine(record);
  const bool isWritten = std::fwrite(line.data(), 1, line.size(), file) == line.size();
  if (std::fclose(file) != 0 || !isWritten) return unwritten(fileOf(record.name, ".json"));
  FORETOUCH_CHECK(move(".json"));
  return true;
}

}  // namespace foretouch::tools
