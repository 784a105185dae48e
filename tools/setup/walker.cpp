#include "tools/setup/walker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "articulated/motion.h"
#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bvh/body_parts.h"
#include "lss/index.h"
#include "tools/inputs/first_pose.h"
#include "tools/inputs/name_pattern.h"
#include "tools/inputs/played_clip.h"

namespace foretouch::tools {

using Eigen::Vector3d;

namespace {

/// The number of poses of a clip among which to look for room.
constexpr std::size_t kPosesLookedAt = 64;
/// The share of all poses that may dip lower than the one that stands: a T-pose at the clip's
/// begin, a toe that the capture puts into the floor.
constexpr double kMayDip = 0.1;

/// How high the body is in its usual pose, so that raised arms and crouching do not count.
double usualHeight(const WalkingBody& body) {
  std::vector<double> heights;
  for (const Pose& pose : body.poses) {
    heights.push_back(boxInPose(body.avatar, pose).sizes().y());
  }
  const auto median = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), median, heights.end());
  return *median;
}

}  // namespace

Result<WalkingBody> walkingBody(const PlacedClip& clip, const FrameRange& frames) {
  WalkingBody body{clip.avatar, {}};
  const auto stride =
      static_cast<std::int64_t>((frames.count() + kPosesLookedAt - 1) / kPosesLookedAt);
  for (std::int64_t frame = frames.first; frame <= frames.last; frame += stride) {
    FORETOUCH_TRY(auto pose, poseAtFrame(clip, frame));
    body.poses.push_back(std::move(pose));
  }
  return body;
}

std::size_t standingPose(const WalkingBody& body) {
  // The first one is not asked where there are others: many clips begin in a T-pose.
  const std::size_t first = body.poses.size() > 3 ? 1 : 0;
  std::vector<std::pair<double, std::size_t>> lowest;
  for (std::size_t i = first; i < body.poses.size(); ++i) {
    lowest.emplace_back(boxInPose(body.avatar, body.poses[i]).min().y(), i);
  }
  std::sort(lowest.begin(), lowest.end());
  return lowest[static_cast<std::size_t>(kMayDip * static_cast<double>(lowest.size()))].second;
}

Walker::Walker(const WalkingBody& body, const Level& level, Query query)
    : body_(&body),
      level_(&level),
      standing_(standingPose(body)),
      query_(std::move(query)),
      trunk_(trunkOf(body.avatar.skeleton())),
      feet_(feetOf(body.avatar.skeleton())),
      scratch_(std::make_unique<Scratch>()) {}

Result<Walker> Walker::build(const WalkingBody& body, const Level& level, const Vector3d& around,
                             const std::string& on) {
  FORETOUCH_TRY(auto query, Query::build(body.avatar, level.scene()));
  Walker walker(body, level, std::move(query));
  walker.on_ = on;
  FORETOUCH_CHECK(walker.findFloor(around));
  return walker;
}

Result<Done> Walker::findFloor(const Vector3d& around) {
  const Scene& scene = level_->scene();
  std::vector<bool> isAsked(scene.objectNames().size(), false);
  if (!on_.empty()) {
    const auto asked = matching(on_, scene.objectNames());
    if (asked.empty()) {
      return Error::in("--on", ErrorCode::UnknownName,
                       "no object of the scene is called " + inQuotes(on_) + "; expected " +
                           firstOf(scene.objectNames()));
    }
    for (const ObjectId object : asked) isAsked[static_cast<std::size_t>(object)] = true;
  }
  auto floor = WalkableFloor::build(
      *level_, roomOf(usualHeight(*body_)), around,
      [&](ObjectId object) { return isAsked[static_cast<std::size_t>(object)]; });
  if (floor.ok()) {
    floor_ = std::move(floor).value();
  } else {
    floorDoubt_ = floor.error().message;
  }
  return Done{};
}

Pose Walker::poseAt(std::size_t index, const Placement& place) const {
  return placed(body_->avatar.skeleton(), body_->poses[index], place);
}

std::vector<Inside> Walker::insideAt(const Pose& pose) const {
  const ChainMotion still(body_->avatar.skeleton(), pose, pose);
  std::vector<Inside> inside;
  for (const LinkContact& contact : query_.answer(still, *scratch_).links) {
    if (contact.verdict != Verdict::StartsInContact) continue;
    inside.push_back({contact.link, level_->scene().object(contact.triangle)});
  }
  return inside;
}

std::optional<Rest> Walker::sink(const Pose& pose, double depth) const {
  const Skeleton& skeleton = body_->avatar.skeleton();
  const Pose lower = placed(skeleton, pose, {false, {0.0, -depth, 0.0}, 0.0});
  const ChainMotion motion(skeleton, pose, lower);
  const StepContacts step = query_.answer(motion, *scratch_);
  const LinkContact* first = nullptr;
  for (const LinkContact& contact : step.links) {
    if (contact.verdict == Verdict::Clear || contact.triangle < 0) continue;
    if (first == nullptr || contact.toi < first->toi) first = &contact;
  }
  if (first == nullptr) return std::nullopt;
  return Rest{first->toi * depth, first->p_WScene, first->triangle};
}

bool Walker::isTrunk(LinkId link) const {
  return std::find(trunk_.begin(), trunk_.end(), link) != trunk_.end();
}

bool Walker::isFoot(LinkId link) const {
  return std::find(feet_.begin(), feet_.end(), link) != feet_.end();
}

}  // namespace foretouch::tools
