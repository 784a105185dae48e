#include <algorithm>
#include <utility>

#include "articulated/avatar.h"
#include "assets/import/failure.h"
#include "assets/import/model.h"
#include "lss/index.h"

namespace foretouch::internal {

void ModelBuilder::count(const ModelSize& more) {
  size_.nodes += more.nodes;
  size_.lss += more.lss;
  size_.mimics += more.mimics;
  size_.meshes += more.meshes;
  size_.vertices += more.vertices;
  size_.triangles += more.triangles;
  size_.bones += more.bones;
  size_.weights += more.weights;
  size_.animations += more.animations;
  size_.tracks += more.tracks;
  size_.keys += more.keys;
  size_.nameBytes += more.nameBytes;
  if (const std::string excess = size_.excess(); !excess.empty()) {
    throw Failure{ImportFailure::TooLarge, "instances counted, " + excess};
  }
}

void ModelBuilder::addLss(std::int32_t node, const Lss& lss) {
  std::vector<Lss>& own = model.nodes[slotOf(node)].lss;
  if (own.size() == kMaxLssPerLink) {
    throw Failure{ImportFailure::TooLarge, "more than " + std::to_string(kMaxLssPerLink) +
                                               " spheres and capsules on a link"};
  }
  ModelSize more;
  more.lss = 1;
  count(more);
  own.push_back(lss);
}

void ModelBuilder::addMesh(std::int32_t node, const std::string& name,
                           std::vector<Eigen::Vector3d> vertices,
                           const std::vector<std::array<std::int32_t, 3>>& triangles) {
  ModelSize more;
  more.meshes = 1;
  more.vertices = vertices.size();
  more.triangles = triangles.size();
  more.nameBytes = name.size();
  count(more);
  ModelMesh mesh;
  mesh.name = name;
  mesh.node = node;
  mesh.vertices = std::move(vertices);
  mesh.triangles = triangles;
  model.meshes.push_back(std::move(mesh));
}

void ModelBuilder::note(const std::string& text) {
  std::vector<std::string>& notes = model.notes;
  if (std::find(notes.begin(), notes.end(), text) != notes.end()) return;
  if (notes.size() + 1 < kMaxModelNotes) {
    notes.push_back(text);
  } else {
    ++notesLeftOut_;
  }
}

Model ModelBuilder::take() {
  if (notesLeftOut_ > 0) model.notes.push_back(std::to_string(notesLeftOut_) + " more notes");
  return std::move(model);
}

}  // namespace foretouch::internal
