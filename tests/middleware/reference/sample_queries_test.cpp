// The public sets of leaf queries with rational truth ([Wang21]): every one is answered rightly.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/middleware/reference/leaf_samples.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

using Real = oracle::Precise;

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

struct Query {
  FourPoints points;
  bool truth = false;
};

/// Eight rows a query: four points at t = 0, then at t = 1; numerators, denominators, the truth.
std::vector<Query> readQueries(const std::filesystem::path& path) {
  std::vector<Query> queries;
  std::ifstream file(path);
  int row = 0;
  for (std::string line; std::getline(file, line); ++row) {
    const auto cells = cellsOf(line);
    if (row % 8 == 0) queries.emplace_back();
    LinearPoint& point = queries.back().points[row % 4];
    for (int axis = 0; axis < 3; ++axis) {
      const Real exact = Real(cells.at(2 * axis)) / Real(cells.at(2 * axis + 1));
      const auto value = static_cast<double>(exact);
      EXPECT_EQ(Real(value), exact) << path << ": row " << row;
      (row % 8 < 4 ? point.from : point.to)[axis] = value;
    }
    queries.back().truth = cells.at(6)[0] == '1';
  }
  return queries;
}

void expectSound(const LeafAnswer& answer) {
  if (!answer.hits) return;
  EXPECT_LE(0.0, answer.toiLow);
  EXPECT_LE(answer.toiLow, answer.toiHigh);
  EXPECT_LE(answer.toiHigh, 1.0);
  EXPECT_LE(answer.toiHigh - answer.toiLow, kLeafTimeAccuracy);
}

TEST(SampleQueries, AreAllAnsweredRightly) {
  FORETOUCH_REQUIRE_SHARED(folder, "ccd-queries/sample-queries");
  int queries = 0, positives = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder)) {
    if (entry.path().extension() != ".csv") continue;
    const bool faces = entry.path().parent_path().filename() == "vertex-face";
    int index = 0;
    for (const Query& query : readQueries(entry.path())) {
      const LeafAnswer answer = faces ? askVertexFace(query.points) : askEdgeEdge(query.points);
      EXPECT_EQ(answer.hits, query.truth) << entry.path() << ": query " << index;
      expectSound(answer);
      positives += query.truth;
      ++queries;
      ++index;
    }
  }
  EXPECT_GE(queries, 4279);
  EXPECT_GE(positives, 279);
}

// The layout of these rows is not documented. Read as four points at t = 0, then at t = 1 (the only
// reading in which the vertex or the face stands still in every row) the four points are never
// coplanar: in rationals the Bernstein coefficients of their volume have one sign in all ten rows.
// So, despite the file's name, there is no contact.
TEST(SampleQueries, RootParitysExamplesNeverBecomeCoplanar) {
  FORETOUCH_REQUIRE_SHARED(path, "ccd-queries/exact-root-parity/example-collisions.csv");
  std::ifstream file(*path);
  int rows = 0;
  for (std::string line; std::getline(file, line); ++rows) {
    const auto cells = cellsOf(line);
    ASSERT_EQ(cells.size(), 24U);
    FourPoints points;
    for (int i = 0; i < 24; ++i) {
      LinearPoint& point = points[(i / 3) % 4];
      (i < 12 ? point.from : point.to)[i % 3] = std::stod(cells[i]);
    }
    EXPECT_FALSE(askVertexFace(points).hits) << "row " << rows;
    EXPECT_FALSE(askEdgeEdge(points).hits) << "row " << rows;
  }
  EXPECT_EQ(rows, 10);
}

}  // namespace
}  // namespace foretouch::test
