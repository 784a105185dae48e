#include "assets/import/urdf_surface.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "assets/import/failure.h"
#include "assets/import/placed_meshes.h"
#include "assets/import/side_files.h"
#include "assets/import/text.h"
#include "lss/index.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

double checkedLength(double length, const std::string& link) {
  if (!(length >= 0.0 && length <= kMaxCoordinate)) {
    throw Failure{ImportFailure::Refused, "link " + quotedName(link) +
                                              ": expected a size from 0 to " +
                                              std::to_string(static_cast<long>(kMaxCoordinate)) +
                                              " m, found " + std::to_string(length)};
  }
  return length;
}

/// All placements of a file's meshes in the file's own frame, in metres.
FlatMesh flatten(const PlacedMeshes& placed) {
  FlatMesh flat;
  for (const PlacedMeshes::Placement& placement : placed.placements) {
    const PlacedMeshes::Mesh& mesh = placed.meshes[placement.mesh];
    ModelSize size;
    size.vertices = flat.vertices.size() + mesh.vertices.size();
    size.triangles = flat.triangles.size() + mesh.triangles.size();
    if (const std::string excess = size.excess(); !excess.empty()) {
      throw Failure{ImportFailure::TooLarge, excess};
    }
    const auto first = static_cast<std::int32_t>(flat.vertices.size());
    for (const Vector3d& vertex : mesh.vertices) {
      flat.vertices.push_back(placement.toFile * vertex);
    }
    for (const CornerTriple& t : mesh.triangles) {
      flat.triangles.push_back({first + static_cast<std::int32_t>(t[0]),
                                first + static_cast<std::int32_t>(t[1]),
                                first + static_cast<std::int32_t>(t[2])});
    }
  }
  return flat;
}

bool startsWith(const std::string& text, std::string_view start) {
  return text.compare(0, start.size(), start) == 0;
}

std::string ifFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) ? path.lexically_normal().string() : "";
}

}  // namespace

Affine affineOf(const urdf::Pose& pose, const std::string& owner) {
  const urdf::Rotation& r = pose.rotation;
  const Quaternion q(r.w, r.x, r.y, r.z);
  const Vector3d p(pose.position.x, pose.position.y, pose.position.z);
  const double norm = q.norm();
  if (!(norm > 0.0) || !std::isfinite(norm) || !(p.cwiseAbs().maxCoeff() <= kMaxCoordinate) ||
      !p.allFinite()) {
    throw Failure{ImportFailure::Refused, "the origin of " + owner + " is not finite, or beyond " +
                                              std::to_string(static_cast<long>(kMaxCoordinate)) +
                                              " m"};
  }
  return {q.normalized().toRotationMatrix(), p};
}

void UrdfSurface::add(const urdf::Link& link, std::int32_t node) {
  const UrdfShapeKind kind = question_.visual ? UrdfShapeKind::Visual : UrdfShapeKind::Collision;
  const UrdfShapeKind other = question_.visual ? UrdfShapeKind::Collision : UrdfShapeKind::Visual;
  const auto wanted = shapesOf(link, kind), instead = shapesOf(link, other);
  if (addAll(wanted, link.name, node) > 0) return;
  if (instead.empty() || addAll(instead, link.name, node) == 0) return;
  builder_.note("link " + quotedName(link.name) + " has no usable " +
                (question_.visual ? "visual shapes: its collision shapes stand in"
                                  : "collision shapes: its visual shapes stand in"));
}

std::vector<UrdfSurface::Shape> UrdfSurface::shapesOf(const urdf::Link& link,
                                                      UrdfShapeKind kind) const {
  std::vector<Shape> shapes;
  const auto addFrom = [&](const auto& from) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      shapes.push_back({from[i]->geometry.get(),
                        affineOf(from[i]->origin, "a shape of link " + quotedName(link.name)),
                        from[i]->name, text_.capsules.count({link.name, kind, i}) != 0});
    }
  };
  if (kind == UrdfShapeKind::Visual) {
    addFrom(link.visual_array);
  } else {
    addFrom(link.collision_array);
  }
  return shapes;
}

int UrdfSurface::addAll(const std::vector<Shape>& shapes, const std::string& link,
                        std::int32_t node) {
  return static_cast<int>(std::count_if(shapes.begin(), shapes.end(), [&](const Shape& shape) {
    return addShape(shape, link, node);
  }));
}

