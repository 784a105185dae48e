#include "assets/model/edge_table.h"

#include <algorithm>
#include <cstdint>

#include "articulated/try.h"
#include "assets/model/joint_table.h"
#include "assets/near_names.h"
#include "assets/text_file.h"

namespace foretouch {
namespace {

/// The column of each coordinate.
Result<std::vector<std::size_t>> columnsOf(const Robot& robot, const internal::JointTable& table) {
  std::vector<std::string> names;
  std::vector<std::size_t> columns;
  for (const RobotCoordinate& coordinate : robot.coordinates()) {
    names.push_back(coordinate.name);
    const auto found = std::find(table.joints.begin(), table.joints.end(), coordinate.name);
    if (found == table.joints.end()) {
      return Error::of(ErrorCode::UnknownName, "expected a column for each joint, found none of " +
                                                   inQuotes(coordinate.name));
    }
    columns.push_back(static_cast<std::size_t>(found - table.joints.begin()));
  }
  for (const std::string& joint : table.joints) {
    if (std::find(names.begin(), names.end(), joint) != names.end()) continue;
    return Error::of(
        ErrorCode::UnknownName,
        inQuotes(joint) + " is no joint with a number of its own" + didYouMean(joint, names));
  }
  return columns;
}

Result<EdgeTable> edgesOf(const Robot& robot, std::string_view csv) {
  FORETOUCH_TRY(const auto table, internal::parseTimedTable(csv, "edge"));
  FORETOUCH_TRY(const auto columns, columnsOf(robot, table));
  EdgeTable edges;
  edges.count = table.rows.size() / 2;
  if (edges.count == 0) return Error::of(ErrorCode::Empty, "expected two rows of each edge");
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto refused = [&](Error error) {
      error.file.clear();  // for a configuration it is "q"
      error.line = table.lines[row];
      return error;
    };
    const std::size_t edge = row / 2;
    if (table.timesS[row] != static_cast<double>(edge) || row + 1 == 2 * edges.count + 1) {
      return refused(
          Error::of(ErrorCode::OutOfRange, "expected the rows of edges 0, 1, 2, ..., two of each"));
    }
    std::vector<double>& to = row % 2 == 0 ? edges.q0 : edges.q1;
    const std::size_t begin = to.size();
    for (const std::size_t column : columns) to.push_back(table.rows[row][column]);
    FORETOUCH_CHECK_OR(refused, robot.checked(to.data() + begin, columns.size()));
  }
  return edges;
}

}  // namespace

Result<EdgeTable> readEdgeTable(const Robot& robot, std::string_view csv, const std::string& name) {
  return inFile(edgesOf(robot, csv), name);
}

}  // namespace foretouch
