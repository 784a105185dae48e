#include "tools/audit/audits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "assets/bvh/bvh_reader.h"
#include "lss/index.h"
#include "tools/inputs/first_pose.h"
#include "tools/inputs/played_clip.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

std::string sides(const Vector3d& extent) {
  return fmt::format("{:.4g} x {:.4g} x {:.4g} m (x, y, z)", extent.x(), extent.y(), extent.z());
}

std::vector<std::string> sizeDoubt(double largestSide, double least, double most,
                                   const std::string& option) {
  if (largestSide >= least && largestSide <= most) return {};
  return {fmt::format("measures {:.4g} m; expected {:g} to {:g} m: is the unit ({}) right?",
                      largestSide, least, most, option)};
}

/// True if the roots are turned as importModel() turns those of a Z-up file.
bool isTurnedFromZUp(const Skeleton& skeleton) {
  const double half = std::sqrt(0.5);
  const Quaternion turned(half, -half, 0.0, 0.0);
  return skeleton.restRotation(0).coeffs().isApprox(turned.coeffs(), 1e-9);
}

}  // namespace

std::string auditRow(const char* what, const std::string& value) {
  return fmt::format("  {:<25}{}\n", what, value);
}

std::string rowOf(const FileFrame& frame) {
  const std::string text = foretouch::describe(frame);
  return text.empty() ? "" : auditRow("the file itself", text);
}

AvatarAudit auditAvatar(const Avatar& avatar, const Pose& pose) {
  AvatarAudit audit;
  audit.links = avatar.numLinks();
  audit.lss = avatar.numLss();
  audit.smallestRadius = std::numeric_limits<double>::max();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    if (avatar.lss(link).empty()) audit.linksWithoutLss.push_back(avatar.skeleton().name(link));
    for (const Lss& lss : avatar.lss(link)) {
      audit.smallestRadius = std::min(audit.smallestRadius, lss.radius);
      audit.largestRadius = std::max(audit.largestRadius, lss.radius);
      audit.volume += volume(lss);
    }
  }
  audit.extent = boxInPose(avatar, pose).sizes();
  if (!isTurnedFromZUp(avatar.skeleton())) audit.stature = statureOf(avatar.skeleton());
  return audit;
}

std::string describe(const AvatarAudit& audit, const std::string& poseName) {
  std::string bare = std::to_string(audit.linksWithoutLss.size());
  if (!audit.linksWithoutLss.empty()) bare += ": " + firstOf(audit.linksWithoutLss);
  return auditRow("links", std::to_string(audit.links)) +
         auditRow("LSS", std::to_string(audit.lss)) + auditRow("links without an LSS", bare) +
         auditRow(("size in the " + poseName).c_str(), sides(audit.extent)) +
         auditRow("radii",
                  fmt::format("{:.4g} to {:.4g} m", audit.smallestRadius, audit.largestRadius)) +
         auditRow("volume of all LSS", fmt::format("{:.4g} m^3", audit.volume));
}

std::string describe(const SceneAudit& audit) {
  return auditRow("triangles", std::to_string(audit.triangles)) +
         auditRow("not finite, left out", std::to_string(audit.droppedNonFinite)) +
         auditRow("without area, kept", std::to_string(audit.zeroArea)) +
         auditRow("duplicates, kept", std::to_string(audit.duplicates)) +
         auditRow("size", sides(audit.boxMax - audit.boxMin)) +
         auditRow("from", fmt::format("{:.4g}, {:.4g}, {:.4g}", audit.boxMin.x(), audit.boxMin.y(),
                                      audit.boxMin.z())) +
         auditRow("to", fmt::format("{:.4g}, {:.4g}, {:.4g}", audit.boxMax.x(), audit.boxMax.y(),
                                    audit.boxMax.z())) +
         auditRow("edges",
                  fmt::format("{:.4g} to {:.4g} m", audit.shortestEdge, audit.longestEdge));
}

std::vector<std::string> doubtsAbout(const AvatarAudit& audit, const std::string& unitOption) {
  const double largestSide = audit.extent.maxCoeff();
  if (!audit.stature) return sizeDoubt(largestSide, kSmallestThing, kLargestThing, unitOption);
  auto doubts = sizeDoubt(largestSide, kSmallestPerson, kLargestPerson, unitOption);
  const bool isLikely = *audit.stature >= kSmallestStature && *audit.stature <= kLargestStature;
  if (doubts.empty() && !isLikely) {
    doubts.push_back(fmt::format(
        "is {:.3g} m tall, by the length of its legs; expected {:g} to {:g} m of a person: is the "
        "unit ({}) right?",
        *audit.stature, kSmallestStature, kLargestStature, unitOption));
  }
  return doubts;
}

std::vector<std::string> doubtsAbout(const SceneAudit& audit) {
  auto doubts = sizeDoubt((audit.boxMax - audit.boxMin).maxCoeff(), kSmallestScene, kLargestScene,
                          "--scene-scale");
  if (audit.droppedNonFinite > 0) {
    doubts.push_back(
        fmt::format("{} triangles have a vertex that is not finite", audit.droppedNonFinite));
  }
  return doubts;
}

std::string largestObjects(const Scene& scene) {
  constexpr std::size_t kShown = 10;
  const std::size_t n = scene.objectNames().size();
  std::vector<std::size_t> triangles(n, 0);
  for (std::size_t id = 0; id < scene.numTriangles(); ++id) {
    ++triangles[slotOf(scene.object(static_cast<TriangleId>(id)))];
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return triangles[a] > triangles[b]; });
  std::string text = fmt::format("{:>12}  object ({} in all)\n", "triangles", n);
  for (std::size_t i = 0; i < std::min(n, kShown); ++i) {
    text +=
        fmt::format("{:>12}  {}\n", triangles[order[i]], inQuotes(scene.objectNames()[order[i]]));
  }
  return text;
}

}  // namespace foretouch::tools
