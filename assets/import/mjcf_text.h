// assets/import/mjcf_text.h: a MuJoCo model (MJCF) reduced to what a robot's shape and joints need,
// as one text for libmujoco, which then reads no file that we have not looked at. In
// foretouch-import only. Not installed.
#pragma once

#include <string>
#include <vector>

#include "assets/import/model.h"

namespace foretouch::internal {

struct MjcfText {
  /// Element by element, one per line; files of meshes have absolute paths.
  std::string xml;
  struct Place {
    std::size_t file = 0;
    int line = 0;
  };
  std::vector<Place> placeOfLine;  ///< Per line of `xml`.
  std::vector<std::string> files;  ///< The model, then what it includes, as it names them.
  std::vector<std::string> notes;

  /// libmujoco's report about `xml` in one sentence, with the place in the files.
  [[nodiscard]] std::string placed(const std::string& report) const;
};

/// Is the file MJCF: named .mjcf, or named .xml with <mujoco> as its first element?
[[nodiscard]] bool isMjcf(const std::string& path);

/// Puts what is included in its place. Keeps bodies with their joints and geoms, meshes, defaults,
/// contacts and equalities of joints; drops what has no part in shape and joints (actuators,
/// sensors, materials, ...), and what lies in the world itself, with a note. Throws Failure
/// (assets/import/failure.h) for what is not MJCF, for plugins, composites and height fields on
/// bodies, for files that are missing or must not be read, and beyond the limits of a robot.
[[nodiscard]] MjcfText readMjcfText(const ModelQuestion& question);

}  // namespace foretouch::internal
