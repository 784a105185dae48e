// tests/tools/repair/legged_walk.h: a person whose feet are where the test puts them and whose left
// arm turns as the test says, as a BVH clip: legs by plain trigonometry. Metres, seconds, +Y up,
// the floor at y = 0.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "tests/tools/feet/planted_walk.h"

namespace foretouch::test {

inline constexpr char kLeggedAvatar[] =
    R"({"format":"foretouch-avatar","version":1,"links":[
{"name":"Hips","parent":null,"offset":[0,0,0],"lss":[{"a":[0,0.05,0],"b":[0,0.45,0],"radius":0.1}]},
{"name":"LeftArm","parent":"Hips","offset":[0.2,0.45,0],
 "lss":[{"a":[0,-0.03,0],"b":[0,-0.25,0],"radius":0.04}]},
{"name":"LeftForeArm","parent":"LeftArm","offset":[0,-0.28,0],
 "lss":[{"a":[0,-0.02,0],"b":[0,-0.22,0],"radius":0.03}]},
{"name":"LeftHand","parent":"LeftForeArm","offset":[0,-0.25,0],
 "lss":[{"a":[0,-0.02,0],"b":[0,-0.12,0],"radius":0.025}]},
{"name":"LeftUpLeg","parent":"Hips","offset":[0.1,-0.05,0],
 "lss":[{"a":[0,-0.05,0],"b":[0,-0.42,0],"radius":0.06}]},
{"name":"LeftLeg","parent":"LeftUpLeg","offset":[0,-0.42,0],
 "lss":[{"a":[0,-0.05,0],"b":[0,-0.38,0],"radius":0.04}]},
{"name":"LeftFoot","parent":"LeftLeg","offset":[0,-0.42,0],
 "lss":[{"a":[0,-0.05,-0.05],"b":[0,-0.05,0.12],"radius":0.03}]},
{"name":"LeftToeBase","parent":"LeftFoot","offset":[0,-0.06,0.15],
 "lss":[{"a":[0,0,0],"b":[0,0,0.05],"radius":0.02}]},
{"name":"RightUpLeg","parent":"Hips","offset":[-0.1,-0.05,0],
 "lss":[{"a":[0,-0.05,0],"b":[0,-0.42,0],"radius":0.06}]},
{"name":"RightLeg","parent":"RightUpLeg","offset":[0,-0.42,0],
 "lss":[{"a":[0,-0.05,0],"b":[0,-0.38,0],"radius":0.04}]},
{"name":"RightFoot","parent":"RightLeg","offset":[0,-0.42,0],
 "lss":[{"a":[0,-0.05,-0.05],"b":[0,-0.05,0.12],"radius":0.03}]},
{"name":"RightToeBase","parent":"RightFoot","offset":[0,-0.06,0.15],
 "lss":[{"a":[0,0,0],"b":[0,0,0.05],"radius":0.02}]}
]})";

/// Turns of the arm about z, then x, and of the forearm about x (degrees).
struct ArmTurn {
  double z = 0.0, x = 0.0, elbow = 0.0;
};

class LeggedWalk {
 public:
  PlantedFoot left, right;
  std::function<ArmTurn(double timeS)> arm = [](double) { return ArmTurn{}; };
  double durationS = 2.0, hz = 100.0;

  [[nodiscard]] std::string bvh() const {
    std::string text =
        "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n  CHANNELS 6 Xposition Yposition "
        "Zposition Zrotation Xrotation Yrotation\n";
    text +=
        chain({{"LeftArm", "0.2 0.45 0"}, {"LeftForeArm", "0 -0.28 0"}, {"LeftHand", "0 -0.25 0"}},
              "0 -0.15 0");
    for (const char* const side : {"Left", "Right"}) {
      const std::string name = side;
      text += chain({{name + "UpLeg", name == "Left" ? "0.1 -0.05 0" : "-0.1 -0.05 0"},
                     {name + "Leg", "0 -0.42 0"},
                     {name + "Foot", "0 -0.42 0"},
                     {name + "ToeBase", "0 -0.06 0.15"}},
                    "0 0 0.07");
    }
    const int frames = static_cast<int>(std::lround(durationS * hz)) + 1;
    char line[96];
    std::snprintf(line, sizeof line, "}\nMOTION\nFrames: %d\nFrame Time: %.9f\n", frames, 1.0 / hz);
    text += line;
    for (int i = 0; i < frames; ++i) text += row(i / hz);
    return text;
  }

 private:
  struct Bone {
    std::string name, offset;
  };
  static std::string chain(const std::vector<Bone>& bones, const std::string& end) {
    std::string text, closing;
    for (const Bone& bone : bones) {
      text += "JOINT " + bone.name + "\n{\nOFFSET " + bone.offset +
              "\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
      closing += "}\n";
    }
    return text + "End Site\n{\nOFFSET " + end + "\n}\n" + closing;
  }

  [[nodiscard]] std::string row(double timeS) const {
    constexpr double kHips = 0.85;  // above the floor: low enough for the longest step
    const Place l = left.soleAt(timeS), r = right.soleAt(timeS);
    const double z = 0.5 * (l.z + r.z);
    const ArmTurn turn = arm(timeS);
    std::string text;
    const auto add = [&](std::initializer_list<double> numbers) {
      char word[32];
      for (const double number : numbers) {
        std::snprintf(word, sizeof word, text.empty() ? "%.6f" : " %.6f", number);
        text += word;
      }
    };
    add({0, kHips, z, 0, 0, 0, turn.z, turn.x, 0, 0, turn.elbow, 0, 0, 0, 0});
    for (const bool isLeft : {true, false}) {
      const Place& sole = isLeft ? l : r;
      const double x = isLeft ? 0.1 : -0.1;
      addLeg({sole.x - x, sole.y + kSole - (kHips - 0.05), sole.z - z}, add);
    }
    return text + "\n";
  }

  /// From the hip to the ankle; the foot stays level.
  template <typename Add>
  static void addLeg(const std::array<double, 3>& way, const Add& add) {
    constexpr double kBone = 0.42, kDegrees = 180.0 / 3.14159265358979323846;
    const double length = std::hypot(std::hypot(way[0], way[1]), way[2]);
    const double bend = 2.0 * std::acos(std::fmin(1.0, length / (2.0 * kBone)));
    const double aside = std::atan2(way[0], -way[1]);
    const double hip = -std::atan2(way[2], std::hypot(way[0], way[1])) - 0.5 * bend;
    // The foot undoes Rz(aside) Rx(hip + bend), as Rz Rx Ry.
    const double a = -(hip + bend), c = std::cos(a), s = std::sin(a);
    const double cz = std::cos(-aside), sz = std::sin(-aside);
    add({kDegrees * aside, kDegrees * hip, 0, 0, kDegrees * bend, 0,
         kDegrees * std::atan2(sz, c * cz), kDegrees * std::asin(s * cz),
         kDegrees * std::atan2(-s * sz, c), 0, 0, 0});
  }
};

}  // namespace foretouch::test
