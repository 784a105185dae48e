// tests/tools/inputs/arms_bvh.h: a clip that begins in a T-pose.
#pragma once

#include <string>

namespace foretouch::test {

/// Arms of two bones; `tFrames` of them held out, then hanging.
inline std::string armsBvh(int tFrames, int frames) {
  const auto arm = [](const std::string& side, double x) {
    const std::string out = std::to_string(x);
    return "  JOINT " + side + "Arm\n  {\n    OFFSET " + out +
           " 0.5 0\n    CHANNELS 3 Zrotation Xrotation Yrotation\n    JOINT " + side +
           "ForeArm\n    {\n      OFFSET " + out +
           " 0 0\n      CHANNELS 3 Zrotation Xrotation Yrotation\n      JOINT " + side +
           "Hand\n      {\n        OFFSET " + out +
           " 0 0\n        CHANNELS 3 Zrotation Xrotation Yrotation\n        End Site\n        {\n"
           "          OFFSET " +
           out + " 0 0\n        }\n      }\n    }\n  }\n";
  };
  std::string text =
      "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n"
      "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n" +
      arm("Left", 0.3) + arm("Right", -0.3) + "}\nMOTION\nFrames: " + std::to_string(frames) +
      "\nFrame Time: 0.01\n";
  for (int frame = 0; frame < frames; ++frame) {
    const std::string hang = frame < tFrames ? "0" : "80";
    text += "0 1 0 0 0 0 -" + hang + " 0 0 0 0 0 0 0 0 " + hang + " 0 0 0 0 0 0 0 0\n";
  }
  return text;
}

}  // namespace foretouch::test
