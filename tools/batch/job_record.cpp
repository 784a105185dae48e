#include "tools/batch/job_record.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "assets/json_writer.h"
#include "assets/text_file.h"
#include "tools/settings/file_mark.h"

namespace foretouch::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kCheck[] = ",\"check\":\"";
constexpr std::size_t kMostRecordBytes = std::size_t{16} << 20;

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

Result<Done> ResultFolder::put(const JobRecord& record, const std::string& scratch) const {
  const std::string target = fileOf(record.name, ".json");
  const std::string before = scratch + "/" + record.name + ".json";
  const auto failed = [&] {
    const int why = errno;
    std::remove(before.c_str());
    return Error::in(target, ErrorCode::FileUnwritable,
                     std::string("writing failed: ") + std::strerror(why));
  };
  // Not flushed to the disk: after a loss of power it is whole or, by its check sum, not there.
  errno = 0;
  std::FILE* const file = std::fopen(before.c_str(), "wb");
  if (file == nullptr) return failed();
  const std::string line = recordLine(record);
  const bool isWritten = std::fwrite(line.data(), 1, line.size(), file) == line.size();
  if (std::fclose(file) != 0 || !isWritten) return failed();
  if (std::rename(before.c_str(), target.c_str()) != 0) return failed();
  return Done{};
}

}  // namespace foretouch::tools
