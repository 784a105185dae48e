#include "tools/report/inspection.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/import/scene_import.h"
#include "assets/mesh/link_mesh.h"
#include "assets/text_file.h"
#include "lss/assert.h"
#include "tools/audit/audits.h"
#include "tools/console.h"
#include "tools/inputs/clip_cut.h"
#include "tools/inputs/clip_pose.h"
#include "tools/inputs/played_clip.h"
#include "tools/report/track_builder.h"
#include "tools/setup/frame_checks.h"
#include "tools/setup/standing.h"

namespace foretouch::tools {

struct Inspected {
  ReplayRequest request;
  std::optional<Level> level;
  std::optional<Avatar> avatar;
  std::optional<PlayedClip> played;  ///< Its avatar is the one above, if a file names one.
  bool isMadeUp = false;             ///< The avatar is made of the clip.
  std::vector<std::vector<Triangle>> triangles;  ///< Those of links, if the avatar names meshes.
  std::vector<std::string> notes;
  std::vector<PlacementCheck> frameChecks;  ///< About units and axes.

  [[nodiscard]] const Scene* scene() const { return level ? &level->scene() : nullptr; }
  [[nodiscard]] const Avatar* body() const {
    return played ? &played->avatar : avatar ? &*avatar : nullptr;
  }
};

namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

Result<Done> loadBody(Inspected& inspected) {
  const ReplayRequest& request = inspected.request;
  if (!request.motionPath.empty()) {
    inspected.isMadeUp = request.avatarPath.empty();
    FORETOUCH_TRY(inspected.played,
                  inspected.isMadeUp ? loadClipAlone(request) : loadPlayedClip(request));
    const PlayedClip& played = *inspected.played;
    inspected.frameChecks = clipFrameChecks(played.clip, played.frame, played.isUpright);
  } else if (!request.avatarPath.empty()) {
    FORETOUCH_TRY(inspected.avatar, readAvatarFile(request.avatarPath));
  }
  return Done{};
}

/// Unreadable meshes do not prevent the rest of the inspection.
void loadMeshes(Inspected& inspected) {
  const Avatar* const body = inspected.body();
  if (body == nullptr || inspected.request.avatarPath.empty()) return;
  bool hasMesh = false;
  for (LinkId link = 0; link < body->numLinks(); ++link) {
    hasMesh = hasMesh || !body->mesh(link).file.empty();
  }
  if (!hasMesh) return;
  auto meshes = loadLinkMeshes(*body, inspected.request.avatarPath);
  if (meshes.ok()) {
    inspected.triangles = std::move(meshes).value();
  } else {
    inspected.notes.push_back(describe(inFile(meshes.error(), inspected.request.avatarPath)));
  }
}

Result<Pose> poseAt(const Inspected& inspected, std::int64_t index) {
  const Placement& placement = inspected.request.placement;
  const ReplayRequest& request = inspected.request;
  if (inspected.played) {
    const PlayedClip& played = *inspected.played;
    return poseAtFrame(
        {played.avatar, played.clip, played.match, placement, played.isUpright, request.motionPath},
        played.steps.frameOf(index));
  }
  const Skeleton& skeleton = inspected.avatar->skeleton();
  auto pose = validatedPose(skeleton, placed(skeleton, restPose(skeleton), placement));
  if (!pose.ok()) return inFile(pose.error(), "--place");
  return pose;
}

/// As the level's sides are lost in a Scene, it is read here and not by loadScene().
Result<Done> loadLevel(Inspected& inspected) {
  const ReplayRequest& request = inspected.request;
  FORETOUCH_TRY(auto imported, importScene(request.scenePath, request.sceneImport));
  printNotes(request.scenePath, imported.report.notes);
  for (PlacementCheck& check : sceneFrameChecks(imported.scene, imported.frame)) {
    inspected.frameChecks.push_back(std::move(check));
  }
  FORETOUCH_TRY(inspected.level,
                inFile(Level::build(std::move(imported.scene)), request.scenePath));
  return Done{};
}

Result<WalkingBody> walkingBodyOf(const Inspected& inspected) {
  if (!inspected.played) {
    return WalkingBody{*inspected.avatar, {restPose(inspected.avatar->skeleton())}};
  }
  const PlayedClip& played = *inspected.played;
  Placement upright;
  upright.motionUpZ = inspected.request.placement.motionUpZ;
  FORETOUCH_TRY(const auto frames, framesOf(inspected.request, played.clip, played.isUpright));
  return walkingBody({played.avatar, played.clip, played.match, upright, played.isUpright,
                      inspected.request.motionPath},
                     frames);
}

/// Where the body stands, by the engine; where it stands wrong, also where it could.
Result<std::vector<PlacementCheck>> checksOf(const Inspected& inspected) {
  std::vector<PlacementCheck> checks = inspected.frameChecks;
  const Avatar* const avatar = inspected.body();
  if (!inspected.level || avatar == nullptr) return checks;
  FORETOUCH_TRY(const auto body, walkingBodyOf(inspected));
  Placement place = inspected.request.placement;
  place.motionUpZ = false;  // the poses are upright
  FORETOUCH_TRY(const auto walker, Walker::build(body, *inspected.level, place.origin));
  const Standing standing = standingAt(walker, place);
  // A body in a wrong unit is at home nowhere.
  const bool isFrameRight =
      std::all_of(checks.begin(), checks.end(),
                  [](const PlacementCheck& check) { return check.tryThis.empty(); });
  const auto better =
      isFrameRight && isWrong(standing) ? bestStanding(walker, place) : std::nullopt;
  for (PlacementCheck& check : checksOf(walker, standing, better ? &*better : nullptr)) {
    checks.push_back(std::move(check));
  }
  return checks;
}

Result<Done> addTrack(const Inspected& inspected, const ReportOptions& options, TrackBuilder& track,
                      std::vector<std::string>& notes, const ReportProgress& progress) {
  const std::int64_t wanted = inspected.played ? inspected.played->steps.count + 1 : 1;
  const std::int64_t poses =
      std::min(wanted, static_cast<std::int64_t>(track.capacity(options.maxRotations)));
  for (std::int64_t i = 0; i < poses && progress(i, poses); ++i) {
    FORETOUCH_TRY(const auto pose, poseAt(inspected, i));
    const double timeS = inspected.played
                             ? static_cast<double>(inspected.played->steps.frameOf(i)) *
                                   inspected.played->clip.frameTimeS
                             : 0.0;
    track.addPose(timeS, pose);
    if (i > 0) track.addStep(static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i));
  }
  if (poses < wanted) {
    notes.push_back(fmt::format("Shown are the first {} of {} poses.", poses, wanted));
  }
  return Done{};
}

