#include "articulated/raw_skeleton.h"
#include "network/wire/hashed_bytes.h"
#include "network/world_stream/world_setup.h"

namespace foretouch {
namespace {

/// 0 says that a sender does not know.
std::int64_t neverZero(std::int64_t hash) {
  return hash == 0 ? 1 : hash;
}

void addLinks(const Avatar& avatar, HashedBytes& bytes) {
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const std::vector<Lss>& volumes = avatar.lss(link);
    bytes.add(static_cast<std::uint64_t>(volumes.size()));
    for (const Lss& lss : volumes) {
      bytes.add(lss.a);
      bytes.add(lss.b);
      bytes.add(lss.radius);
    }
  }
}

}  // namespace

std::int64_t shapeHash(const WorldShape& shape) {
  HashedBytes bytes;
  if (shape.avatar) {
    // A rigid prop's only joint has the prop's name, which says nothing of its shape.
    const bool isProp = shape.avatar->numLinks() == 1;
    bytes.add(static_cast<std::uint64_t>(
        isProp ? 0 : skeletonHash(rawSkeleton(shape.avatar->skeleton()))));
    addLinks(*shape.avatar, bytes);
    return neverZero(bytes.hash());
  }
  bytes.add(static_cast<std::uint64_t>(shape.mesh->numTriangles()));
  for (std::size_t i = 0; i < shape.mesh->numTriangles(); ++i) {
    const Triangle& triangle = shape.mesh->triangle(static_cast<TriangleId>(i));
    for (const Eigen::Vector3d& vertex : triangle.vertices) bytes.add(vertex);
  }
  return neverZero(bytes.hash());
}

}  // namespace foretouch
