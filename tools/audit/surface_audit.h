// tools/audit/surface_audit.h: how an avatar's LSS and the meshes of its links go together.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "lss/triangle.h"

namespace foretouch::tools {

/// Metres and cubic metres.
struct SurfaceAudit {
  std::size_t triangles = 0;
  std::size_t outside = 0;    ///< That stick out of every LSS of their link.
  double worstOutside = 0.0;  ///< By how much the worst does.
  std::string worstLink;      ///< The link it is on; empty where none does.
  double lssVolume = 0.0;     ///< Of the LSS that contain triangles.
  double hullVolume = 0.0;    ///< Of the hulls of what they contain (lss/hull_volume.h).
  std::vector<std::string> ofOneTriangle;  ///< Links: most likely a slip of somebody's.
  std::vector<std::string> withoutLss;     ///< Links with triangles that no LSS stands for.
};

/// `meshes` per link, as loadLinkMeshes() gives them.
[[nodiscard]] SurfaceAudit auditSurface(const Avatar& avatar,
                                        const std::vector<std::vector<Triangle>>& meshes);

/// Aligned lines.
[[nodiscard]] std::string describe(const SurfaceAudit& audit);

/// What a check says no to, one sentence each: contacts of such triangles would be missed.
[[nodiscard]] std::vector<std::string> doubtsAbout(const SurfaceAudit& audit);

/// "34.5 %": by how much LSS of this volume exceed what they contain.
[[nodiscard]] std::string excessInWords(double lssVolume, double hullVolume);

}  // namespace foretouch::tools
