#include "middleware/ask/rough_boxes.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {

void PosesReach::clear() {
  squares_.clear();
  roots_ = Aabb();
}

void PosesReach::add(const Skeleton& skeleton, const Pose& pose) {
  squares_.resize(pose.translations.size(), 0.0);
  for (JointId joint = 0; slotOf(joint) < squares_.size(); ++joint) {
    const Eigen::Vector3d& arm = pose.translations[slotOf(joint)];
    if (skeleton.parent(joint) == kNoParent) {
      roots_.add(arm);
    } else {
      squares_[slotOf(joint)] = std::max(squares_[slotOf(joint)], arm.squaredNorm());
    }
  }
}

/// In between, no arm is longer than at one of its two ends, and each root is on the line between
/// its two places.
Aabb PosesReach::box(const BodyKind& kind) {
  reaches_.resize(squares_.size());
  double most = 0.0;
  for (JointId joint = 0; slotOf(joint) < squares_.size(); ++joint) {
    const JointId parent = kind.skeleton.parent(joint);
    double& reach = reaches_[slotOf(joint)];
    reach =
        parent == kNoParent ? 0.0 : reaches_[slotOf(parent)] + std::sqrt(squares_[slotOf(joint)]);
    most = std::max(most, reach);
  }
  Aabb box = roots_;
  box.grow((most + kind.rho) * kInflation + kUnderflow);
  return box;
}

const Aabb* RoughBoxes::at(const WorldBody& body, const BodyKind& kind, std::int64_t utimeUs) {
  if (body.episodes.empty()) return nullptr;
  const std::int64_t stretch = utimeUs >> kStretchShift;
  Kept& kept = kept_[static_cast<std::size_t>(stretch) % kStretchesKept];
  const std::int64_t lastEpisodeUs = body.episodes.back().beginUs;
  const bool isSame = kept.stretch == stretch && kept.lastEpisodeUs == lastEpisodeUs;
  if (isSame && utimeUs >= kept.fromUs && utimeUs < kept.untilUs) return &kept.box;
  const Episode* const episode = body.episodeAt(utimeUs);
  if (episode == nullptr || episode->carrier) return nullptr;
  const Track& track = episode->track;
  if (utimeUs < track.knownFromUs() || utimeUs >= track.knownUntilUs()) return nullptr;
  const std::int64_t length = std::int64_t{1} << kStretchShift;
  // What was forgotten since cannot be added to any more.
  const bool goesOn = kept.untilUs >= track.knownFromUs();
  if (!isSame || !goesOn || kept.episodeUs != episode->beginUs || utimeUs < kept.fromUs) {
    kept.reach.clear();
    kept.stretch = stretch;
    kept.lastEpisodeUs = lastEpisodeUs;
    kept.episodeUs = episode->beginUs;
    kept.fromUs = kept.untilUs = std::max(stretch * length, track.knownFromUs());
  }
  const std::int64_t endUs =
      std::min({(stretch + 1) * length, track.knownUntilUs(), body.nextEpisodeUs(utimeUs)});
  for (std::int64_t us = kept.untilUs; us < endUs;) {
    const TrackPiece piece = track.pieceAt(us);
    // Where one piece ends, the next one begins.
    if (us == kept.fromUs) kept.reach.add(kind.skeleton, *piece.from);
    kept.reach.add(kind.skeleton, *piece.to);
    us = piece.endUs;
  }
  kept.untilUs = endUs;
  kept.box = kept.reach.box(kind);
  return &kept.box;
}

}  // namespace foretouch::internal
