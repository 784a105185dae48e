#include "bench/report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "lss/assert.h"
#include "tools/console.h"

namespace foretouch::tools {
namespace {

std::string forPeople(const BenchCell& cell, int decimals) {
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *count);
  if (const auto* number = std::get_if<double>(&cell)) {
    if (!std::isfinite(*number)) return "-";
    return decimals < 0 ? fmt::format("{:g}", *number) : fmt::format("{:.{}f}", *number, decimals);
  }
  return std::get<std::string>(cell);
}

std::string quoted(const std::string& words) {
  if (words.find_first_of(",\"\n\r") == std::string::npos) return words;
  std::string text = "\"";
  for (const char c : words) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

std::string forFiles(const BenchCell& cell) {
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *count);
  if (const auto* number = std::get_if<double>(&cell)) {
    return std::isfinite(*number) ? fmt::format("{}", *number) : "";
  }
  return quoted(std::get<std::string>(cell));
}

/// A line break or a bar would end the cell of a Markdown table.
std::string inMarkdown(std::string text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|') safe += '\\';
    safe += c == '\n' || c == '\r' ? ' ' : c;
  }
  return safe;
}

std::string markdownTable(const BenchTable& table) {
  std::string text = "**" + inMarkdown(table.title) + "**\n\n|", line = "|";
  for (const BenchColumn& column : table.columns) {
    text += " " + inMarkdown(column.title) + " |";
    line += "---|";
  }
  text += "\n" + line + "\n";
  for (const auto& row : table.rows) {
    FORETOUCH_ASSERT(row.size() == table.columns.size());
    text += "|";
    for (std::size_t c = 0; c < row.size(); ++c) {
      text += " " + inMarkdown(forPeople(row[c], table.columns[c].decimals)) + " |";
    }
    text += "\n";
  }
  return text + "\n";
}

std::string factsText(const std::vector<BenchFact>& facts) {
  std::string text;
  for (const auto& [name, value] : facts) text += fmt::format("  {:<14} {}\n", name, value);
  return text;
}

}  // namespace

std::string tableText(const BenchTable& table) {
  std::vector<std::vector<std::string>> lines(1);
  std::vector<std::size_t> widths;
  for (const BenchColumn& column : table.columns) {
    lines[0].push_back(column.title);
    widths.push_back(column.title.size());
  }
  for (const auto& row : table.rows) {
    FORETOUCH_ASSERT(row.size() == table.columns.size());
    lines.emplace_back();
    for (std::size_t c = 0; c < row.size(); ++c) {
      lines.back().push_back(forPeople(row[c], table.columns[c].decimals));
      widths[c] = std::max(widths[c], lines.back().back().size());
    }
  }
  std::string text = table.title + "\n";
  for (const auto& line : lines) {
    for (std::size_t c = 0; c < line.size(); ++c) {
      const bool isWords =
          !table.rows.empty() && std::holds_alternative<std::string>(table.rows.front()[c]);
      text += isWords ? fmt::format("  {:<{}}", line[c], widths[c])
                      : fmt::format("  {:>{}}", line[c], widths[c]);
    }
    text += "\n";
  }
  return text;
}

std::string reportText(const BenchReport& report) {
  std::string text = report.title + "\n" + factsText(report.machine) + factsText(report.workload);
  for (const BenchTable& table : report.tables) text += "\n" + tableText(table);
  if (!report.notes.empty()) text += "\n";
  for (const std::string& note : report.notes) text += "  " + note + "\n";
  return text;
}

std::string tableCsv(const BenchTable& table) {
  std::string text;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    text += (c == 0 ? "" : ",") + quoted(table.columns[c].key);
  }
  text += "\n";
  for (const auto& row : table.rows) {
    FORETOUCH_ASSERT(row.size() == table.columns.size());
    for (std::size_t c = 0; c < row.size(); ++c) text += (c == 0 ? "" : ",") + forFiles(row[c]);
    text += "\n";
  }
  return text;
}

std::string reportMarkdown(const BenchReport& report) {
  std::string text =
      "## " + report.title + "\n\n`" + report.command + "`, " + report.date + " UTC.\n\n";
  for (const auto& facts : {report.machine, report.workload}) {
    for (const auto& [name, value] : facts) {
      text += "- " + inMarkdown(name) + ": " + inMarkdown(value) + "\n";
    }
  }
  text += "\n";
  for (const BenchTable& table : report.tables) text += markdownTable(table);
  for (const std::string& note : report.notes) text += inMarkdown(note) + "\n";
  if (!report.notes.empty()) text += "\n";
  return text;
}

Result<Done> writeText(const std::string& path, const std::string& text) {
  if (path.empty()) return Done{};
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(text);
  return inFile(file.commit(), path);
}

Result<Done> writeReport(const BenchReport& report, const BenchTable& raw,
                         const FigureFiles& files) {
  FORETOUCH_CHECK(writeText(files.json, reportJson(report)));
  return writeText(files.csv, files.csv.empty() ? std::string() : tableCsv(raw));
}

}  // namespace foretouch::tools
