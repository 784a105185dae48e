#include "tests/tools/setup/rooms.h"

#include <random>

#include "tests/tools/setup/hand_made_level.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// Draws a room: sizes in metres, its middle at the origin, its floor at `ground`.
struct Builder {
  explicit Builder(unsigned seed) : random(seed) {
    width = between(7.0, 12.0);
    depth = between(6.0, 10.0);
    height = between(2.6, 3.4);
    ground = between(-1.0, 1.0);
  }

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }

  /// A solid block, its front outside.
  void block(const Vector3d& from, const Vector3d& to, const std::string& name) {
    const Vector3d size = to - from, x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
    addRectangle(scene, from, x, z, name);      // below
    addRectangle(scene, from + y, z, x, name);  // above
    addRectangle(scene, from, y, x, name);
    addRectangle(scene, from + z, x, y, name);
    addRectangle(scene, from, z, y, name);
    addRectangle(scene, from + x, y, z, name);
  }

  /// Four walls 0.1 m thick around the floor.
  void walls() {
    const double x = 0.5 * width, z = 0.5 * depth, t = 0.1;
    block({-x - t, ground, -z - t}, {x + t, ground + height, -z}, "wall");
    block({-x - t, ground, z}, {x + t, ground + height, z + t}, "wall");
    block({-x - t, ground, -z}, {-x, ground + height, z}, "wall");
    block({x, ground, -z}, {x + t, ground + height, z}, "wall");
  }
  void floorSlab() {
    block({-0.5 * width, ground - 0.2, -0.5 * depth}, {0.5 * width, ground, 0.5 * depth}, "floor");
  }
  void roofSlab(double overhang) {
    block({-0.5 * width - overhang, ground + height, -0.5 * depth - overhang},
          {0.5 * width + overhang, ground + height + 0.25, 0.5 * depth + overhang}, "roof");
  }
  /// Surfaces without thickness, their front inside.
  void sheets(bool isFloorTurned = false) {
    const double x = 0.5 * width, z = 0.5 * depth;
    const Vector3d alongX(2 * x, 0, 0), alongZ(0, 0, 2 * z), up(0, height, 0);
    const Vector3d corner(-x, ground, -z);
    addRectangle(scene, corner, isFloorTurned ? alongX : alongZ, isFloorTurned ? alongZ : alongX,
                 "floor");
    addRectangle(scene, corner + up, alongX, alongZ, "ceiling");
    addRectangle(scene, corner, alongX, up, "wall");
    addRectangle(scene, corner + alongZ, up, alongX, "wall");
    addRectangle(scene, corner, up, alongZ, "wall");
    addRectangle(scene, corner + alongX, alongZ, up, "wall");
  }
  [[nodiscard]] Walkable wholeFloor() const {
    return {-0.5 * width, 0.5 * width, -0.5 * depth, 0.5 * depth, ground};
  }
  /// A table with four legs.
  void table(double x, double z) {
    const double y = ground;
    block({x - 0.7, y + 0.7, z - 0.4}, {x + 0.7, y + 0.75, z + 0.4}, "table");
    for (const double dx : {-0.65, 0.6}) {
      for (const double dz : {-0.35, 0.3}) {
        block({x + dx, y, z + dz}, {x + dx + 0.05, y + 0.7, z + dz + 0.05}, "leg");
      }
    }
  }

  std::mt19937 random;
  double width, depth, height, ground;
  RawScene scene;
};

/// Stands still, walks 1.5 m, or walks around a corner.
std::vector<Vector3d> shortWalk(unsigned seed) {
  std::vector<Vector3d> moves;
  const std::size_t steps = seed % 3 == 0 ? 1 : 16;
  for (std::size_t i = 0; i < steps; ++i) {
    const double way = 0.1 * static_cast<double>(i);
    moves.emplace_back(seed % 3 == 1 ? way : std::min(way, 0.7), 0.0,
                       seed % 3 == 1 ? 0.0 : std::max(way - 0.7, 0.0));
  }
  return moves;
}

void beams(Builder& b, double y) {
  for (double x = -0.4 * b.width; x < 0.45 * b.width; x += 0.2 * b.width) {
    b.block({x, y, -0.5 * b.depth}, {x + 0.4, y + 0.3, 0.5 * b.depth}, "beam");
  }
}

/// Fifteen steps along one wall, up to a floor over half the room.
void stairsAndMezzanine(Builder& b, bool withStairs) {
  const double top = b.ground + 2.7, x = 0.5 * b.width, z = 0.5 * b.depth;
  b.block({-x, top - 0.2, 0.0}, {x, top, z}, "mezzanine");
  if (!withStairs) return;
  for (int i = 0; i < 15; ++i) {
    const double from = -4.2 + 0.28 * i;
    b.block({-x, b.ground, from}, {-x + 1.2, b.ground + 0.18 * (i + 1), from + 0.28}, "step");
  }
}

}  // namespace

