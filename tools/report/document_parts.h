// tools/report/document_parts.h: what the documents of clips, logs and inspections share.
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

/// Most scene triangles that a user may request in a report.
inline constexpr int kMostReportTriangles = 10'000'000;

struct ReportOptions {
  std::string path;  ///< Empty: no report.
  std::size_t maxTriangles = kDefaultViewTriangles;
  std::size_t maxContacts = 100'000;
  std::size_t maxRotations = std::size_t{8} << 20;  ///< Numbers of all avatars' rotations: 64 MiB.
};

/// The name of a file without its folders.
[[nodiscard]] std::string fileName(const std::string& path);

/// Rows of the table, in this order, without those that have no value.
[[nodiscard]] std::vector<ViewRow> rowsOf(const Settings& settings,
                                          std::initializer_list<const char*> names);
/// The settings of the scene's import, and of the query.
[[nodiscard]] std::vector<ViewRow> sceneSettings(WorldRequest request);
[[nodiscard]] std::vector<ViewRow> querySettings(WorldRequest request);
/// The settings of the clip's import, and its placement.
[[nodiscard]] std::vector<ViewRow> clipSettings(ClipRequest request);

/// The triangles of links, in their frames, simplified if there are too many: says so in `notes`.
[[nodiscard]] std::vector<ViewLinkMesh> linkMeshes(
    const std::vector<std::vector<Triangle>>& trianglesOfLinks, std::vector<std::string>& notes);
[[nodiscard]] std::vector<std::vector<Triangle>> trianglesOf(const AvatarSurface& surface);

/// Notes what the page cannot show at this fidelity.
void noteFidelity(Fidelity fidelity, std::vector<std::string>& notes);

/// Sets the document's scene, with every triangle that its contacts touch. `action`: the box around
/// everything that moves; may be empty.
void addScene(const Scene& scene, const std::string& path, std::size_t maxTriangles,
              Eigen::AlignedBox3d action, ViewDocument& document);

/// A contact in the form of results. `contact` is not clear.
[[nodiscard]] ReportedContact contactView(const LinkContact& contact, const Scene& scene,
                                          std::int64_t step, double t0S, double t1S);
/// The same for two own links.
[[nodiscard]] ReportedContact contactView(const PairContact& contact, const Skeleton& skeleton,
                                          std::int64_t step, double t0S, double t1S);

}  // namespace foretouch::tools
