#include "middleware/depth/depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/separation.h"
#include "middleware/depth/least_way.h"
#include "middleware/depth/near_pieces.h"

namespace foretouch {

namespace {

using Eigen::Vector3d;
using internal::ConvexPair;
using internal::PartingPlane;
using internal::PiecePair;
using internal::PiecesApart;

/// What questions about depths keep.
struct DepthMemory : internal::ScratchPart {
  static constexpr internal::ScratchKind kKind = internal::ScratchKind::Depth;

  std::vector<PiecePair> near, open;
  std::vector<PartingPlane> planes;
  std::vector<double> weights;
};

/// A way is not looked for if it could be shorter than what is certified by less than this share.
constexpr double kGoodEnough = 1e-9;
/// How often a proposal is led on by the planes of those that it meets.
constexpr int kMostSteps = 24;
/// A direction is gone on along that makes at least this angle's cosine with a pair's own way out.
constexpr double kHelpful = 0.1;

/// One question. Proposes translations, and believes none that it cannot certify.
class WayOut {
 public:
  WayOut(PiecesApart& pieces, DepthMemory& memory, Depth& depth)
      : pieces_(pieces), memory_(memory), depth_(depth) {}

  void find() {
    lookAtPairs();
    if (depth_.numPairs == 0) {
      depth_.upper = 0.0;
      depth_.isCertified = true;
      return;
    }
    leadOn(internal::wayThrough(deepest_));
    leadOn(sum_);
    tryAlong(sum_);
    tryAlong(deepest_.nhat);
    for (int axis = 0; axis < 3 && !isGoodEnough(); ++axis) {
      tryAlong(Vector3d::Unit(axis));
      tryAlong(-Vector3d::Unit(axis));
    }
  }

 private:
  [[nodiscard]] bool isGoodEnough() const {
    return depth_.isCertified && depth_.upper <= (1.0 + kGoodEnough) * depth_.lower;
  }
  [[nodiscard]] bool isSpent() const { return looks_ > kMostDepthLooks; }

  void lookAtPairs() {
    memory_.near.clear();
    pieces_.collect(Vector3d::Zero(), 0.0, memory_.near);
    for (const PiecePair& pair : memory_.near) {
      const PairDepth of = internal::depthOf(pieces_.at(pair));
      if (of.upper == 0.0) continue;
      ++depth_.numPairs;
      const bool isDeepest = depth_.deepestMoved < 0 || of.lower > depth_.lower ||
                             (of.lower == depth_.lower && of.upper > deepest_.need);
      depth_.lower = std::max(depth_.lower, of.lower);
      if (isDeepest) {
        depth_.deepestMoved = pair.moved;
        depth_.deepestOther = pair.other;
        deepest_ = {of.wayOut / of.upper, of.upper};
      }
      // What one pair gives, others need not give again.
      const double missing = of.upper - of.wayOut.dot(sum_) / of.upper;
      if (missing > 0.0) sum_ += (missing / of.upper) * of.wayOut;
    }
  }

  /// The pairs that are not proven clear after the move; none: it is certified.
  void lookAfter(const Vector3d& move) {
    memory_.near.clear();
    memory_.open.clear();
    pieces_.collect(move, 0.0, memory_.near);
    looks_ += static_cast<std::int64_t>(memory_.near.size()) + 1;
    for (const PiecePair& pair : memory_.near) {
      const ConvexPair at = pieces_.at(pair, move);
      if (!(separation(at.one, at.other).lower() > at.most)) memory_.open.push_back(pair);
    }
  }

  /// Takes the move if it is shorter than the best, and certified. Leaves the open pairs.
  bool certify(const Vector3d& move) {
    const double length = move.norm() * internal::kInflation;
    if (!std::isfinite(length)) return false;
    lookAfter(move);
    if (!memory_.open.empty()) return false;
    if (length < depth_.upper) {
      depth_.upper = length;
      depth_.wayOut = move;
      depth_.isCertified = true;
    }
    return true;
  }

