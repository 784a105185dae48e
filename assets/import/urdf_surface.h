// assets/import/urdf_surface.h: the shapes of a URDF's links as triangles and LSS of a model's
// nodes. In foretouch-import only. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <urdf_model/link.h>
#include <urdf_model/pose.h>
#include <vector>

#include <Eigen/Core>

#include "assets/import/model.h"
#include "assets/import/solids.h"
#include "assets/import/urdf_text.h"

namespace foretouch::internal {

/// Rotation and translation; throws if a number is not finite or beyond kMaxCoordinate.
[[nodiscard]] Affine affineOf(const urdf::Pose& pose, const std::string& owner);

class UrdfSurface {
 public:
  UrdfSurface(const ModelQuestion& question, const UrdfText& text, ModelBuilder& builder)
      : question_(question), text_(text), builder_(builder) {}

  /// Adds the link's shapes of the requested kind to node `node` of the builder's model. If there
  /// are none, or none is readable, adds those of the other kind, with a note: a link without a
  /// surface means missed contacts.
  void add(const urdf::Link& link, std::int32_t node);

 private:
  struct Shape {
    const urdf::Geometry* geometry;
    Affine toLink;
    std::string name;
    bool isCapsule;
  };

  [[nodiscard]] std::vector<Shape> shapesOf(const urdf::Link& link, UrdfShapeKind kind) const;
  /// Returns how many of the shapes it added.
  int addAll(const std::vector<Shape>& shapes, const std::string& link, std::int32_t node);
  bool addShape(const Shape& shape, const std::string& link, std::int32_t node);
  void addRound(const Shape& shape, double halfLength, double radius, std::int32_t node);
  void addMesh(const Shape& shape, const FlatMesh& mesh, const Eigen::Vector3d& scale,
               std::int32_t node);
  /// Null, with a note, if the file is missing or unreadable; throws if the question says so.
  const FlatMesh* meshOf(const std::string& reference, const std::string& link);
  [[nodiscard]] std::string find(const std::string& reference) const;
  /// Adds a note; for a robot, refuses the file.
  void lose(const std::string& what);

  const ModelQuestion& question_;
  const UrdfText& text_;
  ModelBuilder& builder_;
  std::map<std::string, std::optional<FlatMesh>> meshes_;  // by path: links share files
};

}  // namespace foretouch::internal
