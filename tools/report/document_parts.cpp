#include "tools/report/document_parts.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "lss/index.h"
#include "tools/report/indexed_mesh.h"

namespace foretouch::tools {
namespace {

/// For all links of an avatar together.
constexpr std::size_t kMaxLinkTriangles = 100'000;

std::size_t numTriangles(const std::vector<std::vector<Triangle>>& trianglesOfLinks) {
  std::size_t count = 0;
  for (const auto& triangles : trianglesOfLinks) count += triangles.size();
  return count;
}

}  // namespace

std::string fileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

std::vector<ViewRow> rowsOf(const Settings& settings, std::initializer_list<const char*> names) {
  std::vector<ViewRow> rows;
  for (const char* const name : names) {
    const std::string value = settings.ofRow(name).told();
    if (!value.empty()) rows.push_back({name, value, ""});
  }
  return rows;
}

std::vector<ViewRow> sceneSettings(WorldRequest request) {
  Settings settings;
  addSceneSettings(settings, request);
  return rowsOf(settings, {"scene", "scene's unit", "scene's up axis"});
}

std::vector<ViewRow> querySettings(WorldRequest request) {
  Settings settings;
  addQuerySettings(settings, request);
  addReplayQuerySettings(settings, request);
  return rowsOf(settings, {"tolerance", "fidelity", "skin", "scope", "what separates", "policy",
                           "ignored", "own links", "budget"});
}

std::vector<ViewRow> clipSettings(ClipRequest request) {
  Settings settings;
  addMotionSetting(settings, request, "", "");
  addClipSettings(settings, request);
  addCutSettings(settings, request);
  return rowsOf(settings, {"motion", "motion's unit", "motion's up axis", "placed at", "animation",
                           "robot", "columns", "rows per second", "quaternions", "angles",
                           "table's unit", "joint map", "from", "to", "T-pose left out"});
}

std::vector<std::vector<Triangle>> trianglesOf(const AvatarSurface& surface) {
  std::vector<std::vector<Triangle>> all;
  for (LinkId link = 0; link < surface.numLinks(); ++link) all.push_back(surface.triangles(link));
  return all;
}

std::vector<ViewLinkMesh> linkMeshes(const std::vector<std::vector<Triangle>>& trianglesOfLinks,
                                     std::vector<std::string>& notes) {
  const std::size_t count = numTriangles(trianglesOfLinks);
  const double share = static_cast<double>(kMaxLinkTriangles) /
                       static_cast<double>(std::max(count, kMaxLinkTriangles));
  std::vector<ViewLinkMesh> meshes;
  for (std::size_t link = 0; link < trianglesOfLinks.size(); ++link) {
    const std::vector<Triangle>& triangles = trianglesOfLinks[link];
    if (triangles.empty()) continue;
    Corners corners;
    for (const Triangle& triangle : triangles) {
      for (const Eigen::Vector3d& vertex : triangle.vertices) {
        const Eigen::Vector3f position = vertex.cast<float>();
        corners.insert(corners.end(), position.data(), position.data() + 3);
      }
    }
    if (count > kMaxLinkTriangles) {
      const auto target = static_cast<std::size_t>(share * static_cast<double>(triangles.size()));
      const Simplifier simplifier(corners);
      corners.clear();
      simplifier.append(simplifier.downTo(target), corners);
    }
    meshes.push_back({static_cast<LinkId>(link), indexed(std::move(corners))});
  }
  if (count > kMaxLinkTriangles) {
    notes.push_back(fmt::format("The avatar's {} triangles are shown simplified to about {}.",
                                count, kMaxLinkTriangles));
  }
  return meshes;
}

void noteFidelity(Fidelity fidelity, std::vector<std::string>& notes) {
  switch (fidelity) {
    case Fidelity::Link:
    case Fidelity::Exact: return;
    case Fidelity::Skinned:
      notes.emplace_back("Contacts are those of the skin; shown are the links' LSS around it.");
      return;
  }
}

void addScene(const Scene& scene, const std::string& path, std::size_t maxTriangles,
              Eigen::AlignedBox3d action, ViewDocument& document) {
  SceneRequest request;
  request.name = fileName(path);
  request.maxTriangles = maxTriangles;
  for (const ViewAvatar& avatar : document.avatars) {
    for (const ReportedContact& contact : avatar.contacts) {
      if (contact.contact.triangle < 0 || contact.other >= 0) continue;
      request.contacted.push_back(contact.contact.triangle);
      action.extend(contact.contact.p_WScene);
    }
  }
  request.action = action;
  document.scene = viewOf(scene, request, document.notes);
}

ReportedContact contactView(const LinkContact& contact, const Scene& scene, std::int64_t step,
                            double t0S, double t1S) {
  ReportedContact view;
  view.step = step;
  view.contact = contact;
  if (contact.verdict != Verdict::Undecided) {
    view.timeS = timeOf(contact, t0S, t1S);
    view.object = scene.objectNames()[slotOf(scene.object(contact.triangle))];
  }
  return view;
}

ReportedContact contactView(const PairContact& contact, const Skeleton& skeleton, std::int64_t step,
                            double t0S, double t1S) {
  ReportedContact view;
  view.step = step;
  view.contact = contact;
  view.other = contact.other;
  view.object = skeleton.name(contact.other);
  if (contact.verdict != Verdict::Undecided) view.timeS = timeOf(contact, t0S, t1S);
  return view;
}

}  // namespace foretouch::tools
