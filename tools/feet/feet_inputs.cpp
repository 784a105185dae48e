#include "tools/feet/feet_inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/clip/clip_file.h"
#include "assets/import/scene_import.h"
#include "lss/index.h"
#include "tools/console.h"
#include "tools/floor/heels.h"
#include "tools/floor/in_place.h"
#include "tools/inputs/clip_pose.h"
#include "tools/inputs/first_pose.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// A foot looks for its ground from this far above it: over the steps of stairs, below seats.
constexpr double kLookFrom = 0.25;
/// A body farther than this above everything (m) stands on nothing.
constexpr double kLookDown = 3.0;
/// Where a body is below a board, the floor is at most so far below its foot (m): no storey is as
/// low, so that a person who lies below a thin floor is not taken to be in the room underneath.
constexpr double kRoomBelow = 1.2;
/// Below a surface, the next one is looked for from here on (m): beyond the cast's tolerance.
constexpr double kNextSurface = 0.003;
/// A plain floor goes on this far beyond the body (m).
constexpr double kFloorMargin = 20.0;

Result<PlayedClip> loadPlayed(const FeetRequest& request) {
  if (!request.avatarPath.empty()) return loadPlayedClip(request);
  if (clipFormatOf(request.motionPath) != ClipFormat::Model) return loadClipAlone(request);
  return Error::in(
      "--avatar", ErrorCode::Empty,
      "expected the body's avatar file beside " + inQuotes(request.motionPath) +
          ": only of a BVH clip and of a robot a body is made; to make one of a model with a skin: "
          "foretouch avatar mesh " +
          inQuotes(request.motionPath) + " -o body.json");
}

Result<Level> sceneOf(const FeetRequest& request) {
  FORETOUCH_TRY(auto imported, importScene(request.scenePath, request.sceneImport));
  printNotes(request.scenePath, imported.report.notes);
  return inFile(Level::build(std::move(imported.scene)), request.scenePath);
}

/// A square at y = 0 around these places.
Result<Level> plainFloor(const Eigen::AlignedBox3d& around) {
  const Vector3d low = around.min().array() - kFloorMargin;
  const Vector3d high = around.max().array() + kFloorMargin;
  const Vector3d a(low.x(), 0, low.z()), b(low.x(), 0, high.z()), c(high.x(), 0, high.z()),
      d(high.x(), 0, low.z());
  return Level::build({{Triangle{{a, b, c}}, Triangle{{a, c, d}}}, {0, 0}, {"floor"}});
}

/// The box around the clip's roots and what floats, wherever its placement and a fit turn them.
Eigen::AlignedBox3d boxOf(const FeetInputs& inputs) {
  const Clip& clip = inputs.played.clip;
  double reach = 0.0;
  for (const Pose& pose : clip.frames) {
    for (JointId joint = 0; joint < clip.skeleton.numJoints(); ++joint) {
      if (clip.skeleton.parent(joint) != kNoParent && !clip.hasTranslation[slotOf(joint)]) continue;
      reach = std::max(reach, pose.translations[slotOf(joint)].norm());
    }
  }
  const Vector3d origin = inputs.request.placement.origin;
  return {origin - Vector3d::Constant(reach), origin + Vector3d::Constant(reach)};
}

/// How far the clip's own floor, once level, is above what is below its rests: the median. Nothing
/// if most of them are above a void.
std::optional<double> heightAboveGround(const FeetInputs& inputs, const FloorFit& fit,
                                        const std::vector<FootRest>& rests) {
  const Eigen::Isometry3d level = fit.levelledTo(fit.height);
  std::vector<double> above;
  for (const FootRest& rest : rests) {
    if (std::abs(fit.heightOf(rest.p_W)) > kOnFloor) continue;
    const Vector3d p_W = level * rest.p_W;
    const auto ground = inputs.groundBelow(p_W);
    if (ground) above.push_back(fit.height - ground->p_W.y());
  }
  if (2 * above.size() < fit.onFloor || above.empty()) return std::nullopt;
  const auto middle = above.begin() + static_cast<std::ptrdiff_t>(above.size() / 2);
  std::nth_element(above.begin(), middle, above.end());
  return *middle;
}

