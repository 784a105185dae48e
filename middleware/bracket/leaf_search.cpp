#include "middleware/bracket/leaf_search.h"

#include <algorithm>
#include <cstddef>

#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

/// A part of 1/2^n of the piece is not halved any more, however many leaves are near.
constexpr std::size_t kDepth = 7, kManyLeaves = 48;
constexpr std::ptrdiff_t kMostForCertain = 16;

}  // namespace

std::optional<double> LeafSearch::find(const LinkInPiece& piece, const BracketSearch& search,
                                       double from, const NearLeaves& leaves, SidesPair& witness) {
  piece_ = &piece;
  search_ = search;
  witness_ = &witness;
  bounds_ = piece.evaluator.motion().bounds(piece.link);
  fewer_.resize(kDepth + 1);
  return findIn(from, search.way == BracketSearch::Way::Backward ? 0.0 : 1.0, leaves, 0);
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
  const double resolution = std::max(piece_->resolution, kResolutionShare * growth.most());
  tubes_.clear();
  for (const Lss& lss : piece_->lss) {
    // A shrunk body without a radius touches nothing.
    const double margin = isGrown ? most : lss.radius > least ? -least : -kInfinity;
    tubes_.emplace_back(lss, axisBounds(lss, bounds_), axisEnds(lss, atBegin), axisEnds(lss, atEnd),
                        end - begin, margin + resolution);
  }
}

/// A touch that is not found is not told as certain: it need not be looked for everywhere.
void LeafSearch::keepNearest(NearLeaves& leaves) const {
  if (leaves.size() <= countOf(kMostForCertain)) return;
  const auto isNearer = [this](const NearLeaf& x, const NearLeaf& y) {
    return LinkLeaves::distanceTo(piece_->scene, tubes_, x) <
           LinkLeaves::distanceTo(piece_->scene, tubes_, y);
  };
  std::nth_element(leaves.begin(), leaves.begin() + kMostForCertain, leaves.end(), isNearer);
  leaves.resize(countOf(kMostForCertain));
}

std::optional<double> LeafSearch::findIn(double from, double to, const NearLeaves& leaves,
                                         std::size_t depth) {
  setTubes(from, to);
  NearLeaves& fewer = fewer_[depth];
  LinkLeaves::narrow(piece_->scene, tubes_, leaves, fewer);
  if (fewer.empty()) return std::nullopt;
  // What is near throughout would be looked at in every part.
  const bool getsFewer = fewer.size() > kManyLeaves || 4 * fewer.size() <= 3 * leaves.size();
  if (fewer.size() > kFewLeaves && depth < kDepth && getsFewer) {
    const double middle = 0.5 * (from + to);
    const auto first = findIn(from, middle, fewer, depth + 1);
    return first ? first : findIn(middle, to, fewer, depth + 1);
  }
  if (search_.body == BracketSearch::Body::Shrunk) keepNearest(fewer);
  LinkLeaves::collect(piece_->scene, tubes_, fewer, pairs_);
  if (pairs_.empty()) return std::nullopt;
  piece_->sides.limitTo(pairs_, true);
  return bracketer_.find(piece_->sides, piece_->growth, piece_->resolution, search_, from, to,
                         *witness_);
}

}  // namespace foretouch::internal
