#include "middleware/world/body_system.h"

#include <algorithm>
#include <limits>

#include "lss/assert.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

/// The sum of the longest arms, from the frame that the pose hangs in.
double armsOf(const TrackPiece& piece) {
  double sum = 0.0;
  for (std::size_t j = 0; j < piece.from->translations.size(); ++j) {
    sum += std::max(piece.from->translations[j].norm(), piece.to->translations[j].norm());
  }
  return sum;
}

/// Appends them as numbers: many times as fast as one by one.
void append(const Pose& part, Pose& all) {
  const std::size_t first = all.rotations.size(), count = part.rotations.size();
  if (count == 0) return;
  all.rotations.resize(first + count);
  all.translations.resize(first + count);
  std::copy_n(part.rotations[0].coeffs().data(), 4 * count, all.rotations[first].coeffs().data());
  std::copy_n(part.translations[0].data(), 3 * count, all.translations[first].data());
}

void clear(Pose& pose) {
  pose.rotations.clear();
  pose.translations.clear();
}

}  // namespace

const ChainMotion& PieceMotions::of(const SystemMember& member) {
  const TrackPiece& piece = member.piece;
  Known* oldest = known_.data();
  for (Known& known : known_) {
    if (known.body == member.body && known.episodeUs == member.episode->beginUs &&
        known.beginUs == piece.beginUs && known.endUs == piece.endUs) {
      known.lastUse = ++uses_;
      return known.motion;
    }
    if (known.lastUse < oldest->lastUse) oldest = &known;
  }
  oldest->motion.assign(member.episode->track.skeleton(), *piece.from, *piece.to);
  oldest->body = member.body;
  oldest->episodeUs = member.episode->beginUs;
  oldest->beginUs = piece.beginUs;
  oldest->endUs = piece.endUs;
  oldest->lastUse = ++uses_;
  return oldest->motion;
}

void PieceMotions::clear() {
  for (Known& known : known_) known.body = -1;
}

void SystemSpans::begin(const WorldParts& world, BodyId a, BodyId b, std::int64_t fromUs,
                        std::int64_t toUs) {
  world_ = &world;
  a_ = a;
  b_ = b;
  beginUs_ = endUs_ = spanUs_ = nextUs_ = fromUs;
  toUs_ = toUs;
}

bool SystemSpans::next() {
  while (nextUs_ < toUs_) {
    beginUs_ = spanUs_ = nextUs_;
    members_.clear();
    if (addMember(a_) && (b_ == kStillScene || addMember(b_))) return findEnd();
    // A body that is not there yet appears with its first episode.
    nextUs_ = toUs_;
    for (const BodyId body : {a_, b_}) {
      if (body == kStillScene || world_->body(body).episodeAt(beginUs_) != nullptr) continue;
      nextUs_ = std::min(nextUs_, world_->body(body).nextEpisodeUs(beginUs_));
    }
  }
  return false;
}

bool SystemSpans::widen(const PieceShare& share) {
  if (b_ != kStillScene || members_.size() != 1) return false;
  const TrackPiece& piece = members_.front().piece;
  const std::int64_t length = piece.endUs - piece.beginUs;
  if (piece.isHeld || (length > share.wholeUs && share.partUs == 0)) return false;
  return widenTo(piece.beginUs, piece.endUs, length > share.wholeUs ? share.partUs : length);
}

bool SystemSpans::widenToPieces(std::int64_t mostUs) {
  std::int64_t begin = std::numeric_limits<std::int64_t>::min();
  std::int64_t end = std::numeric_limits<std::int64_t>::max();
  for (const SystemMember& member : members_) {
    if (member.piece.isHeld && !member.episode->isHeldFast()) return false;
    begin = std::max(begin, member.piece.beginUs);
    if (!member.piece.isHeld) end = std::min(end, member.piece.endUs);
  }
  return widenTo(begin, end, mostUs);
}

/// Widens to a part of that length, from `begin` on; the last one may be shorter.
bool SystemSpans::widenTo(std::int64_t begin, std::int64_t end, std::int64_t partUs) {
  FORETOUCH_ASSERT(begin <= beginUs_ && end >= endUs_);
  const std::int64_t from = begin + (beginUs_ - begin) / partUs * partUs;
  const std::int64_t to = end - from > partUs ? from + partUs : end;
  if (endUs_ > to) return false;
  beginUs_ = from;
  endUs_ = to;
  return true;
}