bool UrdfSurface::addShape(const Shape& shape, const std::string& link, std::int32_t node) {
  switch (shape.geometry->type) {
    case urdf::Geometry::SPHERE: {
      const auto& sphere = static_cast<const urdf::Sphere&>(*shape.geometry);
      addRound(shape, 0.0, checkedLength(sphere.radius, link), node);
      return true;
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(*shape.geometry);
      const double radius = checkedLength(cylinder.radius, link);
      const double length = checkedLength(cylinder.length, link);
      if (shape.isCapsule) {
        addRound(shape, length / 2, radius, node);
      } else {
        addMesh(shape, cylinderAround(radius, length), Vector3d::Ones(), node);
      }
      return true;
    }
    case urdf::Geometry::BOX: {
      const auto& dim = static_cast<const urdf::Box&>(*shape.geometry).dim;
      addMesh(shape,
              boxOf({checkedLength(dim.x, link), checkedLength(dim.y, link),
                     checkedLength(dim.z, link)}),
              Vector3d::Ones(), node);
      return true;
    }
    case urdf::Geometry::MESH: break;
  }
  const auto& mesh = static_cast<const urdf::Mesh&>(*shape.geometry);
  const Vector3d scale(mesh.scale.x, mesh.scale.y, mesh.scale.z);
  for (const double s : scale) checkedLength(std::abs(s), link);
  const FlatMesh* flat = meshOf(mesh.filename, link);
  if (flat == nullptr) return false;
  addMesh(shape, *flat, scale, node);
  return true;
}

void UrdfSurface::addRound(const Shape& shape, double halfLength, double radius,
                           std::int32_t node) {
  const Vector3d half(0, 0, halfLength);
  builder_.addLss(node, {shape.toLink * -half, shape.toLink * half, radius});
}

void UrdfSurface::addMesh(const Shape& shape, const FlatMesh& mesh, const Vector3d& scale,
                          std::int32_t node) {
  std::vector<Vector3d> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vector3d& v : mesh.vertices) {
    vertices.push_back(shape.toLink * scale.cwiseProduct(v));
  }
  builder_.addMesh(node, shape.name, std::move(vertices), mesh.triangles);
}

void UrdfSurface::lose(const std::string& what) {
  if (question_.isRobot || question_.needsMeshes) throw Failure{ImportFailure::Refused, what};
  builder_.note(what);
}

const FlatMesh* UrdfSurface::meshOf(const std::string& reference, const std::string& link) {
  const std::string about = "mesh " + quotedName(reference) + " of link " + quotedName(link);
  const std::string path = find(reference);
  if (path.empty()) {
    lose(about + " was not found");
    return nullptr;
  }
  if (!isWithin(foldersBeside(question_.path, question_.packagePaths), path)) {
    lose(about +
         " is not read: it is neither beside the file nor in its package, nor in a "
         "folder of packages that was named");
    return nullptr;
  }
  auto found = meshes_.find(path);
  if (found == meshes_.end()) {
    std::optional<FlatMesh> mesh;
    try {
      const PlacedMeshes placed = placedMeshesOf(path);
      for (const std::string& note : placed.notes) builder_.note(about + ": " + note);
      for (const std::string& note : skippedNotes(0, placed.totals.skippedFaces)) {
        builder_.note(about + ": " + note);
      }
      mesh = flatten(placed);
    } catch (const Failure& failure) {
      if (failure.kind != ImportFailure::Refused && failure.kind != ImportFailure::UnknownFormat) {
        throw;
      }
      lose(about + " cannot be read: " + failure.text);
    }
    found = meshes_.emplace(path, std::move(mesh)).first;
  }
  if (!found->second.has_value()) return nullptr;
  if (found->second->triangles.empty()) {
    lose(about + " holds no triangles");
    return nullptr;
  }
  return &*found->second;
}

/// A path to a file, or an empty one.
std::string UrdfSurface::find(const std::string& reference) const {
  const fs::path folder = fs::absolute(question_.path).parent_path();
  if (startsWith(reference, "file://")) return ifFile(folder / reference.substr(7));
  for (const std::string_view scheme : {"package://", "model://"}) {
    if (!startsWith(reference, scheme)) continue;
    const std::string inside = reference.substr(scheme.size());
    const std::string rest = inside.substr(std::min(inside.size(), inside.find('/') + 1));
    std::vector<fs::path> folders(question_.packagePaths.begin(), question_.packagePaths.end());
    for (fs::path up = folder;; up = up.parent_path()) {
      folders.push_back(up);
      if (up == up.parent_path()) break;
    }
    for (const fs::path& place : folders) {
      for (const std::string& tail : {inside, rest}) {
        if (std::string path = ifFile(place / tail); !path.empty()) return path;
      }
    }
    return "";
  }
  return ifFile(folder / reference);
}

}  // namespace foretouch::internal
