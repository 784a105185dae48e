#include "bench/query_set.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"

namespace foretouch::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRows = 8, kColumns = 7;
constexpr std::size_t kMaxDigits = 330;  // in any integer that is a double
constexpr double kLargest = 1e100, kSmallest = 1e-100;

/// The integer as a double, if it is one exactly.
std::optional<double> exactInteger(std::string_view word) {
  const bool negative = !word.empty() && word.front() == '-';
  std::string_view digits = word.substr(negative ? 1 : 0);
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  if (digits.empty() || digits.size() > kMaxDigits) return std::nullopt;
  if (!std::all_of(digits.begin(), digits.end(), isDigit)) return std::nullopt;
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size() - 1));
  const double value = std::strtod(std::string(digits).c_str(), nullptr);
  if (!std::isfinite(value)) return std::nullopt;
  // Short ones are exact; for longer ones the decimal expansion of the double must be the text.
  if (digits.size() > 15 && fmt::format("{:.0f}", value) != digits) return std::nullopt;
  return negative ? -value : value;
}

bool isPowerOfTwo(double value) {
  int exponent = 0;
  return value > 0 && std::frexp(value, &exponent) == 0.5;
}

/// numerator/denominator, both exact doubles and the denominator a power of two, so that dividing
/// does not round.
std::optional<double> coordinate(std::string_view numerator, std::string_view denominator) {
  const auto n = exactInteger(numerator), d = exactInteger(denominator);
  if (!n || !d || !isPowerOfTwo(*d)) return std::nullopt;
  const double value = *n / *d;
  const double magnitude = std::abs(value);
  if (value != 0 && !(magnitude >= kSmallest && magnitude <= kLargest)) return std::nullopt;
  return value == 0 ? 0.0 : value;
}

struct Row {
  Eigen::Vector3d point;
  bool hits = false;
};

std::string_view withoutSpaces(std::string_view word) {
  const std::size_t first = word.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return word.substr(first, word.find_last_not_of(" \t\r") - first + 1);
}

/// The row, or its fault.
Result<Row> parseRow(std::string_view line) {
  std::array<std::string_view, kColumns> words;
  std::size_t count = 0;
  for (std::string_view rest = line;; ++count) {
    const std::size_t comma = rest.find(',');
    if (count < kColumns) words[count] = withoutSpaces(rest.substr(0, comma));
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  Error error;
  if (++count != kColumns) {
    error.message = fmt::format("expected {} columns, found {}", kColumns, count);
    return error;
  }
  Row row;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = coordinate(words[2 * axis], words[2 * axis + 1]);
    if (!value) {
      error.code = ErrorCode::OutOfRange;
      error.message = fmt::format(
          "expected a numerator and a power of two whose quotient is a double, zero or from 1e-100 "
          "to 1e100, found {} and {}",
          inQuotes(words[2 * axis]), inQuotes(words[2 * axis + 1]));
      return error;
    }
    row.point[static_cast<Eigen::Index>(axis)] = *value;
  }
  if (words[6] != "0" && words[6] != "1") {
    error.message = "expected 0 or 1 in the last column, found " + inQuotes(words[6]);
    return error;
  }
  row.hits = words[6] == "1";
  return row;
}

/// Puts the row in its place; false if its label differs from that of the query's other rows.
bool add(const Row& row, std::size_t place, LabelledQuery& query) {
  LinearPoint& point = query.points[place % 4];
  (place < 4 ? point.from : point.to) = row.point;
  if (place == 0) query.hits = row.hits;
  return query.hits == row.hits;
}

std::optional<QueryKind> kindOf(const std::string& folder) {
  if (folder == toString(QueryKind::VertexFace)) return QueryKind::VertexFace;
  if (folder == toString(QueryKind::EdgeEdge)) return QueryKind::EdgeEdge;
  return std::nullopt;
}

struct Source {
  std::string set;
  QueryKind kind;
  std::string path;
};

/// The CSV files under `folder` whose folder's name is a kind.
Result<std::vector<Source>> sourcesUnder(const std::string& folder) {
  std::error_code failure;
  const fs::path root = fs::canonical(folder, failure);
  if (failure) return Error::in(folder, ErrorCode::FileNotFound, "no such folder");
  fs::recursive_directory_iterator entries(root, failure), end;
  if (failure) return Error::in(folder, ErrorCode::FileUnreadable, "cannot be read as a folder");
  std::vector<Source> sources;
  for (; entries != end; entries.increment(failure)) {
    if (failure) break;
    if (entries.depth() >= kMaxQueryDepth) entries.disable_recursion_pending();
    const fs::path path = entries->path();
    const auto kind = kindOf(path.parent_path().filename().string());
    if (!kind || path.extension() != ".csv") continue;
    if (sources.size() >= kMaxQueryFiles) {
      return Error::in(folder, ErrorCode::LimitExceeded,
                       fmt::format("more than {} query files", kMaxQueryFiles));
    }
    sources.push_back({path.parent_path().parent_path().filename().string(), *kind, path.string()});
  }
  if (failure) return Error::in(folder, ErrorCode::FileUnreadable, failure.message());
  if (sources.empty()) {
    return Error::in(folder, ErrorCode::Empty,
                     "expected CSV files in folders named vertex-face or edge-edge, found none");
  }
  return sources;
}

}  // namespace

const char* toString(QueryKind kind) {
  return kind == QueryKind::VertexFace ? "vertex-face" : "edge-edge";
}

LeafAnswer answer(QueryKind kind, const LabelledQuery& query) {
  const auto& p = query.points;
  if (kind == QueryKind::VertexFace) return vertexFace(p[0], {p[1], p[2], p[3]});
  return edgeEdge({p[0], p[1]}, {p[2], p[3]});
}

Result<std::vector<LabelledQuery>> parseQueries(std::string_view text, const std::string& file) {
  std::vector<LabelledQuery> queries;
  LabelledQuery query;
  std::size_t rows = 0;
  Error error;
  error.file = file;
  error.line = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++error.line;
    if (withoutSpaces(line).empty()) continue;
    const auto row = parseRow(line);
    if (!row.ok()) {
      error.code = row.error().code;
      error.message = row.error().message;
      return error;
    }
    if (!add(row.value(), rows++ % kRows, query)) {
      error.message = "expected the same last column in all 8 rows of a query";
      return error;
    }
    if (rows % kRows == 0) queries.push_back(query);
  }
  if (rows % kRows == 0) return queries;
  error.message = fmt::format("expected 8 rows per query, found {} at the end", rows % kRows);
  return error;
}

Result<std::vector<QuerySet>> readQuerySets(const std::vector<std::string>& folders) {
  std::vector<Source> all;
  for (const std::string& folder : folders) {
    FORETOUCH_TRY(auto sources, sourcesUnder(folder));
    all.insert(all.end(), sources.begin(), sources.end());
  }
  std::sort(all.begin(), all.end(),
            [](const Source& a, const Source& b) { return a.path < b.path; });
  std::map<std::pair<std::string, QueryKind>, QuerySet> sets;
  for (const Source& source : all) {
    FORETOUCH_TRY(const auto text, readWholeFile(source.path, kMaxQueryFileBytes));
    FORETOUCH_TRY(auto queries, parseQueries(text, source.path));
    QuerySet& set = sets[{source.set, source.kind}];
    set.name = source.set;
    set.kind = source.kind;
    set.queries.insert(set.queries.end(), queries.begin(), queries.end());
  }
  std::vector<QuerySet> result;
  for (auto& [key, set] : sets) result.push_back(std::move(set));
  return result;
}

}  // namespace foretouch::tools