Room roomOfKind(std::size_t kind, unsigned seed) {
  Builder b(static_cast<unsigned>(kind) * 1000 + seed);
  Room room;
  room.moves = shortWalk(seed);
  room.walkable = {b.wholeFloor()};
  switch (kind) {
    case 0:
      room.name = "an empty room of sheets";
      b.sheets();
      break;
    case 1:
      room.name = "a house with a wide roof, and no ground around it";
      b.floorSlab(), b.walls(), b.roofSlab(0.6);
      break;
    case 2:
      room.name = "a studio: beams above, and no ceiling";
      b.height = b.between(4.5, 6.0);
      b.floorSlab(), b.walls(), beams(b, b.ground + b.height - 0.5);
      break;
    case 3:
      room.name = "shelves on the walls";
      b.sheets();
      for (const double y : {0.3, 0.8, 1.3}) {
        b.block({-0.5 * b.width, b.ground + y, -0.5 * b.depth},
                {0.5 * b.width, b.ground + y + 0.03, -0.5 * b.depth + 0.5}, "shelf");
      }
      room.walkable[0].minZ += 0.5;
      break;
    case 4:
      room.name = "stairs to a mezzanine";
      b.depth = std::max(b.depth, 9.0), b.height = 5.4;
      b.floorSlab(), b.walls(), b.roofSlab(0.0), stairsAndMezzanine(b, true);
      room.walkable = {b.wholeFloor(), b.wholeFloor()};
      room.walkable[1].minZ = 0.0, room.walkable[1].y = b.ground + 2.7;
      break;
    case 5:
      room.name = "a mezzanine out of reach";
      b.height = 5.4;
      b.floorSlab(), b.walls(), stairsAndMezzanine(b, false);
      break;
    case 6: {
      room.name = "two rooms, and a door too low";
      b.floorSlab(), b.walls(), b.roofSlab(0.2);
      const double x = 0.15 * b.width, t = 0.1, z = 0.5 * b.depth, top = b.ground + b.height;
      b.block({x, b.ground, -z}, {x + t, top, -0.5}, "partition");
      b.block({x, b.ground, 0.5}, {x + t, top, z}, "partition");
      b.block({x, b.ground + 1.2, -0.5}, {x + t, top, 0.5}, "partition");
      room.walkable[0].maxX = x;
      break;
    }
    case 7: {
      room.name = "open ground around a shed";
      b.block({-15, b.ground - 0.5, -15}, {15, b.ground, 15}, "ground");
      b.block({-3, b.ground, -3}, {3, b.ground + 3, 3}, "shed");
      room.walkable = {{-15, 15, -15, -3, b.ground},
                       {-15, 15, 3, 15, b.ground},
                       {-15, -3, -15, 15, b.ground},
                       {3, 15, -15, 15, b.ground}};
      break;
    }
    case 8:
      room.name = "walls alone";
      b.walls();
      room.walkable.clear();
      break;
    case 9:
      room.name = "a sign on two posts over no floor";
      b.block({-2, b.ground + 2.2, -0.05}, {2, b.ground + 2.8, 0.05}, "sign");
      b.block({-2, b.ground, -0.05}, {-1.9, b.ground + 2.2, 0.05}, "post");
      b.block({1.9, b.ground, -0.05}, {2, b.ground + 2.2, 0.05}, "post");
      room.walkable.clear();
      break;
    case 10:
      room.name = "a room lower than the body";
      b.width = 1.3, b.depth = 1.2, b.height = 0.9;
      b.floorSlab(), b.walls(), b.roofSlab(0.1);
      room.walkable.clear();
      break;
    case 11:
      room.name = "pillars, tables and a bed";
      b.sheets();
      b.table(b.between(-2, 2), b.between(-1.5, 1.5));
      b.block({-0.5 * b.width, b.ground, 0.5 * b.depth - 2},
              {-0.5 * b.width + 1.6, b.ground + 0.5, 0.5 * b.depth}, "bed");
      for (const double x : {-0.3, 0.3}) {
        b.block({x * b.width, b.ground, -0.3 * b.depth},
                {x * b.width + 0.4, b.ground + b.height, -0.3 * b.depth + 0.4}, "pillar");
      }
      break;
    case 12: {
      room.name = "a long walk, and a small room above";
      b.width = 9.0;
      room.walkable = {b.wholeFloor()};
      b.floorSlab(), b.walls(), b.roofSlab(0.0);
      b.block({-1.5, b.ground + b.height + 0.25, -1.5}, {1.5, b.ground + b.height + 0.5, 1.5},
              "lantern");
      room.moves.clear();
      for (int i = 0; i < 40; ++i) room.moves.emplace_back(0.17 * i, 0.0, 0.0);
      break;
    }
    case 13:
      room.name = "a room whose floor is turned over";
      b.sheets(true);
      room.mayAsk = true;
      break;
    case 14:
      room.name = "walls and a roof over no floor";
      b.walls(), b.roofSlab(0.3);
      room.walkable.clear();
      break;
    default: break;
  }
  room.scene = std::move(b.scene);
  return room;
}

}  // namespace foretouch::test
