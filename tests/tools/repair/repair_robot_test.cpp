// `foretouch repair --robot` on a robot that the test makes walk: slides and depths are planted,
// and what comes out has the same columns, other numbers, and no fault that `feet` or plain
// arithmetic finds.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/tools/feet/robot_walk.h"
#include "tests/tools/inputs/npz_bytes.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

constexpr double kHz = 100.0;

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9f", value);
  return text;
}

/// The left foot slides by 20 mm while it stands; the right one stands 6 mm too deep, and steps.
std::vector<WalkerRow> plantedRows() {
  PlantedFoot left, right;
  left.stances = {{{0, 0, -0.1}, {0.02, 0, -0.1}, 0.0, 1.2}};
  right.stances = {{{0, -0.006, 0.1}, {0, -0.006, 0.1}, 0.0, 0.5},
                   {{0.4, 0, 0.1}, {0.4, 0, 0.1}, 0.8, 1.2}};
  std::vector<WalkerRow> rows;
  for (int i = 0; i <= 120; ++i) {
    rows.push_back(walkerRow(i / kHz, left.soleAt(i / kHz), right.soleAt(i / kHz)));
  }
  return rows;
}

std::string csvOf(const std::vector<WalkerRow>& rows) {
  std::string text =
      "# as its maker wrote it\ntime,root_x,root_y,root_z,root_qx,root_qy,root_qz,"
      "root_qw";
  for (const std::string& joint : walkerJoints()) text += "," + joint;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += "\n" + digits(static_cast<double>(i) / kHz);
    for (const double number : rows[i].root) text += "," + digits(number);
    for (const double number : rows[i].xyzw) text += ", " + digits(number);
    for (const double number : rows[i].joints) text += "," + digits(number);
  }
  return text + "\n";
}

std::vector<std::vector<double>> numbersOf(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::size_t at = csv.find('\n', csv.find("time,")) + 1;
  while (at < csv.size()) {
    const std::size_t end = csv.find('\n', at);
    std::vector<double>& row = rows.emplace_back();
    for (const char* p = csv.c_str() + at; p < csv.c_str() + end;) {
      char* next = nullptr;
      row.push_back(std::strtod(p, &next));
      p = next + 1;
    }
    at = end + 1;
  }
  return rows;
}

/// Where a sphere of a sole is, by plain arithmetic: root, three slides, and the ankle's turn about
/// z. z up.
std::array<double, 3> soleAt(const std::vector<double>& row, bool isLeft, double x, double y) {
  const double* q = &row[4];
  const double* joints = &row[8 + (isLeft ? 0 : 4)];
  const double c = std::cos(joints[3]), s = std::sin(joints[3]);
  const std::array<double, 3> p{joints[0] + c * x - s * y, joints[1] + s * x + c * y,
                                joints[2] - 0.07};
  // v + 2 w (q x v) + 2 q x (q x v)
  const auto cross = [](const double* a, const std::array<double, 3>& b) {
    return std::array<double, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                 a[0] * b[1] - a[1] * b[0]};
  };
  const auto once = cross(q, p), twice = cross(q, once);
  std::array<double, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = row[1 + i] + p[i] + 2.0 * q[3] * once[i] + 2.0 * twice[i];
  }
  return out;
}

TEST(RobotRepair, MendsATableInItsOwnColumns) {
  const TempFolder folder;
  const std::string csv = csvOf(plantedRows());
  folder.write("walker.urdf", walkerUrdf());
  const Ended ended = runForetouch({"repair", folder.write("walk.csv", csv), "--robot",
                                    folder / "walker.urdf", "-o", folder / "mended.csv"});
  EXPECT_EQ(ended.exitCode, 0) << ended.out << ended.err;
  const std::string mended = contentOf(folder / "mended.csv");
  EXPECT_EQ(mended.substr(0, mended.find("\n0")), csv.substr(0, csv.find("\n0")));
  const auto before = numbersOf(csv), after = numbersOf(mended);
  ASSERT_EQ(before.size(), after.size());
  double least = 1.0, slid = 0.0, change = 0.0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    ASSERT_EQ(after[i].size(), before[i].size());
    EXPECT_EQ(after[i][0], before[i][0]);
    const double norm =
        std::hypot(std::hypot(after[i][4], after[i][5]), std::hypot(after[i][6], after[i][7]));
    EXPECT_NEAR(norm, 1.0, 1e-6);
    for (const bool isLeft : {true, false}) {
      for (const double x : {-0.05, 0.12}) {
        for (const double y : {-0.03, 0.03}) {
          const auto p = soleAt(after[i], isLeft, x, y), was = soleAt(before[i], isLeft, x, y);
          least = std::min(least, p[2] - 0.01);
          change =
              std::max(change, std::hypot(std::hypot(p[0] - was[0], p[1] - was[1]), p[2] - was[2]));
        }
      }
    }
    const auto now = soleAt(after[i], true, 0.12, 0.03), first = soleAt(after[0], true, 0.12, 0.03);
    slid = std::max(slid, std::hypot(now[0] - first[0], now[1] - first[1]));
  }
  EXPECT_GT(least, 0.0);
  EXPECT_LT(slid, 0.002);
  EXPECT_LT(change, 0.025);
}

