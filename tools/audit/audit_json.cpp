#include "tools/audit/audit_json.h"

#include <string>
#include <vector>

#include "lss/index.h"

namespace foretouch::tools {

void writeFields(const AvatarAudit& audit, JsonWriter& out) {
  out.field("links", audit.links);
  out.field("lss", audit.lss);
  out.field("links_without_lss", audit.linksWithoutLss);
  out.field("size", audit.extent);
  out.field("smallest_radius", audit.smallestRadius);
  out.field("largest_radius", audit.largestRadius);
  out.field("volume", audit.volume);
  out.key("stature");
  audit.stature ? out.value(*audit.stature) : out.null();
}

void writeFields(const SceneAudit& audit, JsonWriter& out) {
  out.field("triangles", audit.triangles);
  out.field("not_finite", audit.droppedNonFinite);
  out.field("without_area", audit.zeroArea);
  out.field("duplicates", audit.duplicates);
  out.field("min", audit.boxMin);
  out.field("max", audit.boxMax);
  out.field("shortest_edge", audit.shortestEdge);
  out.field("longest_edge", audit.longestEdge);
}

void writeFields(const SceneImportReport& report, JsonWriter& out) {
  out.field("nodes", report.nodes);
  out.field("mesh_instances", report.meshInstances);
  out.field("meshes", report.uniqueMeshes);
  out.field("points_and_lines", report.skippedPrimitives);
  out.field("broken_faces", report.skippedFaces);
}

void writeObjects(const Scene& scene, JsonWriter& out) {
  std::vector<std::size_t> triangles(scene.objectNames().size(), 0);
  for (std::size_t id = 0; id < scene.numTriangles(); ++id) {
    ++triangles[slotOf(scene.object(static_cast<TriangleId>(id)))];
  }
  out.key("objects");
  out.beginArray();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    out.beginObject();
    out.field("name", scene.objectNames()[i]);
    out.field("triangles", triangles[i]);
    out.endObject();
  }
  out.endArray();
}

void writeLinks(const Avatar& avatar, JsonWriter& out) {
  const Skeleton& skeleton = avatar.skeleton();
  out.key("link_list");
  out.beginArray();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    out.beginObject();
    out.field("name", skeleton.name(link));
    if (skeleton.parent(link) != kNoParent)
      out.field("parent", skeleton.name(skeleton.parent(link)));
    out.field("lss", avatar.lss(link).size());
    if (!avatar.mesh(link).file.empty()) {
      out.field("mesh", avatar.mesh(link).file);
      out.field("node", avatar.mesh(link).node);
    }
    out.endObject();
  }
  out.endArray();
}

void writeMatch(const JointMatch& match, JsonWriter& out) {
  out.key("match");
  out.beginObject();
  out.field("joints", match.clipJointOf.size());
  out.field("at_rest", match.unmatchedAvatar);
  out.field("drive_nothing", match.unmatchedClip);
  out.endObject();
}

}  // namespace foretouch::tools
