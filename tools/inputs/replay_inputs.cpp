#include "tools/inputs/replay_inputs.h"

#include <algorithm>
#include <utility>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/import/scene_import.h"
#include "assets/mesh/link_mesh.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "middleware/query_options.h"
#include "tools/console.h"
#include "tools/inputs/clip_pose.h"
#include "tools/inputs/first_pose.h"
#include "tools/inputs/ignored_pairs.h"
#include "tools/inputs/own_pairs.h"
#include "tools/inputs/played_clip.h"
#include "tools/inputs/policy_rules.h"
#include "tools/inputs/skin_file.h"

namespace foretouch::tools {
namespace {

/// The allocator keeps memory that building freed: a third of the total after a large scene.
void giveBackFreeMemory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

/// The meshes of the avatar file, if the fidelity needs them.
Result<Done> loadSurface(const WorldRequest& request, const std::string& avatarPath,
                         const Avatar& avatar, QueryOptions& query) {
  if (query.fidelity == Fidelity::Skinned) {
    FORETOUCH_TRY(query.skin, loadSkin(request.skinPath, request.skinImport, avatar));
    return Done{};
  }
  if (query.fidelity != Fidelity::Exact) return Done{};
  std::vector<LinkId> exact;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    if (query.linkPolicies.empty() ||
        query.linkPolicies[slotOf(link)].fidelity == Fidelity::Exact) {
      exact.push_back(link);
    }
  }
  FORETOUCH_TRY(auto meshes, loadLinkMeshes(avatar, avatarPath, exact));
  FORETOUCH_TRY(auto surface, inFile(AvatarSurface::build(avatar, std::move(meshes)), avatarPath));
  // So that the first steps' latencies are the query's alone, unless policies make few links exact.
  if (query.linkPolicies.empty()) surface.prepare();
  query.surface = std::move(surface);
  return Done{};
}

/// A smaller LSS does not hold its link's mesh.
Result<Done> checkRadii(const QueryOptions& query, const std::string& pairsPath) {
  const bool isExact =
      query.fidelity == Fidelity::Exact ||
      std::any_of(query.linkPolicies.begin(), query.linkPolicies.end(),
                  [](const LinkPolicy& own) { return own.fidelity == Fidelity::Exact; });
  if (!isExact || query.self->radii().empty()) return Done{};
  return Error::in(
      "--pairs", ErrorCode::Mismatch,
      "expected rules without pair radii at exact fidelity, found some in " + inQuotes(pairsPath));
}

/// The request with what its files say about themselves, so that users can repeat it.
ReplayRequest asRead(ReplayRequest request, const FileFrame& scene, const FileFrame& clip) {
  request.sceneImport.scale = scene.metresPerUnit;
  request.sceneImport.up = scene.up;
  request.motionScale = clip.metresPerUnit;
  request.motionUp = clip.up;
  return request;
}

/// The command that lists the pair rules of a replay, or writes them.
std::string pairsCommand(const ReplayRequest& request) {
  const bool isRobot = !request.robotPath.empty();
  std::string command =
      "foretouch avatar pairs " + request.avatarPath +
      (isRobot ? " --robot " + request.robotPath : " --clip " + request.motionPath);
  if (request.motionScale != 1.0) command += fmt::format(" --clip-scale {}", *request.motionScale);
  if (!request.animation.empty()) command += " --animation " + request.animation;
  return command;
}

/// The pairs that are not asked, and how to see them.
std::string remarkOnPairs(const ReplayRequest& request, const PairRules& rules) {
  return fmt::format(
      "--self: {} of {} pairs of own links are left out, so nothing is said of them ({}); list "
      "them: {}",
      rules.leftOut().size(), rules.numPairs(), reasonsOf(rules), pairsCommand(request));
}

/// The answers leave a quarter of the tolerance between what they say and what touches: what the
/// pieces leave out of the cubic takes half of it, of both sides where links meet links.
constexpr double kCurveShare = 0.125;

/// Plays the cubic in place of the clip's constant rate.
Result<Done> followCurve(ReplayInputs& inputs) {
  const MotionModel model = inputs.request.between;
  if (model == MotionModel::ConstantRate) return Done{};
  if (inputs.query.fidelity == Fidelity::Skinned) {
    return Error::in("--between", ErrorCode::Mismatch,
                     "expected constant-rate at skinned fidelity, of which no cubic is proven");
  }
  if (inputs.clip.mostTurn > 0.0) {
    return Error::in("--between", ErrorCode::Mismatch,
                     "expected constant-rate for a table of joint positions, which says the way "
                     "between two poses itself");
  }
  double tolerance = inputs.query.tolerance;
  for (const LinkPolicy& own : inputs.query.linkPolicies) {
    tolerance = std::min(tolerance, own.tolerance);
  }
  std::vector<Pose> poses;
  for (std::int64_t step = 0; step <= inputs.steps.count; ++step) {
    FORETOUCH_TRY(auto pose, poseAtFrame(inputs, inputs.steps.frameOf(step)));
    poses.push_back(std::move(pose));
  }
  const StepSelection given = inputs.steps;
  const double seconds = inputs.timeOfStep(1) - inputs.timeOfStep(0);
  FORETOUCH_TRY(auto curve, poseCurve(inputs.avatar, poses, seconds, model, given.stride,
                                      kCurveShare * tolerance));
  curve.given = given;
  curve.frameTimeS = inputs.clip.frameTimeS;
  const std::int64_t finer = curve.pieces / given.stride;
  inputs.steps = {1, given.count * curve.pieces, given.first * finer};
  inputs.clip.frameTimeS /= static_cast<double>(finer);
  inputs.clip.framesPerRow = finer;
  inputs.curve = std::move(curve);
  return Done{};
}

}  // namespace

