#include <map>

#include <fmt/format.h>

#include "lss/index.h"
#include "tools/glb/replay_scene.h"
#include "tools/glb/scene_selection.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Nodes are costly to viewers: all objects beyond these share one node.
constexpr std::size_t kMostObjects = 5000;
constexpr ObjectId kOthers = -1;

/// Places of the first root, at times spread over the clip.
std::vector<Vector3d> placesOn(const Stage& stage) {
  constexpr std::size_t kPlaces = 64;
  const std::size_t stride = 1 + (stage.poses.size() - 1) / kPlaces;
  std::vector<Vector3d> places;
  for (std::size_t i = 0; i < stage.poses.size(); i += stride) {
    places.push_back(stage.poses[i].translations[0]);
  }
  return places;
}

std::map<ObjectId, std::vector<Triangle>> byObject(const Scene& scene,
                                                   const std::vector<TriangleId>& ids) {
  std::map<ObjectId, std::vector<Triangle>> objects;
  for (const TriangleId id : ids) {
    ObjectId object = scene.object(id);
    if (objects.size() >= kMostObjects && objects.count(object) == 0) object = kOthers;
    objects[object].push_back(scene.triangle(id));
  }
  return objects;
}

}  // namespace

void addScene(const Stage& stage, const std::vector<ShownTouch>& touches, std::size_t parent,
              GlbContent& content, TriangleBudget& budget, std::vector<std::string>& notes) {
  std::vector<TriangleId> touched;
  for (const ShownTouch& shown : touches) touched.push_back(shown.first.contact.triangle);
  addScene(stage.inputs.scene, placesOn(stage), std::move(touched), stage.origin, parent, content,
           budget, notes);
}

void addScene(const Scene& scene, const std::vector<Vector3d>& places,
              std::vector<TriangleId> touched, const Vector3d& origin, std::size_t parent,
              GlbContent& content, TriangleBudget& budget, std::vector<std::string>& notes) {
  const auto ids = nearestTriangles(scene, places, std::move(touched), budget.left());
  const std::size_t finite = scene.audit().triangles;
  if (ids.size() < finite) {
    notes.push_back(fmt::format(
        "{} of the scene's {} triangles are left out: those farthest from the avatar's way",
        finite - ids.size(), finite));
  }
  budget.take(ids.size());
  const std::size_t material = content.addMaterial({"scene", {0.72, 0.70, 0.66, 1.0}});
  for (const auto& [object, triangles] : byObject(scene, ids)) {
    const std::string name =
        object == kOthers ? "other objects" : scene.objectNames()[slotOf(object)];
    const std::size_t mesh = content.addMesh(name, {{meshOf(triangles, origin), material}});
    const std::size_t node = content.document().add("nodes", {{"name", name}, {"mesh", mesh}});
    content.document().at("nodes", parent)["children"].push_back(node);
  }
}

}  // namespace foretouch::tools