/// Rests are looked for this often (Hz): more poses say no more.
constexpr double kRestHz = 60.0;

std::int64_t restStride(const FeetInputs& inputs) {
  return std::max<std::int64_t>(1, std::llround(1.0 / (kRestHz * inputs.stepS())));
}

RestingPoses restPoses(const FeetInputs& inputs) {
  return [&inputs, stride = restStride(inputs)](std::int64_t rest) {
    return inputs.poseAt(rest * stride);
  };
}

/// The rests in the clip's begin, at most so long (s).
Result<std::vector<FootRest>> restsOf(const FeetInputs& inputs,
                                      double mostS = std::numeric_limits<double>::infinity()) {
  const std::int64_t stride = restStride(inputs);
  const double most = mostS / inputs.stepS(), all = static_cast<double>(inputs.steps());
  return footRestsOf(inputs.body, static_cast<std::int64_t>(std::min(most, all)) / stride,
                     static_cast<double>(stride) * inputs.stepS(), restPoses(inputs));
}

/// A body that is made of the clip's bones gets heels; an avatar that was given stays as it is.
Result<Done> addHeels(FeetInputs& inputs) {
  constexpr double kUsualWayS = 600.0;  // how a person stands shows in ten minutes
  FORETOUCH_TRY(const auto rests, restsOf(inputs, kUsualWayS));
  std::size_t lowered = 0;
  FORETOUCH_TRY(auto body, withHeelsDown(inputs.body, rests, restPoses(inputs), &lowered));
  const bool isMade = inputs.request.avatarPath.empty();
  if (isMade) inputs.body = std::move(body);
  (isMade ? inputs.heelsMade : inputs.heelsMissing) = lowered;
  return Done{};
}

bool isInPlace(const FeetInputs& inputs) {
  const auto poses = [&](std::int64_t step) { return inputs.poseAt(step); };
  return walksInPlace(inputs.body, inputs.steps(), inputs.stepS(), poses).has_value();
}

/// Moves the clip until its own floor lies on the ground.
Result<Done> fitGround(FeetInputs& inputs) {
  const std::string& clip = inputs.request.motionPath;
  FORETOUCH_TRY(const auto rests, restsOf(inputs));
  const auto named = [&](Error error) {
    error.file = "--ground fit";
    error.message = clip + ": " + error.message;
    if (isInPlace(inputs)) error.message += "; it walks in place, so each foot slides";
    if (const auto doubt = doubtOfStature(inputs)) error.message += "; " + *doubt;
    return error;
  };
  FORETOUCH_TRY_OR(named, const FloorFit fit, fitFloor(rests));
  const auto above =
      inputs.isPlain ? std::optional<double>(fit.height) : heightAboveGround(inputs, fit, rests);
  if (!above) {
    return Error::in("--ground fit", ErrorCode::Empty,
                     fmt::format("{}: its feet rest at {:.3f} m, and below most of these places "
                                 "the scene has nothing within {:g} m: --place puts it elsewhere",
                                 clip, fit.height, kLookDown));
  }
  inputs.fitShift = -*above;
  inputs.correction = fit.levelledTo(fit.height - *above);
  inputs.fit = fit;
  return Done{};
}

/// The first surface from a point straight down to another one, if it is not a wall.
std::optional<GroundSurface> surfaceFrom(const Level& level, const Vector3d& from,
                                         const Vector3d& to) {
  if (to.y() >= from.y()) return std::nullopt;
  const auto hit = level.cast(from, to);
  if (!hit) return std::nullopt;
  const Triangle& triangle = level.scene().triangle(hit->triangle);
  const Vector3d front = level.normal(hit->triangle);
  const Vector3d normal = front.y() < 0.0 ? Vector3d(-front) : front;
  if (normal.y() < kWalkableUp) return std::nullopt;
  // The cast ends within its tolerance: the triangle's plane says where it is.
  const double down = normal.dot(from - triangle.vertices[0]) / normal.y();
  return GroundSurface{from - Vector3d(0, down, 0), normal};
}

