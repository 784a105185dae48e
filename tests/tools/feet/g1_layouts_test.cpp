// One motion of a robot with the 29 joints of a G1, as both public sets write it: without a header
// in metres, radians and a quaternion, and with one in centimetres, degrees and angles.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temp_folder.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

struct G1Joint {
  std::string name, axis, parent;
  double down = 0.0;  ///< From its parent (m).
};

std::vector<G1Joint> jointsOfG1() {
  std::vector<G1Joint> joints;
  const auto chain = [&](const std::string& prefix, std::string parent,
                         const std::vector<std::vector<std::string>>& parts) {
    for (const auto& part : parts) {
      joints.push_back({prefix + part[0], part[1], parent, std::stod(part[2])});
      parent = prefix + part[0];
    }
  };
  for (const char* const side : {"left_", "right_"}) {
    chain(side, "pelvis",
          {{"hip_pitch", "0 1 0", "0"},
           {"hip_roll", "1 0 0", "0"},
           {"hip_yaw", "0 0 1", "0"},
           {"knee", "0 1 0", "0.3"},
           {"ankle_pitch", "0 1 0", "0.3"},
           {"ankle_roll", "1 0 0", "0"}});
  }
  chain("waist_", "pelvis",
        {{"yaw", "0 0 1", "0"}, {"roll", "1 0 0", "0"}, {"pitch", "0 1 0", "0"}});
  for (const char* const side : {"left_", "right_"}) {
    chain(side, "waist_pitch",
          {{"shoulder_pitch", "0 1 0", "-0.3"},
           {"shoulder_roll", "1 0 0", "0"},
           {"shoulder_yaw", "0 0 1", "0"},
           {"elbow", "0 1 0", "0.2"},
           {"wrist_roll", "1 0 0", "0"},
           {"wrist_pitch", "0 1 0", "0"},
           {"wrist_yaw", "0 0 1", "0"}});
  }
  return joints;
}

std::string urdfOfG1() {
  std::string text = "<robot name=\"g1\"><link name=\"pelvis\"/>";
  for (const G1Joint& joint : jointsOfG1()) {
    text += "<link name=\"" + joint.name + "\">";
    for (const char* const end : {"-0.05", "0.12"}) {
      if (joint.name.find("ankle_roll") == std::string::npos) continue;
      text += "<collision><origin xyz=\"" + std::string(end) +
              " 0 -0.05\"/><geometry><sphere radius=\"0.02\"/></geometry></collision>";
    }
    text += "</link><joint name=\"" + joint.name + "_joint\" type=\"revolute\"><parent link=\"" +
            joint.parent + "\"/><child link=\"" + joint.name + "\"/><origin xyz=\"0 0 " +
            std::to_string(-joint.down) + "\"/><axis xyz=\"" + joint.axis +
            "\"/><limit lower=\"-3\" upper=\"3\" effort=\"1\" velocity=\"1\"/></joint>";
  }
  return text + "</robot>";
}

/// Row by row, at 30 Hz: it leans, and its root goes 20 mm along x while it stands.
struct G1Row {
  double x = 0.0, z = 0.655;
  double roll = 4.0, pitch = 5.0, yaw = 40.0;  ///< Degrees.
  double knee = 6.0;                           ///< Of the left leg.
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9f", value);
  return text;
}

std::string jointCells(const G1Row& row, double unit) {
  std::string cells;
  for (const G1Joint& joint : jointsOfG1()) {
    cells += "," + number(joint.name == "left_knee" ? row.knee * unit : 0.0);
  }
  return cells + "\n";
}

std::string lafanRow(const G1Row& row) {
  const Eigen::Quaterniond q = AngleAxisd(row.yaw * kDegree, Vector3d::UnitZ()) *
                               AngleAxisd(row.pitch * kDegree, Vector3d::UnitY()) *
                               AngleAxisd(row.roll * kDegree, Vector3d::UnitX());
  std::string cells = number(row.x) + ",0," + number(row.z);
  for (const double part : {q.x(), q.y(), q.z(), q.w()}) cells += "," + number(part);
  return cells + jointCells(row, kDegree);
}

std::string seedRow(int frame, const G1Row& row) {
  std::string cells = std::to_string(frame);
  for (const double cell : {100.0 * row.x, 0.0, 100.0 * row.z, row.roll, row.pitch, row.yaw}) {
    cells += "," + number(cell);
  }
  return cells + jointCells(row, 1.0);
}

TEST(G1Layouts, OneMotionHasTheSameFeetInBothSets) {
  std::string lafan, seed =
                         "Frame,root_translateX,root_translateY,root_translateZ,root_rotateX,"
                         "root_rotateY,root_rotateZ";
  for (const G1Joint& joint : jointsOfG1()) seed += "," + joint.name + "_joint_dof";
  seed += "\n";
  for (int frame = 0; frame <= 60; ++frame) {
    G1Row row;
    row.x = 0.02 * frame / 60.0;
    lafan += lafanRow(row);
    seed += seedRow(frame, row);
  }
  const TempFolder folder;
  const std::string urdf = folder.write("g1.urdf", urdfOfG1());
  const auto feetOf = [&](const std::string& table, const std::string& columns) {
    const Ended ended = runForetouch(
        {"feet", table, "--robot", urdf, "--columns", columns, "--row-rate", "30", "--json"});
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    return nlohmann::json::parse(ended.out);
  };
  const auto one = feetOf(folder.write("walk1_subject1.csv", lafan), "lafan1-g1");
  const auto other = feetOf(folder.write("walk_forward.csv", seed), "bones-seed-g1");
  EXPECT_EQ(one["poses"], other["poses"]);
  EXPECT_NEAR(one["worst_slide"].get<double>(), 0.02, 5e-4) << one;
  EXPECT_GT(one["deepest"].get<double>(), 0.002) << "it leans into the floor: " << one;
  for (const char* const figure : {"worst_slide", "deepest", "mean_penetration", "mean_floating"}) {
    EXPECT_NEAR(one[figure].get<double>(), other[figure].get<double>(), 1e-6) << figure;
  }
}

}  // namespace
}  // namespace foretouch::test
