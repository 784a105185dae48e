// `foretouch feet` as a user types it, on a walk that the test plants.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/shared_data.h"
#include "tests/tools/feet/planted_walk.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

constexpr double kFrameS = 0.01;

/// A floor at y = 0.4, as the top of a box that a scene has.
constexpr char kStageObj[] =
    "o stage\nv -5 0.4 -5\nv 5 0.4 -5\nv 5 0.4 5\nv -5 0.4 5\nf 1 2 3\nf 1 3 4\n"
    "o floor\nv -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 5 6 7\nf 5 7 8\n";

/// The left foot stands, slides by 20 mm along z, and stands; the right one steps to x = 0.5.
class PlantedFiles {
 public:
  PlantedFiles() {
    PlantedFoot left, right;
    left.stances = {{{0, 0, 0}, {0, 0, 0.02}, 0.0, 1.6}};
    right.stances = {{{0, 0, 0.2}, {0, 0, 0.2}, 0.0, 0.6},
                     {{0.5, 0, 0.2}, {0.5, 0, 0.2}, 1.0, 1.6}};
    std::vector<Place> leftSoles, rightSoles;
    for (int frame = 0; frame <= 160; ++frame) {
      leftSoles.push_back(left.soleAt(frame * kFrameS));
      rightSoles.push_back(right.soleAt(frame * kFrameS));
    }
    folder.write("walker.json", kWalkerAvatar);
    folder.write("walk.bvh", walkBvh(leftSoles, rightSoles, kFrameS));
    folder.write("stage.obj", kStageObj);
  }

  [[nodiscard]] Ended feet(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"feet", folder / "walk.bvh", folder / "walker.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runForetouch(arguments);
  }

  TempFolder folder;
};

std::vector<std::vector<std::string>> rowsOf(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(contentOf(path));
  for (std::string line; std::getline(text, line);) {
    std::vector<std::string> cells{""};
    for (const char c : line) {
      if (c == ',') {
        cells.emplace_back();
      } else {
        cells.back() += c;
      }
    }
    rows.push_back(cells);
  }
  return rows;
}

