// Every figure of a document that has a mark is that of its measurement, and every measurement
// names the command that reproduces it.
#include "tests/house/figures.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/house/documents.h"
#include "tests/house/source_files.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {
namespace {

TEST(Figures, OfTheDocumentsAreThoseOfTheirMeasurements) {
  Measurements measurements(std::string(FORETOUCH_SOURCE_DIR) + "/docs/measurements");
  for (const auto& document : house::documentsBelow(FORETOUCH_SOURCE_DIR)) {
    for (const std::string& complaint : measurements.complaintsAbout(house::contentOf(document))) {
      ADD_FAILURE() << document.string() << ": " << complaint;
    }
  }
  for (const std::string& complaint : measurements.complaintsAboutItself()) {
    ADD_FAILURE() << complaint;
  }
  EXPECT_GT(measurements.figures(), 80);
  EXPECT_GT(measurements.tables(), 12);
}

TEST(Figures, TheFirstScreenHasOnePerPromise) {
  const std::string readme = house::contentOf(std::string(FORETOUCH_SOURCE_DIR) + "/README.md");
  const std::string screen = readme.substr(0, readme.find("```"));
  for (const std::string name : {"oracle-contacts", "mix-10hz-once-p50", "rigid-missed-5hz"}) {
    EXPECT_NE(screen.find("<!-- figure: " + name + " -->"), std::string::npos) << name;
  }
}

/// Two measurements of a made-up program, and names for some of them.
class PlantedFigures : public testing::Test {
 protected:
  PlantedFigures() {
    folder_.write("speed.json", R"({"command": "./run speed", "tables": [{"name": "steps",
      "columns": [{"key": "hz"}, {"key": "us"}, {"key": "by"}],
      "rows": [{"hz": 5, "us": 3.684, "by": "us"}, {"hz": 30, "us": 1234.4, "by": null}]}]})");
    folder_.write("bare.json", R"({"tables": [{"name": "x", "columns": [], "rows": []}]})");
    folder_.write("figures.json", R"({
      "mean": {"file": "speed", "table": "steps", "where": {"hz": 5}, "column": "us"},
      "large": {"file": "speed", "table": "steps", "where": {"hz": 30}, "column": "us"},
      "share": {"file": "speed", "table": "steps", "where": {"hz": 5}, "column": "us",
                "over": "hz", "factor": 100},
      "vague": {"file": "speed", "table": "steps", "column": "us"}})");
  }

  std::size_t complaints(const std::string& text) {
    return Measurements(folder_.path()).complaintsAbout(text).size();
  }

  TempFolder folder_;
};

TEST_F(PlantedFigures, OfOneNumberAreCompared) {
  EXPECT_EQ(complaints("a step takes 3.7<!-- figure: mean --> us"), 0u);
  EXPECT_EQ(complaints("a step takes 3.68 <!-- figure: mean --> us"), 0u);
  EXPECT_EQ(complaints("a step takes 3.6<!-- figure: mean --> us"), 1u);
  EXPECT_EQ(complaints("it took 1,234<!-- figure: large --> us"), 0u);
  EXPECT_EQ(complaints("it took 1,235<!-- figure: large --> us"), 1u);
  EXPECT_EQ(complaints("74<!-- figure: share --> %"), 0u);
  EXPECT_EQ(complaints("a step takes long<!-- figure: mean -->"), 1u);
  EXPECT_EQ(complaints("3.7<!-- figure: meen -->"), 1u);
  EXPECT_EQ(complaints("3.7<!-- figure: vague -->"), 1u);
}

TEST_F(PlantedFigures, OfARowAreComparedInOrder) {
  EXPECT_EQ(complaints("| 5 Hz | 3.7 | 1234 <!-- figures: mean large --> |"), 0u);
  EXPECT_EQ(complaints("| 5 Hz | 1234 | 3.7 <!-- figures: mean large --> |"), 2u);
}

TEST_F(PlantedFigures, OfATableAreComparedCellByCell) {
  const std::string mark = "<!-- table: speed/steps -->\n",
                    head = "| Hz | us | by |\n|---|---|---|\n";
  EXPECT_EQ(complaints(mark + head + "| 5 | 3.7 | `us` |\n| 30 | 1,234.4 | - |\n"), 0u);
  EXPECT_EQ(complaints(mark + head + "| 5 | 3.7 | us |\n| 30 | 1,234.5 | |\n"), 1u);
  EXPECT_EQ(complaints(mark + head + "| 5 | 3.7 | ms |\n| 30 | | x |\n"), 3u);
  EXPECT_EQ(complaints(mark + head + "| 5 | 3.7 | us |\n"), 1u);
  EXPECT_EQ(complaints("<!-- table: speed/steps us -->\n| us |\n|---|\n| 4 |\n| 1234 |\n"), 0u);
  EXPECT_EQ(complaints("<!-- table: speed/stops -->\n" + head), 1u);
}

TEST_F(PlantedFigures, NeedACommandAndADocument) {
  Measurements measurements(folder_.path());
  EXPECT_TRUE(measurements.complaintsAbout("3.7<!-- figure: mean -->").empty());
  // The bare table, and the names "large", "share" and "vague".
  EXPECT_EQ(measurements.complaintsAboutItself().size(), 4u);
}

}  // namespace
}  // namespace foretouch::test