void SystemSpans::narrow() {
  beginUs_ = spanUs_;
  endUs_ = nextUs_;
}

/// Adds it behind those that carry it. False: one of them is not there at the span's begin. What
/// carries a body is there before it does.
bool SystemSpans::addMember(BodyId body) {
  world_->chainAt(body, beginUs_, chain_);
  for (; !chain_.empty(); chain_.pop_back()) {
    const BodyId id = chain_.back();
    if (placeOf(id) >= 0) continue;
    const Episode* const episode = world_->body(id).episodeAt(beginUs_);
    if (episode == nullptr) return false;
    SystemMember member{id, world_->body(id).kind, -1, kNoParent, 0, episode, {}};
    if (episode->carrier) {
      member.carrier = placeOf(episode->carrier->body);
      member.link = episode->carrier->link;
      member.chain = members_[slotOf(member.carrier)].chain;
    } else if (!members_.empty()) {
      member.chain = 1;
    }
    members_.push_back(member);
  }
  return true;
}

/// Finds the span's end. False: one of them is undecided from the span's begin on.
bool SystemSpans::findEnd() {
  endUs_ = toUs_;
  isAssumed_ = false;
  for (SystemMember& member : members_) {
    const WorldBody& body = world_->body(member.body);
    member.piece = member.episode->track.pieceAt(beginUs_);
    endUs_ = std::min({endUs_, body.nextEpisodeUs(beginUs_), member.piece.endUs});
    if (!member.piece.isHeld || member.episode->isHeldFast()) continue;
    if (body.options.whenSilent != WhenSilent::HoldStill) {
      nextUs_ = toUs_;
      return false;
    }
    isAssumed_ = true;
  }
  nextUs_ = endUs_;
  return true;
}

std::int32_t SystemSpans::placeOf(BodyId body) const {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].body == body) return static_cast<std::int32_t>(i);
  }
  return -1;
}

/// How far, at most, points of those that are carried are from the links that they hang on.
double SystemSpans::reachOfCarried() const {
  double reach = 0.0;
  for (const SystemMember& member : members_) {
    if (member.carrier < 0) continue;
    reach += armsOf(member.piece) + world_->kinds[slotOf(member.kind)].rho;
  }
  return reach;
}

void SystemSpans::poses(const Eigen::Vector3d& origin, bool isMerged, PieceMotions& motions,
                        SystemPoses& poses) const {
  for (ChainPoses& chain : poses.chains) {
    clear(chain.from);
    clear(chain.to);
  }
  poses.rounding = 0.0;
  for (const SystemMember& member : members_) {
    ChainPoses& chain = poses.chains[isMerged ? 0 : slotOf(member.chain)];
    const std::size_t first = chain.from.translations.size();
    appendPart(member, motions, chain, poses);
    if (member.carrier >= 0) continue;
    const Skeleton& skeleton = world_->kinds[slotOf(member.kind)].skeleton;
    for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
      if (skeleton.parent(joint) != kNoParent) continue;
      chain.from.translations[first + slotOf(joint)] -= origin;
      chain.to.translations[first + slotOf(joint)] -= origin;
    }
  }
}

void SystemSpans::appendPart(const SystemMember& member, PieceMotions& motions, ChainPoses& chain,
                             SystemPoses& poses) const {
  const TrackPiece& piece = member.piece;
  const bool isWhole = piece.beginUs == beginUs_ && piece.endUs == endUs_;
  if (isWhole || piece.isHeld) {
    append(*piece.from, chain.from);
    append(*piece.to, chain.to);
    return;
  }
  const ChainMotion& motion = motions.of(member);
  partOf(piece, motion, beginUs_, endUs_, poses.partFrom, poses.partTo);
  append(poses.partFrom, chain.from);
  append(poses.partTo, chain.to);
  const double rho = world_->kinds[slotOf(member.kind)].rho + reachOfCarried();
  poses.rounding =
      (poses.rounding + partRounding(piece, motion, beginUs_, endUs_, rho)) * kInflation;
}

}  // namespace foretouch::internal
