// tools/audit/surface_audit.h: how well an avatar's LSS and the meshes of its links fit.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "lss/lss.h"

namespace foretouch::tools {

/// Metres and cubic metres.
struct SurfaceAudit {
  std::size_t triangles = 0;
  std::size_t outside = 0;                 ///< Triangles that stick out of every LSS of their link.
  double worstOutside = 0.0;               ///< How far the worst sticks out.
  std::string worstLink;                   ///< Its link; empty if none does.
  double lssVolume = 0.0;                  ///< The volume of the LSS that contain triangles.
  double hullVolume = 0.0;                 ///< Hull volume of these triangles (lss/hull_volume.h).
  std::vector<std::string> ofOneTriangle;  ///< Links with a single triangle: most likely a mistake.
  std::vector<std::string> withoutLss;     ///< Links with triangles but without LSS.
};

/// `meshes` per link, as from loadLinkMeshes().
[[nodiscard]] SurfaceAudit auditSurface(const Avatar& avatar,
                                        const std::vector<std::vector<Triangle>>& meshes);

/// Aligned lines.
[[nodiscard]] std::string describe(const SurfaceAudit& audit);

/// The findings that fail a check, one sentence each: queries would miss contacts of such
/// triangles.
[[nodiscard]] std::vector<std::string> doubtsAbout(const SurfaceAudit& audit);

/// "34.5 %": how much LSS of this volume exceed the hulls that they contain.
[[nodiscard]] std::string excessInWords(double lssVolume, double hullVolume);

}  // namespace foretouch::tools
