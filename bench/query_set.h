// bench/query_set.h: labelled leaf queries from CSV files, in the format of the query sets
// published with [Wang21]: 8 rows per query (4 points at t = 0, then at t = 1), 7 integers per row
// (x, y and z as numerator and denominator, then 0 or 1: do they meet). Folders named vertex-face
// and edge-edge give the kind; the folder around them names the set.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "articulated/result.h"
#include "tests/reference/linear_query.h"

namespace foretouch::tools {

enum class QueryKind { VertexFace, EdgeEdge };
[[nodiscard]] const char* toString(QueryKind kind);

/// Vertex and face, or edge and edge, in this order.
struct LabelledQuery {
  std::array<LinearPoint, 4> points;
  bool hits = false;
};
[[nodiscard]] LeafAnswer answer(QueryKind kind, const LabelledQuery& query);

struct QuerySet {
  std::string name;
  QueryKind kind = QueryKind::VertexFace;
  std::vector<LabelledQuery> queries;
};

/// Limits on files and folders, above the needs of any known set.
inline constexpr std::size_t kMaxQueryFileBytes = std::size_t{1} << 28;
inline constexpr std::size_t kMaxQueryFiles = 10'000;
inline constexpr int kMaxQueryDepth = 4;

/// Every coordinate must be exactly a double within the limits of linear_query.h. Errors name file
/// and line.
[[nodiscard]] Result<std::vector<LabelledQuery>> parseQueries(std::string_view text,
                                                              const std::string& file);

/// All sets under the folders, in order of name, with the files of one set and kind joined. Errors:
/// a folder that is missing or has no queries, or a bad file.
[[nodiscard]] Result<std::vector<QuerySet>> readQuerySets(const std::vector<std::string>& folders);

}  // namespace foretouch::tools
