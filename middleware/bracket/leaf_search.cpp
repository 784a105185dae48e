#include "middleware/bracket/leaf_search.h"

#include <algorithm>
#include <cstddef>

#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/scene/flat_bvh_lanes.h"

namespace foretouch::internal {
namespace {

/// A part of 1/2^n of the piece is not halved any more, however many leaves are near. What is near
/// throughout would be looked at in every part: per so many leaves one halving may leave as many.
constexpr std::size_t kDepth = 7, kLeavesPerIdle = 64;

}  // namespace

std::optional<double> LeafSearch::find(const LinkInPiece& piece, const BracketSearch& search,
                                       double from, const NearLeaves& leaves, SidesPair& witness) {
  piece_ = &piece;
  search_ = search;
  witness_ = &witness;
  bounds_ = piece.evaluator.motion().bounds(piece.link);
  fewer_.resize(kDepth + 1);
  return findIn(from, search.way == BracketSearch::Way::Backward ? 0.0 : 1.0, leaves, {});
}

/// Of the grown body; of the shrunk one as it is at its thickest.
void LeafSearch::setTubes(double from, double to) {
  const double begin = std::min(from, to), end = std::max(from, to);
  const Growth& growth = piece_->growth;
  const bool isGrown = search_.body == BracketSearch::Body::Grown;
  const double most = growth.mostIn(begin, end) * kInflation;
  const double least = std::min(growth.at(begin), growth.at(end)) / kInflation;
  const LinkState atBegin = piece_->evaluator.stateAt(piece_->link, begin);
  const LinkState atEnd = piece_->evaluator.stateAt(piece_->link, end);
  tubes_.clear();
  for (const Lss& lss : piece_->lss) {
    // A shrunk body without a radius touches nothing.
    const double margin = isGrown ? most : lss.radius > least ? -least : -kInfinity;
    tubes_.emplace_back(lss, axisBounds(lss, bounds_), axisEnds(lss, atBegin), axisEnds(lss, atEnd),
                        end - begin, margin + piece_->resolution);
  }
}

std::optional<double> LeafSearch::findIn(double from, double to, const NearLeaves& leaves,
                                         Halvings done) {
  MovingSides& sides = piece_->sides;
  if (sides.isSpent()) {
    return search_.body == BracketSearch::Body::Grown ? std::optional<double>(from) : std::nullopt;
  }
  setTubes(from, to);
  sides.addBoxes(leaves.size());
  NearLeaves& fewer = fewer_[done.all];
  LinkLeaves::narrow(piece_->scene, tubes_, leaves, fewer);
  if (fewer.empty()) return std::nullopt;
  const bool getsFewer = 4 * fewer.size() <= 3 * leaves.size();
  const Halvings next{done.all + 1, getsFewer ? 0 : done.idle + 1};
  const bool isWorth = next.idle * kLeavesPerIdle <= fewer.size();
  if (fewer.size() > kFewLeaves && done.all < kDepth && isWorth) {
    const double middle = 0.5 * (from + to);
    const auto first = findIn(from, middle, fewer, next);
    return first ? first : findIn(middle, to, fewer, next);
  }
  sides.addBoxes(fewer.size() * countOf(kBvhWidth));
  LinkLeaves::collect(piece_->scene, tubes_, fewer, pairs_);
  if (pairs_.empty()) return std::nullopt;
  sides.limitTo(pairs_, true);
  return bracketer_.find(sides, piece_->growth, piece_->resolution, search_, from, to, *witness_);
}

}  // namespace foretouch::internal
