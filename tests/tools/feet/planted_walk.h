// tests/tools/feet/planted_walk.h: a walk whose feet are where the test puts them: the truth about
// slides and depths by plain arithmetic. Metres, seconds, +Y up, the floor at y = 0.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace foretouch::test {

/// Soles are this far below the ankles (m).
inline constexpr double kSole = 0.08;

/// Two feet with heel, ball and toes, whose soles are level; and hips far above them.
inline constexpr char kWalkerAvatar[] =
    R"({"format":"foretouch-avatar","version":1,"links":[
{"name":"Hips","parent":null,"offset":[0,0,0],"lss":[{"a":[0,0,0],"b":[0,0.5,0],"radius":0.1}]},
{"name":"LeftFoot","parent":"Hips","offset":[0,0,0],
 "lss":[{"a":[0,-0.05,-0.05],"b":[0,-0.05,0.12],"radius":0.03}]},
{"name":"LeftToeBase","parent":"LeftFoot","offset":[0,-0.06,0.15],
 "lss":[{"a":[0,0,0],"b":[0,0,0.05],"radius":0.02}]},
{"name":"RightFoot","parent":"Hips","offset":[0,0,0],
 "lss":[{"a":[0,-0.05,-0.05],"b":[0,-0.05,0.12],"radius":0.03}]},
{"name":"RightToeBase","parent":"RightFoot","offset":[0,-0.06,0.15],
 "lss":[{"a":[0,0,0],"b":[0,0,0.05],"radius":0.02}]}
]})";

struct Place {
  double x = 0.0, y = 0.0, z = 0.0;
};

/// One stance of a foot, as it is planted: it comes down at `from`, moves on a straight line, and
/// leaves.
struct PlantedStance {
  Place from, to;  ///< Of the sole; y is its height above the floor, below 0: sunk.
  double beginS = 0.0, endS = 0.0;

  [[nodiscard]] double slide() const { return std::hypot(to.x - from.x, to.z - from.z); }
};

/// From 0 to 1, with no speed at both ends.
inline double eased(double share) {
  const double s = std::fmin(1.0, std::fmax(0.0, share));
  return s * s * (3.0 - 2.0 * s);
}

/// A foot that stands, and steps from stance to stance in an arc 0.12 m high.
struct PlantedFoot {
  std::vector<PlantedStance> stances;

  [[nodiscard]] Place soleAt(double timeS) const {
    std::size_t i = 0;
    while (i + 1 < stances.size() && timeS >= stances[i + 1].beginS) ++i;
    const PlantedStance& now = stances[i];
    if (timeS <= now.endS || i + 1 == stances.size()) {
      // Slides in the middle half of the stance.
      const double length = now.endS - now.beginS;
      return between(now.from, now.to, eased((timeS - now.beginS) / length * 2.0 - 0.5));
    }
    const PlantedStance& next = stances[i + 1];
    const double share = (timeS - now.endS) / (next.beginS - now.endS);
    Place place = between(now.to, next.from, eased(share));
    const double arc = std::sin(3.14159265358979323846 * share);
    place.y += 0.12 * arc * arc;
    return place;
  }

  static Place between(const Place& a, const Place& b, double share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
  }
};

/// Root and feet as text: the hips' position and rotation, and each ankle's position in their
/// frame.
inline std::string walkBvh(const std::vector<Place>& left, const std::vector<Place>& right,
                           double frameTimeS, const std::string& root = "0 0 0 0 0 0") {
  const auto foot = [](const char* side) {
    const std::string name = side;
    return "  JOINT " + name +
           "Foot\n  {\n    OFFSET 0 0 0\n    CHANNELS 3 Xposition Yposition Zposition\n"
           "    JOINT " +
           name +
           "ToeBase\n    {\n      OFFSET 0 -0.06 0.15\n      CHANNELS 3 Zrotation Xrotation "
           "Yrotation\n      End Site\n      {\n        OFFSET 0 0 0.07\n      }\n    }\n  }\n";
  };
  std::string text =
      "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n"
      "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n" +
      foot("Left") + foot("Right") + "}\nMOTION\nFrames: " + std::to_string(left.size()) + "\n";
  char line[256];
  std::snprintf(line, sizeof line, "Frame Time: %.9f\n", frameTimeS);
  text += line;
  for (std::size_t i = 0; i < left.size(); ++i) {
    std::snprintf(line, sizeof line, " %.9f %.9f %.9f 0 0 0 %.9f %.9f %.9f 0 0 0\n", left[i].x,
                  left[i].y + kSole, left[i].z, right[i].x, right[i].y + kSole, right[i].z);
    text += root + line;
  }
  return text;
}

}  // namespace foretouch::test
