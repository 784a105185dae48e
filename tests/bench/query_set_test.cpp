// tests/bench/query_set_test.cpp: query files are read exactly, and bad ones are refused by
// place.
#include "bench/query_set.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "judge/rational_linear.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

namespace foretouch::tools {
namespace {

const std::string kVertexFaceHit =
    "1,4,1,4,1,1,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n"
    "1,4,1,4,-1,1,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n";

Error errorOf(const std::string& text) {
  const auto queries = parseQueries(text, "q.csv");
  EXPECT_FALSE(queries.ok()) << text;
  return queries.ok() ? Error{} : queries.error();
}

std::string withWord(const std::string& word) {
  return word + ",1,1,4,1,1,1\n";
}

TEST(ParseQueries, ReadsPointsAndLabel) {
  const auto queries = parseQueries(kVertexFaceHit, "q.csv");
  ASSERT_TRUE(queries.ok());
  ASSERT_EQ(queries.value().size(), 1u);
  const LabelledQuery& q = queries.value()[0];
  EXPECT_TRUE(q.hits);
  EXPECT_EQ(q.points[0].from, Eigen::Vector3d(0.25, 0.25, 1));
  EXPECT_EQ(q.points[0].to, Eigen::Vector3d(0.25, 0.25, -1));
  EXPECT_EQ(q.points[3].to, Eigen::Vector3d(0, 1, 0));
  EXPECT_TRUE(answer(QueryKind::VertexFace, q).hits);
}

TEST(ParseQueries, KeepsEveryBit) {
  // 2^53 + 2 over 2^120, and a numerator beyond 64 bits: 3 * 2^80.
  std::string text = kVertexFaceHit;
  text.replace(0, 7,
               "9007199254740994,1329227995784915872903807060280344576,"
               "3626777458843887524118528,1");
  const auto queries = parseQueries(text, "q.csv");
  ASSERT_TRUE(queries.ok()) << describe(queries.error());
  EXPECT_EQ(queries.value()[0].points[0].from.x(), (0x1p53 + 2) * 0x1p-120);
  EXPECT_EQ(queries.value()[0].points[0].from.y(), 3 * 0x1p80);
}

TEST(ParseQueries, TakesWindowsLineEndsAndEmptyLines) {
  std::string text;
  for (const char c : kVertexFaceHit) text += c == '\n' ? "\r\n\n" : std::string(1, c);
  EXPECT_TRUE(parseQueries(text, "q.csv").ok());
  EXPECT_TRUE(parseQueries("", "q.csv").ok());
}

TEST(ParseQueries, RefusesWhatIsNoExactDouble) {
  for (const std::string word : {"9007199254740993", "", "1.5", "1e3", "0x10", "nan", "inf", "--1",
                                 "+1", "1 2", "1\x1b", "99999999999999999999"}) {
    const Error error = errorOf(withWord(word));
    EXPECT_EQ(error.code, ErrorCode::OutOfRange) << word;
    EXPECT_EQ(error.line, 1);
    EXPECT_EQ(error.file, "q.csv");
    EXPECT_EQ(error.message.find('\x1b'), std::string::npos);
  }
  EXPECT_EQ(errorOf("1,3,0,1,0,1,1\n").code, ErrorCode::OutOfRange);  // a third
  EXPECT_EQ(errorOf("1,0,0,1,0,1,1\n").code, ErrorCode::OutOfRange);  // by zero
  EXPECT_EQ(errorOf("1,-2,0,1,0,1,1\n").code, ErrorCode::OutOfRange);
  EXPECT_EQ(errorOf(withWord("1" + std::string(150, '0'))).code, ErrorCode::OutOfRange);
  EXPECT_EQ(errorOf(withWord(std::string(100'000, '9'))).code, ErrorCode::OutOfRange);
}

TEST(ParseQueries, RefusesWrongShapesByLine) {
  EXPECT_EQ(errorOf("1,1,1,1,1,1\n").line, 1);
  EXPECT_EQ(errorOf("1,1,1,1,1,1,1,1\n").line, 1);
  EXPECT_EQ(errorOf("1,1,1,1,1,1,2\n").line, 1);
  EXPECT_EQ(errorOf(std::string(1'000'000, ',')).line, 1);
  std::string mixed = kVertexFaceHit;
  mixed[mixed.size() - 2] = '0';
  EXPECT_EQ(errorOf(mixed).line, 8);
  EXPECT_NE(errorOf(kVertexFaceHit + "1,1,1,1,1,1,1\n").message.find("found 1"), std::string::npos);
}

TEST(ReadQuerySets, NamesSetsByTheirFoldersAndJoinsFiles) {
  const test::TempFolder folder;
  for (const std::string sub : {"b/vertex-face", "a/edge-edge", "a/vertex-face"}) {
    std::filesystem::create_directories(folder / sub);
    folder.write(sub + "/0.csv", kVertexFaceHit);
    folder.write(sub + "/1.csv", kVertexFaceHit);
    folder.write(sub + "/notes.txt", "not a query");
  }
  const auto sets = readQuerySets({folder.path()});
  ASSERT_TRUE(sets.ok()) << describe(sets.error());
  ASSERT_EQ(sets.value().size(), 3u);
  EXPECT_EQ(sets.value()[0].name, "a");
  EXPECT_EQ(sets.value()[0].kind, QueryKind::VertexFace);
  EXPECT_EQ(sets.value()[1].kind, QueryKind::EdgeEdge);
  EXPECT_EQ(sets.value()[2].name, "b");
  EXPECT_EQ(sets.value()[2].queries.size(), 2u);
}

TEST(ReadQuerySets, RefusesFoldersWithoutQueriesAndBadFiles) {
  const test::TempFolder folder;
  EXPECT_EQ(readQuerySets({folder / "absent"}).error().code, ErrorCode::FileNotFound);
  EXPECT_EQ(readQuerySets({folder.path()}).error().code, ErrorCode::Empty);
  std::filesystem::create_directories(folder / "a/edge-edge");
  const std::string bad = folder.write("a/edge-edge/bad.csv", "1,2\n");
  const auto sets = readQuerySets({folder.path()});
  ASSERT_FALSE(sets.ok());
  EXPECT_EQ(std::filesystem::path(sets.error().file).filename(), "bad.csv");
  EXPECT_EQ(sets.error().line, 1);
  EXPECT_FALSE(readQuerySets({bad}).ok());
}

// The public labels and the rational oracle were made by different hands.
TEST(ReadQuerySets, PublicLabelsAreWhatTheRationalOracleSays) {
  FORETOUCH_REQUIRE_SHARED(folder, "ccd-queries/sample-queries");
  const auto sets = readQuerySets({*folder});
  ASSERT_TRUE(sets.ok()) << describe(sets.error());
  const auto plain = [](const Eigen::Vector3d& v) { return oracle::Vec3d{v.x(), v.y(), v.z()}; };
  std::size_t queries = 0;
  for (const QuerySet& set : sets.value()) {
    for (const LabelledQuery& labelled : set.queries) {
      oracle::LinearQuery query;
      query.kind = set.kind == QueryKind::VertexFace ? oracle::LinearKind::VertexFace
                                                     : oracle::LinearKind::EdgeEdge;
      for (std::size_t i = 0; i < 4; ++i) {
        query.points[i] = {plain(labelled.points[i].from), plain(labelled.points[i].to)};
      }
      ++queries;
      EXPECT_EQ(oracle::linearTruth(query).hits, labelled.hits) << set.name;
      EXPECT_EQ(oracle::linearTruthByRationals(query).hits, labelled.hits) << set.name;
    }
  }
  EXPECT_GT(queries, 1000u);
}

}  // namespace
}  // namespace foretouch::tools
