// bench/report.h: the result of every benchmark: tables with the machine of the measurement, for
// the terminal, as JSON and as CSV. A benchmark fills a BenchReport and chooses its own tables and
// columns.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

/// A count, a measured number, or words.
using BenchCell = std::variant<std::int64_t, double, std::string>;

struct BenchColumn {
  std::string key;    ///< For the JSON and the CSV: lower_case, with its unit ("p50_us").
  std::string title;  ///< In tables for people.
  int decimals = 2;   ///< For measured numbers in tables for people; -1: six digits in all. Files
                      ///< keep all digits.
};

struct BenchTable {
  std::string name;   ///< For the JSON: lower_case.
  std::string title;  ///< One line for people.
  std::vector<BenchColumn> columns;
  std::vector<std::vector<BenchCell>> rows;  ///< As many cells as columns (asserted).
};

/// Name and value of something that a measurement depends on.
using BenchFact = std::pair<std::string, std::string>;

struct BenchReport {
  std::string kind;     ///< "latency", "scaling", ...
  std::string title;    ///< One line for people.
  std::string command;  ///< As typed in.
  std::string date;     ///< UTC, "2026-01-31 12:00".
  std::vector<BenchFact> machine, workload;
  std::vector<BenchTable> tables;
  std::vector<std::string> notes;  ///< Notes for readers of the tables; sentences.
};

/// A table of a benchmark that judges: violations are false answers, or broken promises.
struct JudgedTable {
  BenchTable table;
  std::uint64_t violations = 0;
};
struct JudgedReport {
  BenchReport report;
  std::uint64_t violations = 0;

  void add(JudgedTable judged) {
    report.tables.push_back(std::move(judged.table));
    violations += judged.violations;
  }
};

/// Aligned columns under their titles.
[[nodiscard]] std::string tableText(const BenchTable& table);
/// Facts, tables and notes, for a terminal.
[[nodiscard]] std::string reportText(const BenchReport& report);
/// A line of keys, then one line per row; quotes words if needed.
[[nodiscard]] std::string tableCsv(const BenchTable& table);

/// One object, format "foretouch-bench" version 1; numbers that are not finite become null.
[[nodiscard]] std::string reportJson(const BenchReport& report);
/// The inverse; errors name `name` as the file. Null becomes NaN.
[[nodiscard]] Result<BenchReport> parseReport(const std::string& json, const std::string& name);

/// A section of Markdown, headed by the title.
[[nodiscard]] std::string reportMarkdown(const BenchReport& report);

/// Where figures are also written to; an empty path writes nothing.
struct FigureFiles {
  std::string json, csv;
};
/// The report as JSON and the raw rows as CSV. Errors name the file.
[[nodiscard]] Result<Done> writeReport(const BenchReport& report, const BenchTable& raw,
                                       const FigureFiles& files);
/// Writes it whole or not at all; an empty path writes nothing. Errors name the file.
[[nodiscard]] Result<Done> writeText(const std::string& path, const std::string& text);

}  // namespace foretouch::tools
