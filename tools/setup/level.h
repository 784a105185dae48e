// tools/setup/level.h: a scene as a person would walk through it: which side of a surface is its
// front, and what a point meets along a line. World W: metres, +Y up.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// What a point meets on a line.
struct LevelHit {
  double distance = 0.0;
  TriangleId triangle = -1;
};

class Level {
 public:
  /// Errors: those of Scene::build().
  [[nodiscard]] static Result<Level> build(RawScene raw);

  [[nodiscard]] const Scene& scene() const { return scene_; }
  /// The front's normal, unit; zero without an area.
  [[nodiscard]] Eigen::Vector3d normal(TriangleId triangle) const;

  /// What a point meets first on its way. Straight up, down or sideways it is fast.
  [[nodiscard]] std::optional<LevelHit> cast(const Eigen::Vector3d& from,
                                             const Eigen::Vector3d& to) const;

 private:
  Level(Scene scene, std::vector<Eigen::Vector3d> areas, Avatar point, Query query);

  Scene scene_;
  std::vector<Eigen::Vector3d> areas_;  ///< Per triangle: the front's normal times the area.
  Avatar point_;                        ///< A body of one point: the engine's own ray.
  Query query_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace foretouch::tools
