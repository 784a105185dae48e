// tools/batch/batch_table.h: the results of all jobs in one table, in the manifest's order. Pure:
// the same results give the same bytes, in whatever order and whichever worker made them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/batch/job_record.h"
#include "tools/batch/manifest.h"

namespace foretouch::tools {

struct BatchRow {
  std::size_t number = 0;  ///< From 1, in the manifest's order.
  const BatchJob* job = nullptr;
  std::string name;
  std::optional<JobRecord> record;  ///< Nothing: the job is not done yet.
  bool hasReport = false;
  /// The summary's numbers and words by name; "rigid.late" is a value inside an object.
  std::vector<std::pair<std::string, std::string>> values;

  [[nodiscard]] const char* state() const;
  /// The value as text; empty if there is none.
  [[nodiscard]] std::string_view value(std::string_view name) const;
  /// The same as a number; 0 if there is none.
  [[nodiscard]] double numberOf(std::string_view name) const;
};

struct BatchTable {
  std::vector<BatchRow> rows;
  std::size_t done = 0, failed = 0, absent = 0;
};

/// Reads the records of all jobs. `version`: that of the program whose results they are.
[[nodiscard]] BatchTable gatherBatch(const BatchManifest& manifest, const std::string& version,
                                     const ResultFolder& folder);

/// The table as RFC 4180 has it, with a first line of names.
[[nodiscard]] std::string csvOf(const BatchTable& table);
/// The table as a line of JSON per job.
[[nodiscard]] std::string jsonLinesOf(const BatchTable& table);

}  // namespace foretouch::tools
