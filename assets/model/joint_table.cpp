#include "assets/model/joint_table.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_set>
#include <utility>

#include "articulated/skeleton.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/bvh/bvh_text.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// A share of the mean spacing: clocks that print milliseconds at 100 Hz stay below it.
constexpr double kSpacingTolerance = 0.01;

std::string_view trimmed(std::string_view text) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view unquoted(std::string_view cell) {
  cell = trimmed(cell);
  const bool isQuoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
  return isQuoted ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

constexpr std::size_t kMaxCells = countOf(kMaxJoints) + 1;

/// Stops at enough cells to show that there are too many.
std::vector<std::string_view> cellsOf(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(unquoted(line.substr(0, comma)));
    if (comma == std::string_view::npos || cells.size() > kMaxCells) return cells;
    line.remove_prefix(comma + 1);
  }
}

/// Returns the lines with content.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (rest_.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
      rest_.remove_prefix(kByteOrderMark.size());
    }
  }
  std::optional<std::string_view> next() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      const std::string_view line = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (!line.empty() && line.front() != '#') return line;
    }
    return std::nullopt;
  }
  [[nodiscard]] std::int64_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::int64_t number_ = 0;
};

/// `first`: what it begins with; empty: with anything.
std::optional<Error> readHeader(std::string_view line, std::int64_t number,
                                const std::string& first, JointTable& table) {
  const auto names = cellsOf(line);
  if (!first.empty() && !isKeyword(names.front(), first.c_str())) {
    const bool isNumber = readBvhNumber(names.front()).problem == nullptr;
    return bvhError(
        ErrorCode::Syntax, number,
        "expected a header that begins with " + first + ", found " + inQuotes(names.front()) +
            (isNumber ? "; of a table without one, say what its columns are called" : ""));
  }
  if ((!first.empty() && names.size() < 2) || names.size() > kMaxCells) {
    return bvhError(ErrorCode::OutOfRange, number,
                    "expected 1 to " + std::to_string(kMaxJoints) + " joints after " +
                        (first.empty() ? "those of its root" : first));
  }
  std::unordered_set<std::string_view> seen;
  for (const std::string_view name : names) {
    if (!seen.insert(name).second) {
      return bvhError(ErrorCode::DuplicateName, number, "two columns are called " + inQuotes(name));
    }
    table.joints.emplace_back(name);
  }
  return std::nullopt;
}

std::optional<Error> readRow(std::string_view line, std::int64_t number, JointTable& table) {
  const auto cells = cellsOf(line);
  if (cells.size() != table.joints.size()) {
    return bvhError(ErrorCode::Syntax, number,
                    "expected " + std::to_string(table.joints.size()) + " cells, found " +
                        (cells.size() > kMaxCells ? "more" : std::to_string(cells.size())));
  }
  if ((table.rows.size() + 1) * cells.size() > kMaxTableValues) {
    return bvhError(ErrorCode::LimitExceeded, number,
                    "expected at most " + std::to_string(kMaxTableValues) + " values");
  }
  std::vector<double> row;
  for (const std::string_view cell : cells) {
    const BvhNumber value = readBvhNumber(cell);
    if (value.problem != nullptr) {
      return bvhError(value.code, number,
                      "expected a number, found " + inQuotes(cell) + ", which " + value.problem);
    }
    row.push_back(value.value);
  }
  table.rows.push_back(std::move(row));
  table.lines.push_back(number);
  return std::nullopt;
}

/// Sets the frame time, if the rows have one.
std::optional<Error> findSpacing(JointTable& table) {
  const std::vector<double>& times = table.timesS;
  if (times.size() < 2) {
    return bvhError(ErrorCode::Empty, -1,
                    "expected at least 2 rows, found " + std::to_string(times.size()));
  }
  const double spacing = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  if (!(spacing >= kMinFrameTimeS && spacing <= kMaxFrameTimeS)) {
    return bvhError(ErrorCode::OutOfRange, table.lines.back(),
                    "expected rows 1e-6 to 3600 s apart, found " + std::to_string(spacing));
  }
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double step = times[i] - times[i - 1];
    if (std::abs(step - spacing) <= kSpacingTolerance * spacing) continue;
    return bvhError(ErrorCode::OutOfRange, table.lines[i],
                    "expected rows equally spaced, " + std::to_string(spacing) +
                        " s apart to within a hundredth, found " + std::to_string(step));
  }
  table.frameTimeS = spacing;
  return std::nullopt;
}

}  // namespace

Result<JointTable> parseTable(std::string_view csv, const std::vector<std::string>& columns,
                              const std::string& first) {
  Lines lines(csv);
  JointTable table;
  table.joints = columns;
  if (columns.empty()) {
    const auto header = lines.next();
    if (!header) {
      return bvhError(
          ErrorCode::Empty, -1,
          "expected a header: " + (first.empty() ? "" : first + " and ") + "joint names");
    }
    if (auto error = readHeader(*header, lines.number(), first, table)) return *std::move(error);
  }
  while (const auto line = lines.next()) {
    if (auto error = readRow(*line, lines.number(), table)) return *std::move(error);
  }
  return table;
}

Result<JointTable> parseTimedTable(std::string_view csv, const char* first) {
  FORETOUCH_TRY(auto table, parseTable(csv, {}, first));
  table.joints.erase(table.joints.begin());
  for (std::vector<double>& row : table.rows) {
    table.timesS.push_back(row.front());
    row.erase(row.begin());
  }
  return table;
}

Result<Done> settleTimes(JointTable& table, std::optional<double> rateHz) {
  const bool hasTimes = !table.timesS.empty();
  if (rateHz && hasTimes) {
    return Error::of(ErrorCode::Mismatch,
                     "has the times of its rows, so expected no rate beside them");
  }
  if (!rateHz && !hasTimes && !table.rows.empty()) {
    return Error::of(ErrorCode::Empty,
                     "expected a column time, or to be told how many rows a second there are");
  }
  for (std::size_t row = 0; rateHz && row < table.rows.size(); ++row) {
    table.timesS.push_back(static_cast<double>(row) / *rateHz);
  }
  if (auto error = findSpacing(table)) return *std::move(error);
  return Done{};
}

}  // namespace foretouch::internal
