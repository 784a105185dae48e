#include "middleware/scene/scene.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "articulated/skeleton.h"
#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "lss/vertex_order.h"
#include "middleware/scene/scene_parts.h"
#include "middleware/scene/sort_by_hash.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

Result<Done> checked(const RawScene& raw) {
  if (raw.triangles.size() > kMaxTriangles) {
    return Error::of(ErrorCode::LimitExceeded, "expected at most " + std::to_string(kMaxTriangles) +
                                                   " triangles, found " +
                                                   std::to_string(raw.triangles.size()));
  }
  if (raw.objectOf.size() != raw.triangles.size()) {
    return Error::of(ErrorCode::Mismatch, "expected one object index per triangle");
  }
  for (std::size_t i = 0; i < raw.triangles.size(); ++i) {
    const auto index = static_cast<std::int64_t>(i);
    if (raw.objectOf[i] < 0 ||
        static_cast<std::size_t>(raw.objectOf[i]) >= raw.objectNames.size()) {
      return Error::at(index, ErrorCode::OutOfRange,
                       "triangle " + std::to_string(i) + ": expected an object index below " +
                           std::to_string(raw.objectNames.size()));
    }
    for (const Vector3d& vertex : raw.triangles[i].vertices) {
      if (vertex.allFinite() && vertex.cwiseAbs().maxCoeff() > kMaxCoordinate) {
        return Error::at(index, ErrorCode::OutOfRange,
                         "triangle " + std::to_string(i) + ": expected coordinates within 1e7 m");
      }
    }
  }
  return Done{};
}

/// A number that depends only on the triangle's place.
std::uint64_t hashOf(const Triangle& triangle) {
  std::uint64_t hash = 0;
  for (const Vector3d& vertex : triangle.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &vertex[axis], sizeof bits);
      // The finaliser of splitmix64 [Steele14].
      hash += bits + 0x9e3779b97f4a7c15u;
      hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
      hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
      hash ^= hash >> 31;
    }
  }
  return hash;
}

/// The ids in an order that depends on the triangles' vertices alone: the tree, and with it the
/// steps of queries, must not depend on the triangles' order of arrival.
std::vector<TriangleId> inOrderOfGeometry(const std::vector<Triangle>& triangles,
                                          const std::vector<TriangleId>& ids) {
  std::vector<internal::HashedTriangle> keyed;
  keyed.reserve(ids.size());
  for (const TriangleId id : ids) {
    keyed.emplace_back(hashOf(triangles[slotOf(id)]), id);
  }
  internal::sortByHash(keyed, [&](const auto& x, const auto& y) {
    if (x.first != y.first) return x.first < y.first;
    const auto &v = triangles[slotOf(x.second)].vertices, &w = triangles[slotOf(y.second)].vertices;
    if (v != w) {
      return std::lexicographical_compare(v.begin(), v.end(), w.begin(), w.end(),
                                          isBeforeByCoordinates<Vector3d>);
    }
    return x.second < y.second;
  });
  std::vector<TriangleId> ordered;
  ordered.reserve(keyed.size());
  for (const auto& [hash, id] : keyed) ordered.push_back(id);
  return ordered;
}

}  // namespace

Result<Scene> Scene::build(RawScene raw) {
  FORETOUCH_CHECK(checked(raw));
  auto parts = std::make_shared<internal::SceneParts>();
  parts->audit = auditScene(raw);
  if (parts->audit.triangles == 0) {
    return Error::of(ErrorCode::Empty, "expected at least one finite triangle, found none");
  }
  parts->origin = 0.5 * (parts->audit.boxMin + parts->audit.boxMax);
  std::vector<TriangleId> finiteIds;
  for (std::size_t i = 0; i < raw.triangles.size(); ++i) {
    Triangle& triangle = raw.triangles[i];
    if (!isFinite(triangle)) continue;
    std::sort(triangle.vertices.begin(), triangle.vertices.end(), isBeforeByCoordinates<Vector3d>);
    finiteIds.push_back(static_cast<TriangleId>(i));
  }
  FORETOUCH_TRY(parts->bvh, internal::FlatBvh::build(
                                raw.triangles, inOrderOfGeometry(raw.triangles, finiteIds),
                                {parts->audit.boxMin, parts->audit.boxMax}, parts->origin));
  parts->triangles = internal::FrozenArray<Triangle>(std::move(raw.triangles));
  parts->objectOf = internal::FrozenArray<ObjectId>(std::move(raw.objectOf));
  parts->objectNames = std::move(raw.objectNames);
  return Scene(std::move(parts));
}

std::size_t Scene::numTriangles() const {
  return parts_->triangles.size();
}

const Triangle& Scene::triangle(TriangleId id) const {
  FORETOUCH_ASSERT(id >= 0 && slotOf(id) < parts_->triangles.size());
  return parts_->triangles[slotOf(id)];
}

ObjectId Scene::object(TriangleId id) const {
  FORETOUCH_ASSERT(id >= 0 && slotOf(id) < parts_->objectOf.size());
  return parts_->objectOf[slotOf(id)];
}

const std::vector<std::string>& Scene::objectNames() const {
  return parts_->objectNames;
}

const SceneAudit& Scene::audit() const {
  return parts_->audit;
}

std::vector<TriangleId> internal::SceneParts::finiteIds() const {
  std::vector<TriangleId> ids;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (isFinite(triangles[i])) ids.push_back(static_cast<TriangleId>(i));
  }
  return ids;
}

const internal::FlatEdges& internal::SceneParts::flatEdges() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (flatEdges_ == nullptr) flatEdges_ = std::make_unique<FlatEdges>(triangles, finiteIds());
  return *flatEdges_;
}

const std::vector<internal::ObjectRoom>& internal::SceneParts::rooms() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (rooms_ == nullptr) {
    rooms_ = std::make_unique<std::vector<ObjectRoom>>(
        objectRooms(triangles.data(), finiteIds(), objectOf.data(), objectNames.size()));
  }
  return *rooms_;
}

}  // namespace foretouch
