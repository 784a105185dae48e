#include "middleware/solid_world/around_body.h"

#include <algorithm>

#include "articulated/track.h"
#include "lss/assert.h"
#include "middleware/solid/tree_pose.h"

namespace foretouch::internal {

double shareOf(std::int64_t beginUs, std::int64_t endUs, std::int64_t us) {
  if (us >= endUs) return 1.0;
  return static_cast<double>(us - beginUs) / static_cast<double>(endUs - beginUs);
}

Eigen::AlignedBox3d sweptBox(const std::vector<std::vector<Lss>>& volumes,
                             const ChainMotion& motion, std::vector<LinkState>& states) {
  Eigen::AlignedBox3d box;
  motion.statesAt(0.5, states);
  for (std::size_t link = 0; link < volumes.size(); ++link) {
    if (volumes[link].empty()) continue;
    // From the middle, no point goes farther than half of what its speed allows.
    const LinkState& middle = states[link];
    const MotionBounds bounds = motion.bounds(static_cast<LinkId>(link));
    for (const Lss& lss : volumes[link]) {
      const double rho = std::max(lss.a.norm(), lss.b.norm());
      const double by = lss.radius + 0.5 * bounds.speedAt(rho) + bounds.positionRoundingAt(rho);
      const Eigen::Vector3d around = Eigen::Vector3d::Constant(by * kInflation);
      for (const Eigen::Vector3d& end : {middle.pointAt(lss.a), middle.pointAt(lss.b)}) {
        box.extend(end - around);
        box.extend(end + around);
      }
    }
  }
  return box;
}

void AroundBody::begin(BodyId id) {
  body = id;
  isSolid = isAssumed = false;
  count_ = 0;
  box_.setEmpty();
}

AroundLeg& AroundBody::addLeg() {
  if (count_ == legs_.size()) legs_.emplace_back();
  return legs_[count_++];
}

void AroundBody::settle() {
  AroundLeg& leg = legs_[count_ - 1];
  motion_.assign(leg.kind->skeleton, leg.from, leg.to);
  Eigen::AlignedBox3d swept = sweptBox(leg.kind->volumes, motion_, states_);
  const Eigen::Vector3d off = Eigen::Vector3d::Constant(leg.rounding);
  swept.min() -= off;
  swept.max() += off;
  box_.extend(swept);
}

const AroundLeg* AroundBody::legAt(std::int64_t us) const {
  for (std::size_t i = 0; i < count_; ++i) {
    if (legs_[i].beginUs <= us && us <= legs_[i].endUs) return &legs_[i];
  }
  return nullptr;
}

void AroundBody::placeAt(const AroundLeg& leg, std::int64_t us,
                         std::vector<LinkState>& states) const {
  motion_.assign(leg.kind->skeleton, leg.from, leg.to);
  motion_.poseAt(shareOf(leg.beginUs, leg.endUs, us), pose_);
  placeLinks(leg.kind->skeleton, pose_, states);
}

double PartOfMotion::cut(const Skeleton& skeleton, const Pose& from, const Pose& to,
                         std::int64_t beginUs, std::int64_t endUs, std::int64_t partBeginUs,
                         std::int64_t partEndUs, double rho) {
  const TrackPiece piece{beginUs, endUs, &from, &to, isSamePose(from, to)};
  motion_.assign(skeleton, from, to);
  partOf(piece, motion_, partBeginUs, partEndUs, from_, to_);
  return partRounding(piece, motion_, partBeginUs, partEndUs, rho);
}

}  // namespace foretouch::internal
