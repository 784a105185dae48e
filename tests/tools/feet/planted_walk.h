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
  double pitchDeg = 0.0;  ///< By so much the foot is turned about its toe joint, heel up.
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
  double heelOffDeg = 0.0;  ///< At each stance's end it has rolled so far over its toes.

  [[nodiscard]] Place soleAt(double timeS) const {
    std::size_t i = 0;
    while (i + 1 < stances.size() && timeS >= stances[i + 1].beginS) ++i;
    const PlantedStance& now = stances[i];
    if (timeS <= now.endS || i + 1 == stances.size()) {
      // Slides in the middle half of the stance.
      const double length = now.endS - now.beginS;
      Place place = between(now.from, now.to, eased((timeS - now.beginS) / length * 2.0 - 0.5));
      const bool isLast = i + 1 == stances.size();
      if (!isLast) place.pitchDeg = heelOffDeg * eased((timeS - now.endS + 0.2) / 0.2);
      return place;
    }
    const PlantedStance& next = stances[i + 1];
    const double share = (timeS - now.endS) / (next.beginS - now.endS);
    Place place = between(now.to, next.from, eased(share));
    const double arc = std::sin(3.14159265358979323846 * share);
    place.y += 0.12 * arc * arc;
    place.pitchDeg = heelOffDeg * (1.0 - eased(2.0 * share));
    return place;
  }

  static Place between(const Place& a, const Place& b, double share) {
    return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
  }
};

/// The row of a foot: its ankle, in the hips' frame, and how far it and its toes are turned.
inline std::string footRow(const Place& sole) {
  // The toe joint stays where it is; the ankle turns about it.
  constexpr double kToeY = 0.06, kToeZ = 0.15;
  const double turn = sole.pitchDeg * 3.14159265358979323846 / 180.0;
  const double y = kToeY * std::cos(turn) + kToeZ * std::sin(turn);
  const double z = kToeY * std::sin(turn) - kToeZ * std::cos(turn);
  char row[256];
  std::snprintf(row, sizeof row, " %.9f %.9f %.9f 0 %.9f 0 0 %.9f 0", sole.x,
                sole.y + kSole - kToeY + y, sole.z + kToeZ + z, sole.pitchDeg, -sole.pitchDeg);
  return row;
}

/// Root and feet as text: the hips' position and rotation, and each foot's.
inline std::string walkBvh(const std::vector<Place>& left, const std::vector<Place>& right,
                           double frameTimeS) {
  const auto foot = [](const char* side) {
    const std::string name = side;
    return "  JOINT " + name +
           "Foot\n  {\n    OFFSET 0 0 0\n    CHANNELS 6 Xposition Yposition Zposition Zrotation "
           "Xrotation Yrotation\n    JOINT " +
           name +
           "ToeBase\n    {\n      OFFSET 0 -0.06 0.15\n      CHANNELS 3 Zrotation Xrotation "
           "Yrotation\n      End Site\n      {\n        OFFSET 0 0 0.07\n      }\n    }\n  }\n";
  };
  std::string text =
      "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n"
      "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n" +
      foot("Left") + foot("Right") + "}\nMOTION\nFrames: " + std::to_string(left.size()) + "\n";
  char line[64];
  std::snprintf(line, sizeof line, "Frame Time: %.9f\n", frameTimeS);
  text += line;
  for (std::size_t i = 0; i < left.size(); ++i) {
    text += "0 0 0 0 0 0" + footRow(left[i]) + footRow(right[i]) + "\n";
  }
  return text;
}

}  // namespace foretouch::test
