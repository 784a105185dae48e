// assets/model/edge_table.h: edges of a robot from CSV text: two rows each (docs/formats.md). Not
// installed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"
#include "articulated/robot.h"

namespace foretouch {

/// Configurations one after the other, in the order of Robot::coordinates().
struct EdgeTable {
  std::vector<double> q0, q1;
  std::size_t count = 0;  ///< The number of edges.
};

/// A header `edge` and the name of every coordinate, in any order; then for each edge, counted from
/// 0, the row where it begins and the one where it ends, both with its number. Errors name `name`
/// as the file, and the line. Safe on hostile text.
[[nodiscard]] Result<EdgeTable> readEdgeTable(const Robot& robot, std::string_view csv,
                                              const std::string& name);

}  // namespace foretouch