/// Where the bones from the body to this point of a foot go through the scene.
std::vector<Vector3d> crossedBy(const FeetInputs& inputs, const RestingLimb& limb,
                                const std::vector<LinkState>& states, const Vector3d& p_W) {
  std::vector<Vector3d> crossed;
  Vector3d to = p_W;
  for (JointId joint = limb.ankle; joint != kNoParent;
       joint = inputs.body.avatar.skeleton().parent(joint)) {
    const Vector3d from = states[slotOf(joint)].p_WL, way = to - from;
    const auto hit = way.isZero(kNextSurface) ? std::nullopt : inputs.level.cast(from, to);
    if (hit) crossed.emplace_back(from + hit->distance * way.normalized());
    to = from;
  }
  return crossed;
}

}  // namespace

Result<Pose> FeetInputs::poseAt(std::int64_t step) const {
  FORETOUCH_TRY(auto pose, poseAtFrame({played.avatar, played.clip, played.match, request.placement,
                                        played.isUpright, request.motionPath},
                                       played.steps.frameOf(step)));
  pose = body.poseOf(std::move(pose));
  const Skeleton& skeleton = body.avatar.skeleton();
  const Eigen::Quaterniond turn(correction.linear());
  for (JointId joint = 0; joint < body.jointsBefore; ++joint) {
    if (skeleton.parent(joint) != kNoParent) continue;
    Quaternion& rotation = pose.rotations[slotOf(joint)];
    rotation = Quaternion(turn * Eigen::Quaterniond(rotation)).normalized();
    Vector3d& translation = pose.translations[slotOf(joint)];
    translation = correction * translation;
  }
  return inFile(validatedPose(skeleton, std::move(pose)), request.motionPath);
}

std::optional<GroundSurface> FeetInputs::groundBelow(const Vector3d& p_W) const {
  if (isPlain) return GroundSurface{Vector3d(p_W.x(), 0.0, p_W.z()), Vector3d::UnitY()};
  return surfaceFrom(level, p_W + Vector3d(0, kLookFrom, 0), p_W - Vector3d(0, kLookDown, 0));
}

std::optional<GroundSurface> FeetInputs::groundOf(const RestingLimb& limb,
                                                  const std::vector<LinkState>& states,
                                                  const Vector3d& p_W) const {
  const auto first = groundBelow(p_W);
  if (isPlain || !first || first->heightOf(p_W) >= 0.0) return first;
  const std::vector<Vector3d> crossed = crossedBy(*this, limb, states, p_W);
  const Vector3d lowest = p_W - Vector3d(0, kRoomBelow, 0);
  for (auto at = first; at;
       at = surfaceFrom(level, at->p_W - Vector3d(0, kNextSurface, 0), lowest)) {
    for (const Vector3d& p : crossed) {
      if (std::abs(at->heightOf(p)) <= kSameSurface) return at;
    }
    if (crossed.empty() && at->heightOf(p_W) >= 0.0) return at;
  }
  return first;
}

Result<FeetInputs> loadFeetInputs(const FeetRequest& request) {
  FORETOUCH_TRY(auto played, loadPlayed(request));
  FORETOUCH_TRY(auto body, inFile(restingBodyOf(played.avatar, request.feet), request.bodyPath()));
  const bool isPlain = request.scenePath.empty();
  FORETOUCH_TRY(auto level,
                isPlain ? plainFloor(Eigen::AlignedBox3d(Vector3d(0, 0, 0))) : sceneOf(request));
  FeetInputs inputs{
      request, std::move(played), std::move(body), std::move(level), isPlain, 0, 0, {}, 0.0};
  if (request.robotPath.empty()) FORETOUCH_CHECK(addHeels(inputs));
  if (request.ground == GroundFrom::Fit) FORETOUCH_CHECK(fitGround(inputs));
  if (!isPlain) return inputs;
  FORETOUCH_TRY(inputs.level, plainFloor(boxOf(inputs)));
  return inputs;
}

}  // namespace foretouch::tools