/// A joint beyond its limit comes back to it, and no farther.
TEST(RobotRepair, BringsJointsBackToTheirLimits) {
  const TempFolder folder;
  std::vector<WalkerRow> rows;
  PlantedFoot still;
  still.stances = {{{0, 0.2, 0.1}, {0, 0.2, 0.1}, 0.0, 9.0}};
  for (int i = 0; i <= 100; ++i) {
    WalkerRow row = walkerRow(0.0, still.soleAt(0), still.soleAt(0));
    row.root[2] += 1.0;
    row.joints[1] = 5.0 * 0.4 * std::exp(-0.002 * (i - 50) * (i - 50)) - 0.1;
    rows.push_back(row);
  }
  std::string urdf = walkerUrdf();
  const std::string name = "left_y", limit = "lower=\"-5\" upper=\"5\"";
  urdf.replace(urdf.find(limit, urdf.find("\"" + name + "\"")), limit.size(),
               "lower=\"-1.8\" upper=\"1.8\"");
  folder.write("walker.urdf", urdf);
  const std::string csv = csvOf(rows);
  const Ended ended = runForetouch({"repair", folder.write("walk.csv", csv), "--robot",
                                    folder / "walker.urdf", "-o", folder / "mended.csv"});
  EXPECT_EQ(ended.exitCode, 0) << ended.out << ended.err;
  const auto after = numbersOf(contentOf(folder / "mended.csv"));
  double most = 0.0;
  for (const auto& row : after) most = std::max(most, row[9]);
  EXPECT_NEAR(most, 1.8, 1e-4);
}

/// The same as arrays: other arrays and types stay, and it reads back.
TEST(RobotRepair, MendsArrays) {
  const TempFolder folder;
  std::vector<double> root, turn, joints;
  const auto rows = plantedRows();
  for (const WalkerRow& row : rows) {
    root.insert(root.end(), row.root.begin(), row.root.end());
    turn.insert(turn.end(), {row.xyzw[3], row.xyzw[0], row.xyzw[1], row.xyzw[2]});
    joints.insert(joints.end(), row.joints.begin(), row.joints.end());
  }
  const std::string count = std::to_string(rows.size());
  folder.write("walker.urdf", walkerUrdf());
  folder.write("walk.npz", npzOf({{"fps", npyOf<double>("<f8", "()", {kHz})},
                                  {"root_pos", npyOf("<f8", "(" + count + ", 3)", root)},
                                  {"root_rot_wxyz", npyOf("<f8", "(" + count + ", 4)", turn)},
                                  {"dof_pos", npyOf("<f8", "(" + count + ", 8)", joints)},
                                  {"reward", npyOf<double>("<f8", "(2,)", {1.5, 2.5})},
                                  {"joint_names", npyOfTexts(walkerJoints(), 11)}},
                                 true));
  const Ended ended = runForetouch({"repair", folder / "walk.npz", "--robot",
                                    folder / "walker.urdf", "-o", folder / "mended.npz"});
  EXPECT_EQ(ended.exitCode, 0) << ended.out << ended.err;
  const Ended again = runForetouch({"repair", folder / "mended.npz", "--robot",
                                    folder / "walker.urdf", "-o", folder / "again.npz"});
  EXPECT_EQ(again.exitCode, 0);
  EXPECT_NE(again.out.find("nothing was changed"), std::string::npos) << again.out;
  EXPECT_NE(contentOf(folder / "mended.npz").find("reward.npy"), std::string::npos);
}

}  // namespace
}  // namespace foretouch::test
