#include "middleware/scene/box_triangles.h"

#include <array>
#include <utility>

namespace foretouch::internal {

RawScene boxTriangles(const Eigen::Vector3d& low, const Eigen::Vector3d& high, std::string name) {
  const auto corner = [&](int i) {
    return Eigen::Vector3d(((i & 1) != 0 ? high : low).x(), ((i & 2) != 0 ? high : low).y(),
                           ((i & 4) != 0 ? high : low).z());
  };
  constexpr std::array<std::array<int, 4>, 6> kSides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  RawScene raw;
  raw.objectNames = {std::move(name)};
  for (const auto& side : kSides) {
    const Eigen::Vector3d first = corner(side[0]), across = corner(side[2]);
    raw.triangles.push_back({{first, corner(side[1]), across}});
    raw.triangles.push_back({{first, across, corner(side[3])}});
  }
  raw.objectOf.assign(raw.triangles.size(), 0);
  return raw;
}

}  // namespace foretouch::internal