std::size_t countLines(const std::string& path) {
  const std::string text = contentOf(path);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(FeetProgram, WritesStancesLabelsAndAPlot) {
  const PlantedFiles files;
  const TempFolder& folder = files.folder;
  const Ended ended = files.feet({"--output", folder / "feet.csv", "--labels", folder / "l.csv",
                                  "--plot", folder / "feet.html"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("LeftFoot: 1 touch; 1 slides 2 mm or more, the worst 2"),
            std::string::npos)
      << ended.out;
  const auto rows = rowsOf(folder / "feet.csv");
  ASSERT_EQ(rows.size(), 1u + 3u + 6u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 16u);
    const double truth = rows[i][0] == "LeftFoot" ? 20.0 : 0.0;
    EXPECT_NEAR(std::stod(rows[i][10]), truth, 1.0) << rows[i][0] << " " << rows[i][1];
  }
  EXPECT_EQ(countLines(folder / "l.csv"), 1u + 161u * 6u);
  EXPECT_NE(contentOf(folder / "feet.html").find("<polyline class=\"trace\""), std::string::npos);
  for (const char* const name : {"l.jsonl", "l.npz"}) {
    const Ended again = files.feet({"--labels", folder / name, "--from", "10f", "--to", "0.5"});
    ASSERT_EQ(again.exitCode, 0) << again.err;
    EXPECT_NE(again.out.find("frames 10 to 50"), std::string::npos) << again.out;
  }
  EXPECT_EQ(countLines(folder / "l.jsonl"), 1u + 41u);
  EXPECT_EQ(contentOf(folder / "l.npz").substr(0, 2), "PK");
}

/// Heel, ball and toe of a foot that stands are three stances and one touch: the same count in the
/// sentences, the table of heights, the JSON and the page.
TEST(FeetProgram, CountsTouchesOfFeetOnce) {
  const PlantedFiles files;
  const Ended text = files.feet({"--plot", files.folder / "feet.html"});
  EXPECT_NE(text.out.find("LeftFoot: 1 touch;"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("RightFoot: 2 touches;"), std::string::npos) << text.out;
  const std::size_t row = text.out.find("touches of feet ");
  ASSERT_NE(row, std::string::npos);
  std::istringstream counts(text.out.substr(row + 22, 63));
  std::vector<int> touches(9);
  for (int& count : touches) counts >> count;
  EXPECT_EQ(touches[4], 3) << "with the body as it is";
  EXPECT_NE(contentOf(files.folder / "feet.html").find("RightFoot: 2 touches;"), std::string::npos);
  const std::string told = files.feet({"--json"}).out;
  EXPECT_NE(told.find(R"("name":"RightFoot","touches":2,)"), std::string::npos) << told;
  EXPECT_NE(told.find(R"("raise":0,"touches":3,)"), std::string::npos) << told;
  std::size_t longest = 0, digits = 0;
  for (const char c : told.substr(told.find("limbs"))) {
    digits = std::isdigit(static_cast<unsigned char>(c)) != 0 ? digits + 1 : 0;
    longest = std::max(longest, digits);
  }
  EXPECT_LE(longest, 7u) << "as many digits as floats know: " << told;
}

/// What makes an answer doubtful is said: a T-pose at the begin, a mesh with a vertex that is not
/// finite, a body that jumps far in one step, feet that end at the ankle.
TEST(FeetProgram, SaysWhatMakesItsAnswerDoubtful) {
  const PlantedFiles files;
  std::string hole = kStageObj;
  hole.replace(hole.find("v -5"), 4, "v nan");
  files.folder.write("hole.obj", hole);
  const Ended onHole = files.feet({files.folder / "hole.obj"});
  EXPECT_NE(onHole.err.find("2 triangles with a vertex that is not finite"), std::string::npos)
      << onHole.err;
  EXPECT_EQ(onHole.err.find("T-pose"), std::string::npos) << onHole.err;
  EXPECT_EQ(onHole.err.find("heel"), std::string::npos) << onHole.err;

  std::string walk = contentOf(files.folder / "walk.bvh");
  const std::size_t last = walk.rfind("\n0 0 0");
  walk.replace(last, 6, "\n5000 0 0");
  const std::string jump = files.folder.write("jump.bvh", walk);
  const Ended jumps = runForetouch({"feet", jump, files.folder / "walker.json"});
  EXPECT_NE(jumps.err.find("between frames 159 and 160 the body jumps, by 5000 m at most"),
            std::string::npos)
      << jumps.err;
}

TEST(FeetProgram, MakesHeelsForAvatarsOfBones) {
  FORETOUCH_REQUIRE_SHARED(walk, "mocap/cmu_cgspeed_walk_crlf.bvh");
  const TempFolder folder;
  for (const bool heels : {false, true}) {
    std::vector<std::string> make{"avatar", "bvh", *walk,       "--clip-scale",
                                  "0.0564", "-o",  folder / "a"};
    if (heels) make.emplace_back("--heels");
    ASSERT_EQ(runForetouch(make).exitCode, 0);
    const Ended ended =
        runForetouch({"feet", *walk, "--avatar", folder / "a", "--clip-scale", "0.0564"});
    EXPECT_EQ(ended.err.find("2 of its feet have no heel") == std::string::npos, heels)
        << ended.err;
    EXPECT_NE(ended.err.find("it begins with a T-pose, the first frame"), std::string::npos)
        << ended.err;
  }
}

/// From 15 cm above the stage, and 40 cm above the floor below it.
TEST(FeetProgram, LaysTheClipOnTheSceneBelowItsFeet) {
  const PlantedFiles files;
  const std::vector<std::string> scene{files.folder / "stage.obj", "--place", "0,0.55,0",
                                       "--output", files.folder / "feet.csv"};
  const Ended above = files.feet(scene);
  ASSERT_EQ(above.exitCode, 0) << above.err;
  EXPECT_NE(above.out.find("LeftFoot: touches nothing"), std::string::npos) << above.out;
  std::vector<std::string> fitted = scene;
  fitted.insert(fitted.end(), {"--ground", "fit"});
  const Ended on = files.feet(fitted);
  ASSERT_EQ(on.exitCode, 0) << on.err;
  EXPECT_NE(on.out.find("lowered by 150.0 mm"), std::string::npos) << on.out;
  const auto rows = rowsOf(files.folder / "feet.csv");
  ASSERT_EQ(rows.size(), 1u + 3u + 6u);
  EXPECT_EQ(rows[1][3], "stage");
  EXPECT_NEAR(std::stod(rows[1][12]), 0.0, 0.1) << "depth";
}

/// As on a treadmill of 1.4 m/s: a clip whose body something else is to move.
TEST(FeetProgram, SaysOfAWalkInPlaceThatItIsOne) {
  const auto soleAt = [](double timeS) {
    const double share = timeS - std::floor(timeS);
    if (share < 0.5) return Place{0, 0, 0.35 - 1.4 * share};
    return Place{0, 0.1 * std::sin(2.0 * 3.14159265358979 * (share - 0.5)),
                 -0.35 + 1.4 * (share - 0.5)};
  };
  std::vector<Place> left, right;
  for (int frame = 0; frame <= 300; ++frame) {
    left.push_back(soleAt(frame * kFrameS));
    right.push_back(soleAt(frame * kFrameS + 0.5));
  }
  const PlantedFiles files;
  files.folder.write("walk.bvh", walkBvh(left, right, kFrameS));
  const Ended walks = files.feet({});
  ASSERT_EQ(walks.exitCode, 0) << walks.err;
  EXPECT_NE(walks.err.find("it walks in place, for something else to move it: each foot that bears "
                           "slides, on average at 1.40 m/s"),
            std::string::npos)
      << walks.err;
  const Ended fits = files.feet({"--ground", "fit"});
  EXPECT_EQ(fits.exitCode, 2);
  EXPECT_NE(fits.err.find("it walks in place, so each foot slides"), std::string::npos) << fits.err;
  EXPECT_EQ(PlantedFiles().feet({}).err.find("in place"), std::string::npos)
      << "one that gets somewhere";
}

/// Real clips: one that begins in a T-pose, and a sprint of 0.6 s whose feet never rest.
TEST(FeetProgram, FitsAWalkAndRefusesASprint) {
  FORETOUCH_REQUIRE_SHARED(walk, "mocap/cmu_cgspeed_walk_crlf.bvh");
  FORETOUCH_REQUIRE_SHARED(dash, "mocap/bandai1_dash_normal_001.bvh");
  const Ended walks =
      runForetouch({"feet", *walk, "--clip-scale", "0.0564", "--skip-t-pose", "--ground", "fit"});
  EXPECT_EQ(walks.exitCode, 0) << walks.err;
  EXPECT_NE(walks.err.find("--skip-t-pose: left out a T-pose, the first frame (0.008333 s)"),
            std::string::npos)
      << walks.err;
  EXPECT_NE(walks.out.find("rests of feet show"), std::string::npos) << walks.out;
  EXPECT_EQ(walks.out.find("below the ground"), std::string::npos) << walks.out;
  const Ended sprints = runForetouch({"feet", *dash, "--clip-scale", "0.01", "--ground", "fit"});
  EXPECT_EQ(sprints.exitCode, 2);
  EXPECT_NE(sprints.err.find("no foot rests"), std::string::npos) << sprints.err;
  for (const char* const ground : {"given", "fit"}) {
    const Ended giant = runForetouch({"feet", *dash, "--ground", ground});
    EXPECT_EQ(giant.exitCode, std::string(ground) == "fit" ? 2 : 0);
    EXPECT_NE(giant.err.find("are for people: centimetres make it 1."), std::string::npos)
        << giant.err;
    EXPECT_NE(giant.err.find("(--clip-scale 0.01)"), std::string::npos) << giant.err;
  }
}

TEST(FeetProgram, NamesWhatIsWrong) {
  const PlantedFiles files;
  const std::string clip = files.folder / "walk.bvh";
  struct Case {
    std::vector<std::string> more;
    const char* said;
  };
  for (const Case& one : std::vector<Case>{
           {{"--labels", files.folder / "l.txt"},
            "--labels: expected a file that ends in .csv, .jsonl"},
           {{"--from", "9"},
            "--from: expected an instant of the clip, which ends at 1.6 s (frame 160)"},
           {{"--from", "-1"}, "--from: expected seconds of the clip, or a frame from 0 as 300f"},
           {{"--output", clip}, "walk.bvh"},
           {{"--output", files.folder / "new.csv", "--plot", files.folder / "./new.csv"},
            "is to hold another output as well"},
           {{"--ground", "fit", "--from", "0.66", "--to", "0.7", "--rate", "100"},
            "--ground fit: "},
       }) {
    const Ended ended = files.feet(one.more);
    EXPECT_EQ(ended.exitCode, 2) << one.said;
    EXPECT_NE(ended.err.find(one.said), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace foretouch::test
