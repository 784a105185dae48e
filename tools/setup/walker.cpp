#include "tools/setup/walker.h"

#include <algorithm>
#include <utility>

#include "articulated/motion.h"
#include "articulated/try.h"
#include "assets/bvh/body_parts.h"
#include "lss/index.h"

namespace foretouch::tools {

Walker::Walker(const WalkingBody& body, const Level& level, Query query)
    : body_(&body),
      level_(&level),
      query_(std::move(query)),
      trunk_(trunkOf(body.avatar.skeleton())),
      feet_(feetOf(body.avatar.skeleton())),
      scratch_(std::make_unique<Scratch>()) {}

Result<Walker> Walker::build(const WalkingBody& body, const Level& level) {
  FORETOUCH_TRY(auto query, Query::build(body.avatar, level.scene()));
  return Walker(body, level, std::move(query));
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
