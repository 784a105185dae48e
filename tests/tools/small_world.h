// tests/tools/small_world.h: a scene, an avatar and a clip small enough to compute by hand.
#pragma once

#include <string>
#include <vector>

#include "tests/support/temp_folder.h"

namespace foretouch::test {

/// Two triangles without thickness in the plane x = 0, object "wall", and a floor at y = -5.
inline constexpr char kWallObj[] =
    "o wall\n"
    "v 0 -2 -2\nv 0 2 -2\nv 0 2 2\nv 0 -2 2\nf 1 2 3\nf 1 3 4\n"
    "o floor\n"
    "v -9 -5 -9\nv 9 -5 -9\nv 9 -5 9\nv -9 -5 9\nf 5 6 7\nf 5 7 8\n";

/// A sphere of radius 0.1 at the hips and an arm of radius 0.05 straight up from 0.3 m above them.
inline constexpr char kManAvatar[] =
    R"({"format":"foretouch-avatar","version":1,"links":[
{"name":"Hips","parent":null,"offset":[0,0,0],"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}]},
{"name":"Arm","parent":"Hips","offset":[0,0.3,0],"lss":[{"a":[0,0,0],"b":[0,0.5,0],"radius":0.05}]}
]})";

/// A clip of that avatar: ten frames per second, the hips at the given places along x, nothing
/// turns.
inline std::string clipAlongX(const std::vector<double>& places, double frameTimeS = 0.1) {
  std::string text =
      "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n"
      "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
      "  JOINT Arm\n  {\n    OFFSET 0 0.3 0\n    CHANNELS 3 Zrotation Xrotation Yrotation\n"
      "    End Site\n    {\n      OFFSET 0 0.5 0\n    }\n  }\n}\nMOTION\n";
  text += "Frames: " + std::to_string(places.size()) +
          "\nFrame Time: " + std::to_string(frameTimeS) + "\n";
  for (const double x : places) text += std::to_string(x) + " 0 0 0 0 0 0 0 0\n";
  return text;
}

/// The hips jump from half a metre before the wall to half a metre behind it in step 1.
inline std::string clipThroughWall() {
  return clipAlongX({-0.75, -0.25, 0.25, 0.75});
}

/// The files in a folder, and the arguments that replay them.
class SmallWorld {
 public:
  SmallWorld() {
    folder.write("wall.obj", kWallObj);
    folder.write("man.json", kManAvatar);
    folder.write("clip.bvh", clipThroughWall());
  }

  /// `replay` with the folder's files, and further arguments.
  [[nodiscard]] std::vector<std::string> replay(const std::vector<std::string>& more = {},
                                                const std::string& scene = "wall.obj",
                                                const std::string& avatar = "man.json",
                                                const std::string& clip = "clip.bvh") const {
    std::vector<std::string> arguments{"replay",        "--scene",  folder / scene, "--avatar",
                                       folder / avatar, "--motion", folder / clip};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  TempFolder folder;
};

}  // namespace foretouch::test
