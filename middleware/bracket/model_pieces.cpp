#include "middleware/bracket/model_pieces.h"

#include <algorithm>
#include <cmath>

#include "articulated/link_places.h"

namespace foretouch::internal {
namespace {

/// Adds up what the joints of each chain stray (bracket.md 3); false if that is any amount.
bool addStrays(const Skeleton& skeleton, const ModelMotion& model,
               const std::vector<std::uint8_t>& isMoved, ModelPiece& piece) {
  bool isFinite = true;
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    if (isMoved[slotOf(joint)] == 0) continue;
    const JointStray own = model.strayOf(joint, piece.stepBegin, piece.stepEnd);
    LinkStray& stray = piece.strays[slotOf(joint)];
    stray = {own.turn, own.shift};
    const JointId parent = skeleton.parent(joint);
    if (parent != kNoParent) {
      const LinkStray& above = piece.strays[slotOf(parent)];
      const double length = piece.motion.jointBounds(joint).length + own.shift;
      stray.turn += above.turn;
      stray.shift += above.shift + above.turn * length;
    }
    isFinite = isFinite && std::isfinite(stray.turn);
  }
  return isFinite;
}

}  // namespace

void ModelPieces::resize(int count) {
  // Room for all at once: evaluators refer to motions.
  if (pieces_.empty()) {
    pieces_.resize(countOf(kMost));
    at_.resize(countOf(kMost) + 1);
  }
  count_ = count;
  isContinuous_ = true;
  for (int k = 0; k < count; ++k) {
    piece(k).begin = static_cast<double>(k) / count;
    piece(k).end = static_cast<double>(k + 1) / count;
  }
  for (Placed& placed : at_) {
    placed.isGiven = false;
    placed.known = nullptr;
  }
}

int ModelPieces::at(double t) const {
  return std::clamp(static_cast<int>(t * count_), 0, count_ - 1);
}

void ModelPieces::setPiece(int k, const Skeleton& skeleton) {
  ModelPiece& now = piece(k);
  now.motion.assign(skeleton, at_[slotOf(k)].pose, at_[slotOf(isContinuous_ ? k + 1 : k)].pose);
  now.evaluator.reset(now.motion);
  now.strays.assign(countOf(skeleton.numJoints()), {});
}

const std::vector<LinkState>& ModelPieces::places(const Avatar& avatar, int k) {
  Placed& placed = at_[slotOf(k)];
  if (placed.known != nullptr) return *placed.known;
  if (!placed.isGiven) placesAt(avatar.skeleton(), placed.pose, placed.places);
  placed.known = placed.isGiven ? &places_->at(avatar, placed.pose) : &placed.places;
  return *placed.known;
}

void ModelPieces::poseAt(double t, const ModelMotion& model, const PieceCut& cut,
                         Pose& pose) const {
  const bool isInside = t != 0.0 && t != 1.0;
  if (model.isConstantRate() && isInside) return whole_.poseAt(t, pose);
  model.poseAt(t, cut.isMoved, pose);
}

bool ModelPieces::cut(const Avatar& avatar, const AskedPart& part, const ModelMotion& model,
                      const PieceCut& cut) {
  resize(cut.count);
  places_ = &cut.places;
  const Skeleton& skeleton = avatar.skeleton();
  const bool isWhole = part.begin == 0.0 && part.end == 1.0;
  const bool strays = !model.isConstantRate() || !isWhole || count_ > 1;
  if (model.isConstantRate() && strays) whole_.assign(skeleton, *part.step.from, *part.step.to);
  bool isFinite = true;
  poseAt(part.begin, model, cut, at_[0].pose);
  at_[0].isGiven = part.begin == 0.0;
  at_[slotOf(count_)].isGiven = part.end == 1.0;
  for (int k = 0; k < count_; ++k) {
    ModelPiece& now = piece(k);
    now.stepBegin = part.at(now.begin);
    now.stepEnd = part.at(now.end);
    poseAt(now.stepEnd, model, cut, at_[slotOf(k) + 1].pose);
    setPiece(k, skeleton);
    if (strays) isFinite = addStrays(skeleton, model, cut.isMoved, now) && isFinite;
  }
  return isFinite;
}

void ModelPieces::stand(const Skeleton& skeleton, const PosedStep& step) {
  resize(2);
  isContinuous_ = false;
  at_[0].pose = *step.from;
  at_[1].pose = *step.to;
  for (int k = 0; k < 2; ++k) setPiece(k, skeleton);
}

bool ModelPieces::goOn(const Skeleton& skeleton, const PosedStep& step, double horizon) {
  if (!ModelMotion::goOn(step, horizon, countOf(kMost), endsS_, ends_)) return false;
  resize(static_cast<int>(ends_.size()));
  at_[0].pose = *step.to;
  for (int k = 0; k < count_; ++k) {
    piece(k).begin = k == 0 ? 0.0 : endsS_[slotOf(k - 1)] / horizon;
    piece(k).end = k + 1 == count_ ? 1.0 : endsS_[slotOf(k)] / horizon;
    at_[slotOf(k) + 1].pose = ends_[slotOf(k)];
    setPiece(k, skeleton);
  }
  return true;
}

}  // namespace foretouch::internal
