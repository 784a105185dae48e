// tests/tools/feet/robot_walk.h: a robot whose feet are where planted_walk.h puts them: each hangs
// on the moving and turning pelvis by three slides and an ankle, so plain arithmetic says how they
// stand. Its files have z up.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/tools/feet/planted_walk.h"

namespace foretouch::test {

/// Soles are four spheres, as of many humanoids; y of a sole is their lowest point.
inline std::string walkerUrdf() {
  std::string text =
      "<robot name=\"walker\"><link name=\"pelvis\"><collision><geometry><sphere radius=\"0.1\"/>"
      "</geometry></collision></link>";
  const auto joint = [&](const std::string& name, const std::string& type, const std::string& axis,
                         const std::string& parent, const std::string& child) {
    text += "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
            "\"/><child link=\"" + child + "\"/><axis xyz=\"" + axis +
            "\"/><limit lower=\"-5\" upper=\"5\" effort=\"1\" velocity=\"1\"/></joint>";
  };
  for (const std::string side : {"left", "right"}) {
    const std::string foot = side + "_ankle_roll_link";
    for (const char* const leg : {"_slide_x", "_slide_y", "_slide_z"}) {
      text += "<link name=\"" + side + leg + "\"/>";
    }
    text += "<link name=\"" + foot + "\">";
    for (const char* const corner : {"-0.05 -0.03", "-0.05 0.03", "0.12 -0.03", "0.12 0.03"}) {
      text += "<collision><origin xyz=\"" + std::string(corner) +
              " -0.07\"/><geometry><sphere radius=\"0.01\"/></geometry></collision>";
    }
    text += "</link>";
    joint(side + "_x", "prismatic", "1 0 0", "pelvis", side + "_slide_x");
    joint(side + "_y", "prismatic", "0 1 0", side + "_slide_x", side + "_slide_y");
    joint(side + "_z", "prismatic", "0 0 1", side + "_slide_y", side + "_slide_z");
    joint(side + "_ankle", "continuous", "0 0 1", side + "_slide_z", foot);
  }
  return text + "</robot>";
}

inline const std::vector<std::string>& walkerJoints() {
  static const std::vector<std::string> names{"left_x",  "left_y",  "left_z",  "left_ankle",
                                              "right_x", "right_y", "right_z", "right_ankle"};
  return names;
}

struct WalkerRow {
  std::array<double, 3> root{};
  std::array<double, 4> xyzw{};
  std::vector<double> joints;
};

/// The pelvis goes on and turns; the feet are where they are planted and keep their heading.
inline WalkerRow walkerRow(double timeS, const Place& left, const Place& right) {
  const double yaw = 0.4 * timeS, c = std::cos(yaw), s = std::sin(yaw);
  WalkerRow row;
  row.root = {0.3 * timeS, 0.05 * std::sin(timeS), 0.8};
  row.xyzw = {0.0, 0.0, std::sin(0.5 * yaw), std::cos(0.5 * yaw)};
  for (const Place& sole : {left, right}) {
    const double x = sole.x - row.root[0], y = -sole.z - row.root[1];
    for (const double value : {c * x + s * y, c * y - s * x, sole.y + kSole - row.root[2], -yaw}) {
      row.joints.push_back(value);
    }
  }
  return row;
}

}  // namespace foretouch::test
