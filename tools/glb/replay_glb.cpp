#include "tools/glb/replay_glb.h"

#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "tools/console.h"
#include "tools/glb/contact_extras.h"
#include "tools/glb/replay_scene.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;

/// Markers are costly to viewers, each an animated node.
constexpr std::size_t kMostTouches = 5000;

}  // namespace

std::size_t addGroup(GltfDocument& document, std::size_t parent, const std::string& name) {
  const std::size_t node = document.add("nodes", {{"name", name}});
  document.at("nodes", parent)["children"].push_back(node);
  return node;
}

std::size_t addWorld(const Eigen::Vector3d& origin, json extras, GltfDocument& document) {
  const std::size_t node =
      document.add("nodes", {{"name", "foretouch replay"}, {"extras", std::move(extras)}});
  if (!origin.isZero()) document.at("nodes", node)["translation"] = gltfVector(origin);
  document.show(node);
  return node;
}

void ReplayGlb::add(const StepAnswer& answer) {
  for (const LinkContact& contact : answer.contacts) {
    undecided_ += contact.verdict == Verdict::Undecided ? 1 : 0;
  }
}

void ReplayGlb::add(const std::vector<ReportedContact>& begun) {
  for (const ReportedContact& first : begun) {
    if (first.other >= 0) continue;  // own links have no place in the scene
    if (first_.size() == kMostTouches) {
      ++notShown_;
    } else {
      first_.push_back(first);
    }
  }
}

std::vector<ShownTouch> ReplayGlb::shownOf(const std::vector<Touch>& touches) const {
  using Begin = std::tuple<double, LinkId, std::string>;
  std::map<Begin, const Touch*> beginning;
  for (const Touch& touch : touches) {
    if (touch.other < 0) beginning[{touch.beginS, touch.link, touch.object}] = &touch;
  }
  std::vector<ShownTouch> shown;
  for (const ReportedContact& first : first_) {
    const auto found = beginning.find({first.timeS, first.contact.link, first.object});
    // Those with the ground are not listed where they are ignored.
    if (found != beginning.end()) shown.push_back({first, *found->second, {}, {}});
  }
  return shown;
}

Result<std::vector<std::string>> ReplayGlb::write(const std::vector<Touch>& touches) const {
  FORETOUCH_TRY(const auto stage, inFile(stageOf(inputs_), request_.path));
  const std::vector<ShownTouch> shown = shownOf(touches);

  std::vector<std::string> notes;
  if (notShown_ > 0) {
    notes.push_back(
        fmt::format("{} touches are not shown: the first {} are", notShown_, kMostTouches));
  }
  GlbContent content(fmt::format("foretouch {}", FORETOUCH_VERSION));
  GltfDocument& document = content.document();
  GlbAnimation animation("replay");
  TriangleBudget budget(request_.mostTriangles);
  // Has the settings of the replay, like the results' first line.
  json extras = json::parse(headerLine(inputs_));
  extras["undecided"] = undecided_;
  const std::size_t world = addWorld(stage.origin, std::move(extras), document);
  const std::vector<std::size_t> meshes = addLinkMeshes(stage, content, budget, notes);
  const std::size_t avatar = addGroup(document, world, "avatar");
  addAvatar({inputs_.avatar.skeleton(), stage.poses, stage.timesS}, meshes, avatar, stage.origin,
            content, animation);
  std::vector<Appearance> appearances =
      addMarkers(stage, shown, addGroup(document, world, "contacts"), content);
  const auto sweeps =
      addSweeps(stage, shown, addGroup(document, world, "sweeps"), content, budget, notes);
  appearances.insert(appearances.end(), sweeps.begin(), sweeps.end());
  addAppearances(appearances, stage.timesS.back(), content, animation);
  addScene(stage, shown, addGroup(document, world, "scene"), content, budget, notes);
  animation.finish(document);

  FORETOUCH_CHECK(content.writeFile(request_.path));
  return notes;
}

}  // namespace foretouch::tools
