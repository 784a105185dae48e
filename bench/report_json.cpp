// The JSON form of benchmark reports.
#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "bench/report.h"

namespace foretouch::tools {
namespace {

using Json = nlohmann::ordered_json;
constexpr char kFormat[] = "foretouch-bench";
constexpr int kVersion = 1;
constexpr int kMostDecimals = 17;

Json toJson(const BenchCell& cell) {
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return *count;
  if (const auto* number = std::get_if<double>(&cell)) {
    return std::isfinite(*number) ? Json(*number) : Json(nullptr);
  }
  return std::get<std::string>(cell);
}

Json toJson(const std::vector<BenchFact>& facts) {
  Json json = Json::object();
  for (const auto& [name, value] : facts) json[name] = value;
  return json;
}

Json toJson(const BenchTable& table) {
  Json json = {{"name", table.name},
               {"title", table.title},
               {"columns", Json::array()},
               {"rows", Json::array()}};
  for (const BenchColumn& c : table.columns) {
    json["columns"].push_back({{"key", c.key}, {"title", c.title}, {"decimals", c.decimals}});
  }
  for (const auto& row : table.rows) {
    Json line = Json::object();
    for (std::size_t c = 0; c < row.size(); ++c) line[table.columns[c].key] = toJson(row[c]);
    json["rows"].push_back(std::move(line));
  }
  return json;
}

/// Indented, but a column or a row of a table is one line: users who compare files compare rows.
void append(const Json& json, std::size_t depth, std::string& text) {
  constexpr std::size_t kRow = 4;  // depth of the rows of a table of the tables of a report
  if (!json.is_structured() || json.empty() || depth == kRow) {
    text += json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  text += json.is_object() ? '{' : '[';
  for (auto entry = json.begin(); entry != json.end(); ++entry) {
    text += (entry == json.begin() ? "\n" : ",\n") + std::string(depth + 1, ' ');
    if (json.is_object()) text += Json(entry.key()).dump() + ": ";
    append(*entry, depth + 1, text);
  }
  text += '\n' + std::string(depth, ' ') + (json.is_object() ? '}' : ']');
}

BenchCell cellFrom(const Json& json) {
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (json.is_number()) return json.get<double>();
  return json.get<std::string>();
}

std::vector<BenchFact> factsFrom(const Json& json) {
  std::vector<BenchFact> facts;
  for (const auto& [name, value] : json.items()) facts.emplace_back(name, value.get<std::string>());
  return facts;
}

BenchTable tableFrom(const Json& json) {
  BenchTable table;
  table.name = json.at("name").get<std::string>();
  table.title = json.at("title").get<std::string>();
  for (const Json& c : json.at("columns")) {
    const int decimals = std::clamp(c.at("decimals").get<int>(), -1, kMostDecimals);
    table.columns.push_back(
        {c.at("key").get<std::string>(), c.at("title").get<std::string>(), decimals});
  }
  for (const Json& line : json.at("rows")) {
    table.rows.emplace_back();
    for (const BenchColumn& column : table.columns) {
      table.rows.back().push_back(cellFrom(line.at(column.key)));
    }
  }
  return table;
}

}  // namespace

std::string reportJson(const BenchReport& report) {
  Json json = {{"format", kFormat},
               {"version", kVersion},
               {"kind", report.kind},
               {"title", report.title},
               {"command", report.command},
               {"date", report.date},
               {"machine", toJson(report.machine)},
               {"workload", toJson(report.workload)},
               {"tables", Json::array()},
               {"notes", report.notes}};
  for (const BenchTable& table : report.tables) json["tables"].push_back(toJson(table));
  std::string text;
  append(json, 0, text);
  return text + "\n";
}

Result<BenchReport> parseReport(const std::string& text, const std::string& name) {
  try {
    const Json json = Json::parse(text);
    if (json.at("format") != kFormat || json.at("version") != kVersion) {
      return Error::in(name, ErrorCode::Mismatch, "expected format 'foretouch-bench' version 1");
    }
    BenchReport report;
    report.kind = json.at("kind").get<std::string>();
    report.title = json.at("title").get<std::string>();
    report.command = json.at("command").get<std::string>();
    report.date = json.at("date").get<std::string>();
    report.machine = factsFrom(json.at("machine"));
    report.workload = factsFrom(json.at("workload"));
    for (const Json& table : json.at("tables")) report.tables.push_back(tableFrom(table));
    report.notes = json.at("notes").get<std::vector<std::string>>();
    return report;
  } catch (const nlohmann::json::exception& e) {
    return Error::in(name, ErrorCode::Syntax,
                     std::string("expected a benchmark's JSON: ") + e.what());
  }
}

}  // namespace foretouch::tools
