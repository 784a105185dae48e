// tests/tools/setup/rooms.h: rooms in which one knows, by how they are built, where a person would
// stand.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "middleware/scene/raw_scene.h"

namespace foretouch::test {

/// A level rectangle on which a person could stand and walk.
struct Walkable {
  double minX, maxX, minZ, maxZ, y;
};

struct Room {
  std::string name;
  RawScene scene;
  std::vector<Walkable> walkable;      ///< None: nobody would stand here.
  std::vector<Eigen::Vector3d> moves;  ///< The clip: where the body goes.
  /// Which side of the surfaces is the front is wrong in this file: a question is as good as a
  /// place.
  bool mayAsk = false;
};

inline constexpr std::size_t kRoomKinds = 15;

/// `seed`: sizes, and where things are.
[[nodiscard]] Room roomOfKind(std::size_t kind, unsigned seed);

}  // namespace foretouch::test
