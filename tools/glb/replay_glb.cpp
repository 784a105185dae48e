#include "tools/glb/replay_glb.h"

#include <algorithm>
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
constexpr std::size_t kMostOfAVerdict = 5000;

std::size_t addGroup(GltfDocument& document, std::size_t parent, const std::string& name) {
  const std::size_t node = document.add("nodes", {{"name", name}});
  document.at("nodes", parent)["children"].push_back(node);
  return node;
}

/// The node of the world W. Has the settings of the replay, like the results' first line.
std::size_t addWorld(const Stage& stage, std::int64_t undecided, GltfDocument& document) {
  json extras = json::parse(headerLine(stage.inputs));
  extras["undecided"] = undecided;
  const std::size_t node =
      document.add("nodes", {{"name", "foretouch replay"}, {"extras", std::move(extras)}});
  if (!stage.origin.isZero()) {
    document.at("nodes", node)["translation"] = gltfVector(stage.origin);
  }
  document.show(node);
  return node;
}

}  // namespace

void ReplayGlb::add(const StepAnswer& answer) {
  for (const LinkContact& contact : answer.contacts) {
    if (contact.verdict == Verdict::Undecided) {
      ++undecided_;
      continue;
    }
    auto& kept = contact.verdict == Verdict::Contact ? contacts_ : startsInContact_;
    if (kept.size() == kMostOfAVerdict) {
      ++notShown_;
      continue;
    }
    const auto& missed = answer.missedByPoses;
    kept.push_back({contact, answer.step, timeOf(contact, answer.t0S, answer.t1S), "",
                    std::find(missed.begin(), missed.end(), contact.link) != missed.end()});
  }
}

Result<std::vector<std::string>> ReplayGlb::write() const {
  FORETOUCH_TRY(const auto stage, inFile(stageOf(inputs_), request_.path));
  std::vector<ReportedContact> shown = contacts_;
  shown.insert(shown.end(), startsInContact_.begin(), startsInContact_.end());

  std::vector<std::string> notes;
  if (notShown_ > 0) {
    notes.push_back(fmt::format("{} contacts are not shown: of each verdict the first {} are",
                                notShown_, kMostOfAVerdict));
  }
  GlbContent content(fmt::format("foretouch {}", FORETOUCH_VERSION));
  GltfDocument& document = content.document();
  GlbAnimation animation("replay");
  TriangleBudget budget(request_.mostTriangles);
  const std::size_t world = addWorld(stage, undecided_, document);
  const std::vector<std::size_t> meshes = addLinkMeshes(stage, content, budget, notes);
  const std::size_t avatar = addGroup(document, world, "avatar");
  addAvatar({inputs_.avatar, stage.poses, stage.timesS}, meshes, avatar, stage.origin, content,
            animation);
  std::vector<Appearance> appearances =
      addMarkers(stage, shown, addGroup(document, world, "contacts"), content);
  const auto sweeps =
      addSweeps(stage, shown, addGroup(document, world, "sweeps"), content, budget, notes);
  appearances.insert(appearances.end(), sweeps.begin(), sweeps.end());
  addAppearances(appearances, stage.timesS.back(), content, animation);
  addScene(stage, shown, addGroup(document, world, "scene"), content, budget, notes);
  animation.finish(document);

  FORETOUCH_TRY(const auto head, inFile(content.head(), request_.path));
  FORETOUCH_TRY(auto file, PendingFile::create(request_.path));
  content.write(file, head);
  FORETOUCH_CHECK(file.commit());
  return notes;
}

}  // namespace foretouch::tools
