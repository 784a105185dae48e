// `foretouch feet --robot` on a robot that the test makes walk: slides and depths are known, and
// the same motion in any layout has the same feet.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/tools/feet/robot_walk.h"
#include "tests/tools/inputs/npz_bytes.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

constexpr double kHz = 100.0;

std::string exactly(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// The left foot slides by 20 mm while it stands; the right one stands 6 mm too deep, and steps.
class WalkingRobot {
 public:
  WalkingRobot() {
    PlantedFoot left, right;
    left.stances = {{{0, 0, -0.1}, {0.02, 0, -0.1}, 0.0, 1.2}};
    right.stances = {{{0, -0.006, 0.1}, {0, -0.006, 0.1}, 0.0, 0.5},
                     {{0.4, 0, 0.1}, {0.4, 0, 0.1}, 0.8, 1.2}};
    for (int i = 0; i <= 120; ++i) {
      rows.push_back(walkerRow(i / kHz, left.soleAt(i / kHz), right.soleAt(i / kHz)));
    }
    folder.write("walker.urdf", walkerUrdf());
    folder.write("walk.csv", csv());
  }

  [[nodiscard]] std::string csv() const {
    std::string text = "time,root_x,root_y,root_z,root_qx,root_qy,root_qz,root_qw";
    for (const std::string& joint : walkerJoints()) text += "," + joint;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      text += "\n" + exactly(static_cast<double>(i) / kHz) + ",";
      text += numbers(rows[i], {3, 4, 5, 6});
    }
    return text + "\n";
  }
  /// The same without a header.
  [[nodiscard]] std::string bare() const {
    std::string text;
    for (const WalkerRow& row : rows) text += numbers(row, {3, 4, 5, 6}) + "\n";
    return text;
  }
  [[nodiscard]] std::string npz() const {
    std::vector<double> root, turn, joints;
    for (const WalkerRow& row : rows) {
      root.insert(root.end(), row.root.begin(), row.root.end());
      turn.insert(turn.end(), {row.xyzw[3], row.xyzw[0], row.xyzw[1], row.xyzw[2]});
      joints.insert(joints.end(), row.joints.begin(), row.joints.end());
    }
    const auto shape = [&](const char* columns) {
      return "(" + std::to_string(rows.size()) + ", " + columns + ")";
    };
    return npzOf({{"fps", npyOf<double>("<f8", "()", {kHz})},
                  {"root_pos", npyOf("<f8", shape("3"), root)},
                  {"root_rot", npyOf("<f8", shape("4"), turn)},
                  {"joint_pos", npyOf("<f8", shape("8"), joints)},
                  {"joint_names", npyOfTexts(walkerJoints(), 11)}},
                 true);
  }

  /// What `feet` writes of all stances.
  [[nodiscard]] std::string stances(const std::string& file, std::vector<std::string> more,
                                    std::string* told = nullptr) const {
    std::vector<std::string> words{
        "feet", folder / file, "--robot", folder / "walker.urdf", "--output", folder / "feet.csv"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = runForetouch(words);
    EXPECT_EQ(ended.exitCode, 0) << file << ": " << ended.err;
    if (told != nullptr) *told = ended.out + ended.err;
    return contentOf(folder / "feet.csv");
  }

  std::vector<WalkerRow> rows;
  TempFolder folder;

 private:
  static std::string numbers(const WalkerRow& row, std::vector<std::size_t> order) {
    std::vector<double> all(row.root.begin(), row.root.end());
    all.insert(all.end(), row.xyzw.begin(), row.xyzw.end());
    std::string text = exactly(all[0]) + "," + exactly(all[1]) + "," + exactly(all[2]);
    for (const std::size_t i : order) text += "," + exactly(all[i]);
    for (const double value : row.joints) text += "," + exactly(value);
    return text;
  }
};

/// The numbers of a column, by the parts that have them.
std::vector<std::pair<std::string, double>> column(const std::string& csv,
                                                   const std::string& name) {
  std::vector<std::vector<std::string>> rows{{""}};
  for (const char c : csv) {
    if (c == '\n') {
      rows.emplace_back(1, "");
    } else if (c == ',') {
      rows.back().emplace_back();
    } else {
      rows.back().back() += c;
    }
  }
  std::vector<std::pair<std::string, double>> found;
  std::size_t at = 0;
  while (at < rows[0].size() && rows[0][at] != name) ++at;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].size() > at) found.emplace_back(rows[i][0], std::atof(rows[i][at].c_str()));
  }
  return found;
}