  /// Newton's steps: the least way through the planes of all pairs met so far, each plane taken
  /// where the last step had led.
  void leadOn(Vector3d move) {
    memory_.planes.clear();
    for (int step = 0; step < kMostSteps && !isGoodEnough() && !isSpent(); ++step) {
      if (certify(move)) {
        if (!tighten(move)) return;
        continue;
      }
      for (const PiecePair& pair : memory_.open) addPlane(pair, move);
      const auto next = internal::leastWay(memory_.planes, depth_.upper, memory_.weights);
      if (!next) return;
      move = *next;
    }
  }

  /// Finds, from a certified place, whose own planes say more than those on the way to it, a
  /// shorter move that they allow. False: there is none.
  bool tighten(Vector3d& move) {
    memory_.planes.clear();
    memory_.near.clear();
    pieces_.collect(move, move.norm(), memory_.near);
    looks_ += static_cast<std::int64_t>(memory_.near.size());
    for (const PiecePair& pair : memory_.near) addPlane(pair, move);
    const auto next = internal::leastWay(memory_.planes, depth_.upper, memory_.weights);
    if (!next || !(next->norm() < (1.0 - kGoodEnough) * depth_.upper)) return false;
    move = *next;
    return true;
  }

  /// The plane that parts a pair soonest where it is after the move, as seen from where it was.
  void addPlane(const PiecePair& pair, const Vector3d& move) {
    const ConvexPair at = pieces_.at(pair, move);
    memory_.planes.push_back(planeBefore(pair, at, internal::partingPlaneOf(at).nhat));
  }

  /// Needs what rounds after the move, too: twice, so that the certificate finds it done.
  [[nodiscard]] PartingPlane planeBefore(const PiecePair& pair, const ConvexPair& after,
                                         const Vector3d& nhat) const {
    const ConvexPair at = pieces_.at(pair);
    PartingPlane plane = internal::partingPlaneAlong(at, nhat);
    plane.need += 2.0 * (after.most - at.most);
    return plane;
  }

  /// Straight on until all is clear, then from there.
  void tryAlong(const Vector3d& direction) {
    const double norm = direction.norm();
    if (!(norm > 0.0) || isGoodEnough()) return;
    const Vector3d nhat = (internal::kUnitShrink / norm) * direction;
    double length = 0.0;
    for (int step = 0; step < kMostSteps && !isSpent(); ++step) {
      const Vector3d move = length * nhat;
      if (certify(move)) {
        leadOn(move);
        return;
      }
      double next = length;
      for (const PiecePair& pair : memory_.open)
        next = std::max(next, lengthPast(pair, move, nhat));
      if (!(next > length) || !std::isfinite(next)) return;
      length = next;
    }
  }

  /// How far to go in all, along the direction, until the pair is clear.
  [[nodiscard]] double lengthPast(const PiecePair& pair, const Vector3d& move,
                                  const Vector3d& nhat) const {
    const ConvexPair at = pieces_.at(pair, move);
    double length = planeBefore(pair, at, nhat).need;
    const Vector3d soonest = internal::partingPlaneOf(at).nhat;
    const double along = soonest.dot(nhat);
    if (along > kHelpful) length = std::min(length, planeBefore(pair, at, soonest).need / along);
    return (1.0 + kGoodEnough) * length + internal::kUnderflow;
  }

  PiecesApart& pieces_;
  DepthMemory& memory_;
  Depth& depth_;
  PartingPlane deepest_{Vector3d::Zero(), 0.0};
  Vector3d sum_ = Vector3d::Zero();
  std::int64_t looks_ = 0;
};

Depth depthOfPieces(PiecesApart pieces, Scratch& scratch) {
  Depth depth;
  WayOut(pieces, scratch.of<DepthMemory>(), depth).find();
  return depth;
}

}  // namespace

Depth depthAmong(const std::vector<Lss>& moved, const std::vector<Lss>& others, Scratch& scratch,
                 double rounding) {
  return depthOfPieces({moved, others, rounding}, scratch);
}

Depth depthIn(const std::vector<Lss>& moved, const Scene& scene, Scratch& scratch,
              double rounding) {
  return depthOfPieces({moved, scene, rounding}, scratch);
}

}  // namespace foretouch
