#include "tools/audit/surface_audit.h"

#include <fmt/format.h>

#include "assets/text_file.h"
#include "lss/index.h"
#include "lss/lss_cover.h"
#include "tools/audit/audits.h"
#include "tools/inputs/played_clip.h"

namespace foretouch::tools {
namespace {

std::string countAndNames(const std::vector<std::string>& names) {
  const std::string count = std::to_string(names.size());
  return names.empty() ? count : count + ": " + firstOf(names);
}

}  // namespace

SurfaceAudit auditSurface(const Avatar& avatar, const std::vector<std::vector<Triangle>>& meshes) {
  SurfaceAudit audit;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const auto& triangles = meshes[slotOf(link)];
    const std::string& name = avatar.skeleton().name(link);
    if (triangles.empty()) continue;
    audit.triangles += triangles.size();
    if (triangles.size() == 1) audit.ofOneTriangle.push_back(name);
    if (avatar.lss(link).empty()) {
      audit.withoutLss.push_back(name);
      continue;
    }
    const CoverMeasure measure = measureCover(avatar.lss(link), triangles);
    audit.outside += measure.outside;
    audit.lssVolume += measure.lssVolume;
    audit.hullVolume += measure.hullVolume;
    if (measure.worstOutside > audit.worstOutside) {
      audit.worstOutside = measure.worstOutside;
      audit.worstLink = name;
    }
  }
  return audit;
}

std::string excessInWords(double lssVolume, double hullVolume) {
  if (!(hullVolume > 0.0)) return "of nothing: what they contain is flat";
  return fmt::format("{:.1f} % of the {:.4g} m^3 that they contain",
                     100.0 * (lssVolume - hullVolume) / hullVolume, hullVolume);
}

std::string describe(const SurfaceAudit& audit) {
  std::string outside = std::to_string(audit.outside);
  if (audit.outside > 0) {
    outside += fmt::format(", the worst by {:.4g} mm, on {}", 1e3 * audit.worstOutside,
                           inQuotes(audit.worstLink));
  }
  return auditRow("triangles of links", std::to_string(audit.triangles)) +
         auditRow("  outside their LSS", outside) +
         auditRow("excess volume of LSS", excessInWords(audit.lssVolume, audit.hullVolume)) +
         auditRow("links of one triangle", countAndNames(audit.ofOneTriangle)) +
         auditRow("meshes without an LSS", countAndNames(audit.withoutLss));
}

std::vector<std::string> doubtsAbout(const SurfaceAudit& audit) {
  std::vector<std::string> doubts;
  if (audit.outside > 0) {
    doubts.push_back(
        fmt::format("{} triangles stick out of their link's LSS, the worst by {:.4g} mm on {}",
                    audit.outside, 1e3 * audit.worstOutside, inQuotes(audit.worstLink)));
  }
  if (!audit.withoutLss.empty()) {
    doubts.push_back(fmt::format("{} links have a mesh but no LSS and touch nothing: {}",
                                 audit.withoutLss.size(), firstOf(audit.withoutLss)));
  }
  return doubts;
}

}  // namespace foretouch::tools
