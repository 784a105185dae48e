#include "middleware/bracket/model_pieces.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace foretouch::internal {
namespace {

/// Adds up what the joints of each chain stray (bracket.md 3); false if that is any amount.
bool addStrays(const Skeleton& skeleton, const ModelMotion& model, ModelPiece& piece) {
  bool isFinite = true;
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    const JointStray own = model.strayOf(joint, piece.begin, piece.end);
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
  if (pieces_.empty()) pieces_.resize(countOf(kMost));
  count_ = count;
  for (int k = 0; k < count; ++k) {
    piece(k).begin = static_cast<double>(k) / count;
    piece(k).end = static_cast<double>(k + 1) / count;
  }
}

int ModelPieces::at(double t) const {
  return std::clamp(static_cast<int>(t * count_), 0, count_ - 1);
}

void ModelPieces::setPiece(int k, const Skeleton& skeleton, const Pose& from, const Pose& to) {
  ModelPiece& now = piece(k);
  now.motion.assign(skeleton, from, to);
  now.evaluator.reset(now.motion);
  now.strays.assign(countOf(skeleton.numJoints()), {});
}

bool ModelPieces::cut(const Skeleton& skeleton, const PosedStep& step, const ModelMotion& model,
                      int count) {
  resize(count);
  bool isFinite = true;
  from_ = *step.from;
  for (int k = 0; k < count; ++k) {
    model.poseAt(piece(k).end, to_);
    setPiece(k, skeleton, from_, to_);
    if (!model.isConstantRate()) isFinite = addStrays(skeleton, model, piece(k)) && isFinite;
    std::swap(from_, to_);
  }
  return isFinite;
}

void ModelPieces::stand(const Skeleton& skeleton, const PosedStep& step) {
  resize(2);
  setPiece(0, skeleton, *step.from, *step.from);
  setPiece(1, skeleton, *step.to, *step.to);
}

bool ModelPieces::goOn(const Skeleton& skeleton, const PosedStep& step, double horizon) {
  if (!ModelMotion::goOn(step, horizon, countOf(kMost), ends_)) return false;
  resize(static_cast<int>(ends_.size()));
  for (int k = 0; k < count_; ++k) {
    setPiece(k, skeleton, k == 0 ? *step.to : ends_[slotOf(k - 1)], ends_[slotOf(k)]);
  }
  return true;
}

}  // namespace foretouch::internal
