#include <algorithm>
#include <optional>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "lss/turn_between.h"
#include "tessellation/swept_surface.h"
#include "tools/glb/contact_extras.h"
#include "tools/glb/replay_scene.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

constexpr GlbMaterial kRed{"contact", {0.80, 0.05, 0.03, 1.0}};
constexpr GlbMaterial kAmber{"starts in contact", {0.90, 0.50, 0.02, 1.0}};

/// How long (s) a touch stays visible at least: a tap is over before people see it.
constexpr double kHoldS = 1.0;

double endOf(const ShownTouch& shown, const Stage& stage) {
  const double lastS = shown.untilS.value_or(stage.inputs.timeOfStep(shown.touch.lastStep + 1));
  return std::max(lastS, shown.touch.beginS + kHoldS);
}

json markerNode(const ShownTouch& shown, const Stage& stage, std::size_t mesh) {
  const LinkContact& contact = shown.first.contact;
  const Skeleton& skeleton = stage.inputs.avatar.skeleton();
  const Scene& scene = stage.inputs.scene;
  const auto turn = turnBetween(Vector3d::UnitY(), contact.nhat_SL_W).normalized();
  return {{"name", contactTitle(shown, skeleton, scene)},
          {"mesh", mesh},
          {"translation", gltfVector(contact.p_WScene - stage.origin)},
          {"rotation", json::array({turn.x(), turn.y(), turn.z(), turn.w()})},
          {"extras", contactExtras(shown, skeleton, scene)}};
}

/// The link's sweep during the step; nothing if that takes more triangles than `most`, or a larger
/// error than requested.
struct SweptLink {
  std::vector<Triangle> triangles;
  double certifiedError = 0.0;
};
std::optional<SweptLink> sweptBy(const Stage& stage, const ShownTouch& shown, double error,
                                 std::size_t most) {
  const auto step = static_cast<std::size_t>(shown.first.step);
  const Avatar& avatar = stage.inputs.avatar;
  const ChainMotion motion(avatar.skeleton(), stage.poses[step], stage.poses[step + 1]);
  SweptSurfaceOptions options;
  options.error = error;
  SweptLink swept;
  for (const Lss& lss : avatar.lss(shown.touch.link)) {
    options.maxTriangles = most - swept.triangles.size();
    auto builder = SweptSurfaceBuilder::create(lss, options);
    if (!builder.ok() || !builder.value().add(motion, shown.touch.link, {}).ok()) return {};
    const auto surface = builder.value().finish();
    if (!surface.ok()) return {};
    swept.certifiedError = std::max(swept.certifiedError, surface.value().certifiedError);
    for (const auto& corners : surface.value().triangles) {
      const auto& vertices = surface.value().vertices;
      swept.triangles.push_back(
          {{vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]}});
    }
    if (swept.triangles.size() > most) return {};
  }
  return swept;
}

json sweepNode(const ShownTouch& shown, const Stage& stage, const SweptLink& swept,
               std::size_t mesh) {
  const std::string& link = stage.inputs.avatar.skeleton().name(shown.touch.link);
  const double t0S = stage.inputs.timeOfStep(shown.first.step);
  const double t1S = stage.inputs.timeOfStep(shown.first.step + 1);
  return {{"name", fmt::format("sweep of {}, {:.3f} to {:.3f} s", link, t0S, t1S)},
          {"mesh", mesh},
          {"extras",
           {{"link", link},
            {"step", shown.first.step},
            {"t0", t0S},
            {"t1", t1S},
            {"certified_error", swept.certifiedError}}}};
}

}  // namespace

std::vector<Appearance> addMarkers(const Stage& stage, const std::vector<ShownTouch>& touches,
                                   std::size_t parent, GlbContent& content) {
  std::vector<Appearance> appearances;
  if (touches.empty()) return appearances;
  constexpr double kArrow = 0.1;  // of the avatar's extent
  const GlbMesh marker = markerMesh(kArrow * stage.extent);
  std::optional<std::size_t> first, fromStart;
  const auto meshFor = [&](Verdict verdict) {
    const bool isFirst = verdict == Verdict::Contact;
    std::optional<std::size_t>& mesh = isFirst ? first : fromStart;
    if (!mesh) {
      const GlbMaterial& material = isFirst ? kRed : kAmber;
      mesh = content.addMesh(material.name, {{marker, content.addMaterial(material)}});
    }
    return *mesh;
  };
  GltfDocument& document = content.document();
  for (const ShownTouch& shown : touches) {
    const std::size_t node =
        document.add("nodes", markerNode(shown, stage, meshFor(shown.first.contact.verdict)));
    document.at("nodes", parent)["children"].push_back(node);
    appearances.push_back({node, shown.first.timeS, endOf(shown, stage)});
  }
  return appearances;
}

std::vector<Appearance> addSweeps(const Stage& stage, const std::vector<ShownTouch>& touches,
                                  std::size_t parent, GlbContent& content, TriangleBudget& budget,
                                  std::vector<std::string>& notes) {
  constexpr double kError = 0.01;    // of the avatar's extent
  constexpr std::size_t kShare = 2;  // of the budget: the rest is the scene's
  TriangleBudget own(budget.left() / kShare);
  GltfDocument& document = content.document();
  std::optional<std::size_t> material;
  std::vector<Appearance> appearances;
  std::size_t leftOut = 0;
  for (const ShownTouch& shown : touches) {
    if (shown.first.contact.verdict != Verdict::Contact) continue;
    const auto swept = sweptBy(stage, shown, kError * stage.extent, own.left());
    if (!swept || swept->triangles.empty() || !own.take(swept->triangles.size())) {
      ++leftOut;
      continue;
    }
    budget.take(swept->triangles.size());
    if (!material) material = content.addMaterial({"swept volume", {0.95, 0.45, 0.10, 0.30}});
    const std::string& link = stage.inputs.avatar.skeleton().name(shown.touch.link);
    const std::size_t mesh =
        content.addMesh("sweep of " + link, {{meshOf(swept->triangles, stage.origin), *material}});
    const std::size_t node = document.add("nodes", sweepNode(shown, stage, *swept, mesh));
    document.at("nodes", parent)["children"].push_back(node);
    appearances.push_back({node, stage.inputs.timeOfStep(shown.first.step), endOf(shown, stage)});
  }
  if (leftOut > 0) {
    notes.push_back(fmt::format("the swept volumes of {} touches are left out", leftOut));
  }
  return appearances;
}

}  // namespace foretouch::tools
