#include "tools/batch/batch_table.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "assets/json_writer.h"
#include "tools/batch/job_name.h"
#include "tools/csv_cell.h"

namespace foretouch::tools {
namespace {

using Json = nlohmann::ordered_json;
using Values = std::vector<std::pair<std::string, std::string>>;

/// Lists have no place in a table; the lines of JSON have them.
void addValues(const Json& object, const std::string& lead, Values& values) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object()) {
      addValues(value, lead + key + ".", values);
    } else if (value.is_string()) {
      values.emplace_back(lead + key, value.get<std::string>());
    } else if (!value.is_array()) {
      values.emplace_back(lead + key, value.dump());
    }
  }
}

std::string joinedTexts(const JobOption& option) {
  std::string all;
  for (const std::string& text : option.texts) all += (all.empty() ? "" : " ") + text;
  return option.texts.empty() ? "true" : all;
}

/// The names of all options or values, in the order in which rows first have them.
class ColumnNames {
 public:
  void add(const std::string& name) {
    if (known_.insert(name).second) names_.push_back(name);
  }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  std::set<std::string> known_;
  std::vector<std::string> names_;
};

std::string optionName(const JobOption& option) {
  return option.name.substr(2);
}

}  // namespace

const char* BatchRow::state() const {
  if (!record) return "absent";
  return record->isDone ? "done" : "failed";
}

std::string_view BatchRow::value(std::string_view wanted) const {
  for (const auto& [known, text] : values) {
    if (known == wanted) return text;
  }
  return "";
}

double BatchRow::numberOf(std::string_view wanted) const {
  const std::string_view text = value(wanted);
  double found = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), found);
  return found;
}

BatchTable gatherBatch(const BatchManifest& manifest, const std::string& version,
                       const ResultFolder& folder) {
  BatchTable table;
  FileMarks marks(manifest.folder);
  std::error_code absent;
  for (const BatchJob& job : manifest.jobs) {
    BatchRow row;
    row.number = table.rows.size() + 1;
    row.job = &job;
    row.name = jobName(job, version, marks);
    row.record = folder.find(row.name);
    if (row.record && row.record->isDone) {
      addValues(Json::parse(row.record->summary, nullptr, false), "", row.values);
      row.hasReport = std::filesystem::is_regular_file(folder.fileOf(row.name, ".html"), absent);
    }
    ++(row.record ? (row.record->isDone ? table.done : table.failed) : table.absent);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string csvOf(const BatchTable& table) {
  ColumnNames options, values;
  for (const BatchRow& row : table.rows) {
    for (const auto& option : row.job->options) options.add(option->name);
    for (const auto& [name, unused] : row.values) values.add(name);
  }
  std::string text = "job,name,state,error";
  for (const std::string& name : options.names()) text += "," + csvCell(name.substr(2));
  for (const std::string& name : values.names()) text += "," + csvCell(name);
  text += '\n';
  for (const BatchRow& row : table.rows) {
    const bool hasFailed = row.record && !row.record->isDone;
    text += std::to_string(row.number) + "," + row.name + "," + row.state() + "," +
            csvCell(hasFailed ? row.record->error : "");
    for (const std::string& name : options.names()) {
      const JobOption* const option = row.job->find(name);
      text += "," + csvCell(option == nullptr ? "" : joinedTexts(*option));
    }
    const std::map<std::string, std::string> byName(row.values.begin(), row.values.end());
    for (const std::string& name : values.names()) {
      const auto found = byName.find(name);
      text += "," + csvCell(found == byName.end() ? "" : found->second);
    }
    text += '\n';
  }
  return text;
}

std::string jsonLinesOf(const BatchTable& table) {
  std::string text;
  for (const BatchRow& row : table.rows) {
    JsonWriter out(text);
    out.beginObject();
    out.field("job", row.number);
    out.field("name", row.name);
    out.field("state", row.state());
    if (row.record && !row.record->isDone) out.field("error", row.record->error);
    out.key("options");
    out.beginObject();
    for (const auto& option : row.job->options) {
      option->texts.size() > 1 ? out.field(optionName(*option), option->texts)
                               : out.field(optionName(*option), joinedTexts(*option));
    }
    out.endObject();
    if (row.record && row.record->isDone) out.rawField("summary", row.record->summary);
    out.endObject();
    text += '\n';
  }
  return text;
}

}  // namespace foretouch::tools
