// tools/glb/replay_scene.h: the parts of a replay's GLB.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "tools/glb/appearances.h"
#include "tools/glb/glb_content.h"
#include "tools/glb/shown_touch.h"
#include "tools/inputs/replay_inputs.h"

namespace foretouch::tools {

/// Data for all parts.
struct Stage {
  const ReplayInputs& inputs;
  std::vector<Pose> poses;
  std::vector<double> timesS;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< Origin of the world's node.
  double extent = 1.0;  ///< The diagonal of the avatar's box in the first pose (m).
};

/// Computes every pose; error if one is out of range or floats cannot distinguish its time.
[[nodiscard]] Result<Stage> stageOf(const ReplayInputs& inputs);
/// With other poses than the clip's, at least two, and their times.
[[nodiscard]] Result<Stage> stageOf(const ReplayInputs& inputs, std::vector<Pose> poses,
                                    std::vector<double> timesS);

/// The origin that positions between these two corners are best relative to: zero near W's origin.
[[nodiscard]] Eigen::Vector3d originFor(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// The node of the world W, with W's origin at `origin`; `extras` belong to the node.
[[nodiscard]] std::size_t addWorld(const Eigen::Vector3d& origin, nlohmann::json extras,
                                   GltfDocument& document);
/// A node below `parent` that only holds others.
[[nodiscard]] std::size_t addGroup(GltfDocument& document, std::size_t parent,
                                   const std::string& name);

/// Triangles that may still be added.
class TriangleBudget {
 public:
  explicit TriangleBudget(std::size_t most) : left_(most) {}
  [[nodiscard]] std::size_t left() const { return left_; }
  /// False, without taking any, if there are not so many.
  bool take(std::size_t triangles) {
    if (triangles > left_) return false;
    left_ -= triangles;
    return true;
  }

 private:
  std::size_t left_;
};

/// The mesh of every link (kNoMesh: it has none): its LSS, transparent if the link also has a mesh.
/// Notes omissions in `notes`.
[[nodiscard]] std::vector<std::size_t> addLinkMeshes(const Stage& stage, GlbContent& content,
                                                     TriangleBudget& budget,
                                                     std::vector<std::string>& notes);

/// The same for a body that is only hinted at: the LSS of every link, transparent, in the colour of
/// what was tracked.
[[nodiscard]] std::vector<std::size_t> addGhostMeshes(const Stage& stage, GlbContent& content,
                                                      TriangleBudget& budget,
                                                      std::vector<std::string>& notes);

/// The LSS of every link (kNoMesh: it has none), named after it behind `prefix`. Adds to `leftOut`
/// those that the budget has no room for.
[[nodiscard]] std::vector<std::size_t> addLssMeshes(const Avatar& avatar, const std::string& prefix,
                                                    std::size_t material, GlbContent& content,
                                                    TriangleBudget& budget, std::size_t& leftOut);

/// A node below `parent` for every object of the scene, preferring triangles near `places` (at
/// least one) and including those of `touched`. `origin`: that of the world's node.
void addScene(const Scene& scene, const std::vector<Eigen::Vector3d>& places,
              std::vector<TriangleId> touched, const Eigen::Vector3d& origin, std::size_t parent,
              GlbContent& content, TriangleBudget& budget, std::vector<std::string>& notes);
/// The same for a replay: near the avatar's path, including where touches begin.
void addScene(const Stage& stage, const std::vector<ShownTouch>& touches, std::size_t parent,
              GlbContent& content, TriangleBudget& budget, std::vector<std::string>& notes);

/// A marker below `parent` for every touch: a ball where it begins, an arrow along the normal.
[[nodiscard]] std::vector<Appearance> addMarkers(const Stage& stage,
                                                 const std::vector<ShownTouch>& touches,
                                                 std::size_t parent, GlbContent& content);

/// The sweep of the link during the step in which a touch begins with a contact, below `parent`.
[[nodiscard]] std::vector<Appearance> addSweeps(const Stage& stage,
                                                const std::vector<ShownTouch>& touches,
                                                std::size_t parent, GlbContent& content,
                                                TriangleBudget& budget,
                                                std::vector<std::string>& notes);

}  // namespace foretouch::tools
