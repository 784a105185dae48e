#include "tools/inputs/npz_motion.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/clip/clip_file.h"
#include "assets/model/joint_table.h"
#include "assets/model/model_avatar.h"
#include "assets/text_file.h"
#include "tools/inputs/npz_arrays.h"

namespace foretouch::tools {
namespace {

using internal::JointTable;

constexpr double kMostRateHz = 1e6;

/// The one of these arrays that is there; empty: none. Error if there are several.
Result<std::string> oneOf(const NpzArrays& arrays, std::initializer_list<const char*> names) {
  std::string found;
  for (const char* const name : names) {
    if (!arrays.has(name)) continue;
    if (!found.empty()) {
      return Error::of(ErrorCode::DuplicateName, "has both " + inQuotes(found) + " and " +
                                                     inQuotes(name) + "; expected one of them");
    }
    found = name;
  }
  return found;
}

std::string shapeText(const NpzArray& array) {
  std::string text = "(";
  for (const std::size_t size : array.shape)
    text += (text == "(" ? "" : ", ") + std::to_string(size);
  return text + ")";
}

/// An array of numbers with these many rows and columns; empty: any number.
Result<NpzArray> matrix(const NpzArrays& arrays, const std::string& name,
                        std::optional<std::size_t> rows, std::optional<std::size_t> columns) {
  FORETOUCH_TRY(auto array, arrays.array(name));
  const bool fits = array.texts.empty() && array.shape.size() == 2 &&
                    (!rows || array.shape[0] == *rows) && (!columns || array.shape[1] == *columns);
  if (fits) return array;
  const auto shown = [](std::optional<std::size_t> size, const char* any) {
    return size ? std::to_string(*size) : any;
  };
  return Error::of(ErrorCode::Mismatch, "array " + inQuotes(name) +
                                            ": expected numbers of shape (" + shown(rows, "rows") +
                                            ", " + shown(columns, "joints") + "), found " +
                                            shapeText(array));
}

Result<Done> checkDifferent(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  const auto same = std::adjacent_find(names.begin(), names.end());
  if (same == names.end()) return Done{};
  return Error::of(ErrorCode::DuplicateName, "two columns are called " + inQuotes(*same));
}

/// The names of the joints: the file's, or the options'.
Result<Done> takeNames(const NpzArrays& arrays, const JointTableOptions& options,
                       JointTable& table) {
  FORETOUCH_TRY(const auto name, oneOf(arrays, {"joint_names", "dof_names"}));
  if (!name.empty()) {
    FORETOUCH_TRY(auto names, arrays.array(name));
    if (!options.columns.empty()) {
      return Error::of(ErrorCode::Mismatch,
                       "has an array " + inQuotes(name) + ", so expected no --columns beside it");
    }
    if (names.texts.empty()) {
      return Error::of(ErrorCode::Mismatch, "array " + inQuotes(name) + ": expected texts");
    }
    table.joints = std::move(names.texts);
    return checkDifferent(table.joints);
  }
  const internal::TableLayout* const layout = internal::layoutIn(options);
  const auto& root = internal::rootColumns();
  for (const std::string& column : layout != nullptr ? layout->columns : options.columns) {
    if (std::count(root.begin(), root.end(), column) == 0) table.joints.push_back(column);
  }
  if (!table.joints.empty()) return checkDifferent(table.joints);
  return Error::of(ErrorCode::Empty,
                   "expected an array 'joint_names', or to be told the names (--columns)");
}

/// The order in a rotation's array: by the end of its name, or as the options say.
Result<QuaternionOrder> orderOf(const std::string& name, const JointTableOptions& options) {
  const auto endsWith = [&](const std::string& end) {
    return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
  };
  const bool isXyzw = endsWith("_xyzw"), isSaid = isXyzw || endsWith("_wxyz");
  const QuaternionOrder said = isXyzw ? QuaternionOrder::Xyzw : QuaternionOrder::Wxyz;
  if (isSaid && options.quaternion.value_or(said) == said) return said;
  if (!isSaid && options.quaternion) return *options.quaternion;
  return Error::of(
      ErrorCode::Mismatch,
      "array " + inQuotes(name) + ": " +
          (isSaid ? "its name says another order than --quaternion"
                  : "its name does not end in _xyzw or _wxyz: expected --quaternion to "
                    "say the order of its numbers"));
}

Result<Done> takeRoots(const NpzArrays& arrays, const JointTableOptions& options,
                       JointTable& table) {
  FORETOUCH_TRY(const auto place, oneOf(arrays, {"root_pos", "root_trans", "base_pos"}));
  FORETOUCH_TRY(
      const auto turn,
      oneOf(arrays, {"root_rot", "root_quat", "base_quat", "root_rot_xyzw", "root_rot_wxyz",
                     "root_quat_xyzw", "root_quat_wxyz", "base_quat_xyzw", "base_quat_wxyz"}));
  if (place.empty() && turn.empty()) return Done{};
  if (place.empty() || turn.empty()) {
    return Error::of(ErrorCode::Empty,
                     "expected both where the root is and how it is turned: "
                     "arrays 'root_pos' and 'root_rot'");
  }
  const std::size_t rows = table.rows.size();
  FORETOUCH_TRY(const auto order, orderOf(turn, options));
  FORETOUCH_TRY(const auto places, matrix(arrays, place, rows, 3));
  FORETOUCH_TRY(const auto turns, matrix(arrays, turn, rows, 4));
  for (std::size_t row = 0; row < rows; ++row) {
    const double *p = &places.numbers[3 * row], *q = &turns.numbers[4 * row];
    const std::size_t w = order == QuaternionOrder::Wxyz ? 0 : 3,
                      x = order == QuaternionOrder::Wxyz;
    const std::array<double, 7> numbers{p[0], p[1], p[2], q[x], q[x + 1], q[x + 2], q[w]};
    auto root = internal::rootOf(numbers.data(), table.metresPerUnit);
    if (!root.ok()) {
      Error error = root.error();
      error.line = table.lines[row];
      return error;
    }
    table.roots.push_back(root.value());
  }
  return Done{};
}

Result<Done> takeTimes(const NpzArrays& arrays, const JointTableOptions& options,
                       JointTable& table) {
  FORETOUCH_TRY(const auto rate, oneOf(arrays, {"fps", "time"}));
  if (rate.empty()) {
    std::optional<double> rateHz = options.rateHz;
    const internal::TableLayout* const layout = internal::layoutIn(options);
    if (!rateHz && layout != nullptr) rateHz = layout->rateHz;
    return internal::settleTimes(table, rateHz);
  }
  FORETOUCH_TRY(auto array, arrays.array(rate));
  if (options.rateHz) {
    return Error::of(ErrorCode::Mismatch,
                     "has an array " + inQuotes(rate) + ", so expected no rate beside it");
  }
  const std::size_t expected = rate == "fps" ? 1 : table.rows.size();
  if (array.numbers.size() != expected) {
    return Error::of(ErrorCode::Mismatch, "array " + inQuotes(rate) + ": expected " +
                                              std::to_string(expected) + " numbers, found " +
                                              std::to_string(array.numbers.size()));
  }
  if (rate == "time") {
    table.timesS = std::move(array.numbers);
    return internal::settleTimes(table, {});
  }
  const double hz = array.numbers.front();
  if (hz > 0.0 && hz <= kMostRateHz) return internal::settleTimes(table, hz);
  return Error::of(ErrorCode::OutOfRange,
                   "array 'fps': expected rows per second above 0, found " + inDigits(hz));
}

}  // namespace

Result<JointTable> tableFromNpz(std::string bytes, const JointTableOptions& options) {
  FORETOUCH_TRY(const auto arrays, NpzArrays::of(std::move(bytes)));
  FORETOUCH_TRY(const auto positions, oneOf(arrays, {"joint_pos", "dof_pos"}));
  if (positions.empty()) {
    return Error::of(ErrorCode::Empty, "expected an array 'joint_pos' of shape (rows, joints)");
  }
  JointTable table;
  internal::setUnits(options, table);
  FORETOUCH_CHECK(takeNames(arrays, options, table));
  const std::size_t joints = table.joints.size();
  FORETOUCH_TRY(const auto values, matrix(arrays, positions, {}, joints));
  for (std::size_t row = 0; row < values.shape[0]; ++row) {
    const auto first = values.numbers.begin() + static_cast<std::ptrdiff_t>(row * joints);
    table.rows.emplace_back(first, first + static_cast<std::ptrdiff_t>(joints));
    table.lines.push_back(static_cast<std::int64_t>(row));
  }
  FORETOUCH_CHECK(takeTimes(arrays, options, table));
  FORETOUCH_CHECK(takeRoots(arrays, options, table));
  return table;
}

Result<Clip> clipFromNpz(const Model& robot, const std::string& path,
                         const JointTableOptions& options) {
  const auto placed = [&](Error error) {
    error.file = path;
    if (error.line < 0) return error;
    error.message = "row " + std::to_string(error.line) + ": " + error.message;
    error.line = -1;
    return error;
  };
  FORETOUCH_TRY(auto bytes, readWholeFile(path, kMaxJointTableBytes));
  FORETOUCH_TRY_OR(placed, const auto table, tableFromNpz(std::move(bytes), options));
  FORETOUCH_TRY_OR(placed, auto clip, internal::clipOfTable(robot, table));
  return clip;
}

}  // namespace foretouch::tools
