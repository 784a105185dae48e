// tools/report/document_parts.h: what the documents of clips, of logs and of inspections have in
// common.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "middleware/scene/scene.h"
#include "middleware/surface/avatar_surface.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/report/scene_view.h"
#include "tools/report/view_document.h"

namespace foretouch::tools {

struct ReportOptions {
  std::string path;  ///< Empty: no report.
  std::size_t maxTriangles = kDefaultViewTriangles;
  std::size_t maxContacts = 100'000;
  std::size_t maxRotations = std::size_t{8} << 20;  ///< Numbers of all avatars' rotations: 64 MiB.
};

/// The name of a file without its folders.
[[nodiscard]] std::string fileName(const std::string& path);

/// Rows of the table, in this order; those without a value are left out.
[[nodiscard]] std::vector<ViewRow> rowsOf(const Settings& settings,
                                          std::initializer_list<const char*> names);
/// How the scene was read, and what was asked of it.
[[nodiscard]] std::vector<ViewRow> sceneSettings(WorldRequest request);
[[nodiscard]] std::vector<ViewRow> querySettings(WorldRequest request);
/// How the clip was read, and where it stands.
[[nodiscard]] std::vector<ViewRow> clipSettings(ClipRequest request);

/// The triangles of links, in their frames, simplified where they are too many: says so in `notes`.
[[nodiscard]] std::vector<ViewLinkMesh> linkMeshes(
    const std::vector<std::vector<Triangle>>& trianglesOfLinks, std::vector<std::string>& notes);
[[nodiscard]] std::vector<std::vector<Triangle>> trianglesOf(const AvatarSurface& surface);

/// What the page cannot show of how links were asked.
void noteFidelity(Fidelity fidelity, std::vector<std::string>& notes);

/// Sets the document's scene, all that its contacts touch included. `action`: around all that
/// moves; may be empty.
void addScene(const Scene& scene, const std::string& path, std::size_t maxTriangles,
              Eigen::AlignedBox3d action, ViewDocument& document);

/// A contact as results have it. `contact` is not clear.
[[nodiscard]] ReportedContact contactView(const LinkContact& contact, const Scene& scene,
                                          std::int64_t step, double t0S, double t1S);

}  // namespace foretouch::tools