Result<Scene> loadScene(const WorldRequest& request, FileFrame& frame) {
  FORETOUCH_TRY(auto loaded, readScene(request.scenePath, request.sceneImport));
  if (const std::string weak = importerWeakness(); !weak.empty()) printNote(weak);
  printNotes(request.scenePath, loaded.report.notes);
  frame = loaded.frame;
  giveBackFreeMemory();
  return std::move(loaded.scene);
}

Result<Scene> loadScene(const WorldRequest& request) {
  FileFrame frame;
  return loadScene(request, frame);
}

Result<QueryOptions> queryOptionsFor(const WorldRequest& request, const std::string& avatarPath,
                                     const Avatar& avatar, const Scene& scene) {
  QueryOptions query = request.query;
  if (request.budgetUs > 0) query.workBudget = workBudget(static_cast<double>(request.budgetUs));
  FORETOUCH_TRY(query.ignored,
                parseIgnoredPairs(request.ignore, avatar.skeleton(), scene.objectNames()));
  const auto applied =
      applyPolicies(request.policies, avatar.skeleton(), scene.objectNames(), query);
  if (!applied.ok()) return applied.error();
  FORETOUCH_CHECK(loadSurface(request, avatarPath, avatar, query));
  return query;
}

Result<ReplayInputs> loadReplayInputs(const ReplayRequest& request) {
  FORETOUCH_TRY(auto played, loadPlayedClip(request));
  auto& [avatar, clip, match, steps, isUpright, clipFrame, isByParts] = played;
  FileFrame sceneFrame;
  FORETOUCH_TRY(auto scene, loadScene(request, sceneFrame));
  FORETOUCH_TRY(auto query, queryOptionsFor(request, request.avatarPath, avatar, scene));
  if (request.asksSelf) {
    FORETOUCH_TRY(query.self, pairRulesFor(request, request, avatar, clip, match));
    FORETOUCH_CHECK(checkRadii(query, request.pairsPath));
  }
  ReplayInputs inputs{asRead(request, sceneFrame, clipFrame),
                      std::move(scene),
                      std::move(avatar),
                      std::move(clip),
                      std::move(match),
                      steps,
                      std::move(query),
                      isUpright,
                      sceneFrame,
                      clipFrame};
  FORETOUCH_CHECK(followCurve(inputs));
  return inputs;
}

std::optional<std::string> remarkOnMeshes(const QueryOptions& query,
                                          const std::string& avatarPath) {
  if (!query.surface || query.surface->numTriangles() > 0) return std::nullopt;
  return avatarPath +
         ": none of its links at exact fidelity has a mesh, so their LSS are what touches, as at "
         "link fidelity";
}