TEST(RobotFeet, SlidesAndDepthsAreThosePlanted) {
  const WalkingRobot robot;
  std::string told;
  const std::string csv = robot.stances("walk.csv", {}, &told);
  const auto slides = column(csv, "slide_mm"), depths = column(csv, "depth_mm");
  ASSERT_EQ(slides.size(), 6u) << csv << told;  // heel and ball; right ones twice
  ASSERT_EQ(depths.size(), 6u);
  for (std::size_t i = 0; i < slides.size(); ++i) {
    const bool isLeft = slides[i].first.find("left") == 0;
    EXPECT_NEAR(slides[i].second, isLeft ? 20.0 : 0.0, 0.2) << slides[i].first;
  }
  int sunk = 0;
  for (const auto& [part, depth] : depths) {
    if (depth < 3.0) continue;
    EXPECT_NEAR(depth, 6.0, 0.01) << part;
    ++sunk;
  }
  EXPECT_EQ(sunk, 2);
}

TEST(RobotFeet, AreTheSameInAnyLayout) {
  const WalkingRobot robot;
  const std::string csv = robot.stances("walk.csv", {});
  robot.folder.write("walk.npz", robot.npz());
  robot.folder.write("bare.csv", robot.bare());
  EXPECT_EQ(robot.stances("walk.npz", {"--quaternion", "wxyz"}), csv);
  std::string columns = "root_x,root_y,root_z,root_qx,root_qy,root_qz,root_qw";
  for (const std::string& joint : walkerJoints()) columns += "," + joint;
  EXPECT_EQ(robot.stances("bare.csv", {"--columns", columns, "--row-rate", "100"}), csv);
  EXPECT_EQ(robot.stances("walk.csv", {"--foot", "*ankle_roll_link"}), csv);
}

TEST(RobotFeet, ReplaysWithOwnLinksAndNamesWhatIsMissing) {
  const WalkingRobot robot;
  const TempFolder& folder = robot.folder;
  ASSERT_EQ(runForetouch({"avatar", "urdf", folder / "walker.urdf", "-o", folder / "walker.json"})
                .exitCode,
            0);
  folder.write("floor.obj", "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 1 4 3\nf 1 3 2\n");
  robot.folder.write("walk.npz", robot.npz());
  const auto replay = [&](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> words{"replay",
                                   "--scene",
                                   folder / "floor.obj",
                                   "--avatar",
                                   folder / "walker.json",
                                   "--motion",
                                   folder / file,
                                   "--robot",
                                   folder / "walker.urdf",
                                   "--self",
                                   "--output",
                                   folder / "out.jsonl"};
    words.insert(words.end(), more.begin(), more.end());
    return runForetouch(words);
  };
  const Ended csv = replay("walk.csv", {});
  ASSERT_EQ(csv.exitCode, 0) << csv.err;
  const std::string lines = contentOf(folder / "out.jsonl");
  EXPECT_NE(lines.find("\"link\":\"right_ankle_roll_link\",\"verdict\":\"starts_in_contact\""),
            std::string::npos);
  const Ended unsaid = replay("walk.npz", {});
  EXPECT_EQ(unsaid.exitCode, 2);
  EXPECT_NE(unsaid.err.find("walk.npz: array 'root_rot': its name does not end in"),
            std::string::npos)
      << unsaid.err;
  const Ended npz = replay("walk.npz", {"--quaternion", "wxyz"});
  ASSERT_EQ(npz.exitCode, 0) << npz.err;
  EXPECT_NE(contentOf(folder / "out.jsonl").find("\"quaternion\":\"wxyz\""), std::string::npos);
  const Ended wrong = runForetouch({"feet", folder / "walk.csv", "--robot", folder / "walker.urdf",
                                    "--foot", "left_ankle_rol_link"});
  EXPECT_NE(wrong.err.find("did you mean 'left_ankle_roll_link'"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace foretouch::test