std::string sizeText(const Vector3d& size) {
  return fmt::format("{:.4g} x {:.4g} x {:.4g} m", size.x(), size.y(), size.z());
}

void addSceneRows(const Scene& scene, ViewDocument& document) {
  const SceneAudit& audit = scene.audit();
  std::vector<ViewRow>& rows = document.summary;
  rows.push_back({"scene", fmt::format("{} triangles", audit.triangles),
                  fmt::format("in {} object{}", scene.objectNames().size(),
                              scene.objectNames().size() == 1 ? "" : "s")});
  rows.push_back({"size of the scene", sizeText(audit.boxMax - audit.boxMin), "x, y (up), z"});
  rows.push_back({"height of the scene",
                  fmt::format("{:.4g} to {:.4g} m", audit.boxMin.y(), audit.boxMax.y()), ""});
  for (const std::string& doubt : doubtsAbout(audit)) {
    document.notes.push_back(document.scene->name + ": " + doubt);
  }
  if (audit.droppedNonFinite > 0) {
    document.notes.push_back(
        fmt::format("{}: {} triangles with a vertex that is not finite were left out",
                    document.scene->name, audit.droppedNonFinite));
  }
}

void addAvatarRows(const Inspected& inspected, const AlignedBox3d& action, ViewDocument& document) {
  const Avatar& body = *inspected.body();
  const AvatarAudit audit = auditAvatar(body, restPose(body.skeleton()));
  std::vector<ViewRow>& rows = document.summary;
  rows.push_back({"avatar", fmt::format("{} links, {} LSS", audit.links, audit.lss),
                  inspected.isMadeUp ? "made of the clip's bones" : ""});
  rows.push_back({"size of the avatar", sizeText(audit.extent), "in its rest pose"});
  rows.push_back(
      {"radii", fmt::format("{:.3g} to {:.3g} m", audit.smallestRadius, audit.largestRadius), ""});
  if (inspected.played) {
    const Clip& clip = inspected.played->clip;
    rows.push_back({"clip",
                    fmt::format("{} frames, {:.4g} s", clip.frames.size(), clip.durationS()),
                    fmt::format("{:.5g} a second", 1.0 / clip.frameTimeS)});
    rows.push_back({"reach of the action", sizeText(action.sizes()), "around all poses"});
  }
  rows.push_back({"height of the avatar",
                  fmt::format("{:.4g} to {:.4g} m", action.min().y(), action.max().y()),
                  "where it is placed, over all poses"});
  const std::string name = document.avatars.front().name;
  for (const std::string& doubt : doubtsAbout(audit)) {
    document.notes.push_back(name + ": " + doubt);
  }
}