namespace {

/// Adds what the options and the files say about units and axes, and whether the body then stands.
void addFrameRemarks(const ReplayInputs& inputs, std::vector<std::string>& remarks) {
  const ReplayRequest& request = inputs.request;
  for (const auto& remark :
       {remarkOnFrame(inputs.sceneFrame, {"--scene-scale", "--scene-up"}, request.scenePath),
        remarkOnFrame(inputs.clipFrame, {"--clip-scale", "--clip-up"}, request.motionPath)}) {
    if (remark) remarks.push_back(*remark);
  }
  const auto first = poseAtFrame(inputs, 0);
  if (!first.ok()) return;  // the replay itself will say why
  const auto lying =
      remarkOnFirstPose(inputs.avatar, first.value(), inputs.clipFrame, request.motionPath);
  if (lying) remarks.push_back(*lying);
}

/// Some poses that are played, evenly spread.
std::vector<Pose> someOf(const ReplayInputs& inputs) {
  constexpr std::int64_t kMost = 24;  // each costs the meshes that a remark is about
  std::vector<Pose> poses;
  const std::int64_t count = std::min(kMost, inputs.steps.count + 1);
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t step = inputs.steps.count * i / (count - 1);
    auto pose = poseAtFrame(inputs, inputs.steps.frameOf(step));
    if (pose.ok()) poses.push_back(std::move(pose).value());
  }
  return poses;
}

}  // namespace

std::optional<std::string> hintOnOwnPairs(const ReplayInputs& inputs,
                                          const std::vector<StartingPair>& pairs,
                                          std::int64_t steps) {
  if (pairs.empty() || inputs.query.fidelity != Fidelity::Link) return std::nullopt;
  std::vector<LinkId> links;
  for (const StartingPair& one : pairs) links.insert(links.end(), {one.pair.a, one.pair.b});
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  // The hint is not worth an error.
  auto meshes = loadLinkMeshes(inputs.avatar, inputs.request.avatarPath, links);
  if (!meshes.ok()) return std::nullopt;
  return hintOnThickPairs(inputs.avatar, inputs.scene, std::move(meshes).value(), pairs, steps,
                          someOf(inputs), pairsCommand(inputs.request));
}

std::vector<std::string> remarksOn(const ReplayInputs& inputs) {
  const ReplayRequest& request = inputs.request;
  std::vector<std::string> remarks = remarksOnClip(inputs.avatar, inputs.clip, inputs.match,
                                                   request.avatarPath, request.motionPath);
  if (const std::size_t dropped = inputs.scene.audit().droppedNonFinite; dropped > 0) {
    remarks.push_back(fmt::format("{}: {} triangles with a vertex that is not finite were left out",
                                  request.scenePath, dropped));
  }
  if (inputs.query.self && request.pairsPath.empty() && !inputs.query.self->leftOut().empty()) {
    remarks.push_back(remarkOnPairs(request, *inputs.query.self));
  }
  for (const auto& remark :
       {request.pairsPath.empty()
            ? remarkOnApartMeshes(inputs.avatar, inputs.scene, inputs.query, someOf(inputs))
            : std::nullopt,
        remarkOnMeshes(inputs.query, request.avatarPath)}) {
    if (remark) remarks.push_back(*remark);
  }
  addFrameRemarks(inputs, remarks);
  if (inputs.curve) {
    remarks.push_back(fmt::format(
        "--between {}: {} pieces of a constant rate between two poses, within {:.2g} mm of it",
        toString(inputs.curve->model), inputs.curve->pieces, 1e3 * inputs.curve->offM));
  }
  return remarks;
}

Result<Pose> poseAtFrame(const ReplayInputs& inputs, std::int64_t frame) {
  if (inputs.curve)
    return inputs.curve->poses[static_cast<std::size_t>(frame - inputs.steps.first)];
  return poseAtFrame({inputs.avatar, inputs.clip, inputs.match, inputs.request.placement,
                      inputs.isUpright, inputs.request.motionPath},
                     frame);
}

}  // namespace foretouch::tools