std::string titleOf(const ReplayRequest& request) {
  const std::string& body = request.motionPath.empty() ? request.avatarPath : request.motionPath;
  if (body.empty()) return fileName(request.scenePath);
  return fileName(body) + (request.scenePath.empty() ? "" : " in " + fileName(request.scenePath));
}

std::vector<ViewRow> settingsOf(const Inspected& inspected) {
  const ReplayRequest& request = inspected.request;
  std::vector<ViewRow> rows;
  if (inspected.scene() != nullptr) rows = sceneSettings(request);
  if (!request.avatarPath.empty()) rows.push_back({"avatar", fileName(request.avatarPath), ""});
  if (inspected.body() != nullptr) {
    for (ViewRow& row : clipSettings(request)) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

Result<std::shared_ptr<const Inspected>> inspect(const ReplayRequest& request) {
  FORETOUCH_ASSERT(!request.scenePath.empty() || !request.avatarPath.empty() ||
                   !request.motionPath.empty());
  auto inspected = std::make_shared<Inspected>();
  inspected->request = request;
  FORETOUCH_CHECK(loadBody(*inspected));
  if (!request.scenePath.empty()) FORETOUCH_CHECK(loadLevel(*inspected));
  loadMeshes(*inspected);
  return std::shared_ptr<const Inspected>(std::move(inspected));
}

Result<ViewDocument> documentOf(const Inspected& inspected, const ReportOptions& options,
                                const ReportProgress& progress) {
  const ReplayRequest& request = inspected.request;
  ViewDocument document;
  document.kind = ViewKind::Inspection;
  document.title = titleOf(request);
  document.settings = settingsOf(inspected);
  document.notes = inspected.notes;
  AlignedBox3d action;
  if (const Avatar* const body = inspected.body()) {
    std::optional<Query> question;
    if (inspected.scene() != nullptr) {
      question = touchQuestion(*body, *inspected.scene(), QueryOptions{});
    }
    TrackBuilder track(*body, std::move(question));
    FORETOUCH_CHECK(addTrack(inspected, options, track, document.notes, progress));
    action = track.box();
    ViewAvatar avatar;
    avatar.name = fileName(inspected.isMadeUp ? request.motionPath : request.avatarPath);
    avatar.avatar = body;
    avatar.meshes = linkMeshes(inspected.triangles, document.notes);
    avatar.track = track.finish();
    document.avatars.push_back(std::move(avatar));
  }
  if (inspected.scene() != nullptr) {
    addScene(*inspected.scene(), request.scenePath, options.maxTriangles, action, document);
    addSceneRows(*inspected.scene(), document);
  }
  if (inspected.body() != nullptr) addAvatarRows(inspected, action, document);
  if (inspected.played) {
    const PlayedClip& played = *inspected.played;
    for (std::string& remark : remarksOnClip(played.avatar, played.clip, played.match,
                                             request.avatarPath, request.motionPath)) {
      document.notes.push_back(std::move(remark));
    }
  }
  FORETOUCH_TRY(document.checks, checksOf(inspected));
  return document;
}

}  // namespace foretouch::tools
