#include "middleware/bracket/leaf_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

/// Shares of what is searched: of the first window where there is no list of leaves, and which no
/// window is less than.
constexpr double kFirstWindow = 0x1p-4, kLeastWindow = 0x1p-7;
/// A window with too many pairs leaves so much of itself.
constexpr double kOfWindow = 0.25;
/// Pairs that a smaller window does not leave fewer of are near throughout, and so many are taken.
constexpr std::size_t kMostPairs = 256;

}  // namespace

/// Sets those of the grown body; of the shrunk one as it is at its thickest.
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

void LeafSearch::collectPairs(double from, double to, const NearLeaves* leaves) {
  setTubes(from, to);
  if (leaves == nullptr) {
    box_.assign(1, Aabb{});
    for (const SweptTube& tube : tubes_) {
      if (!tube.isNothing()) box_.front().add(tube.box());
    }
    near_.walk(piece_->scene, box_);
    near_.collect(piece_->scene, 0, piece_->ignored, ofWindow_);
    leaves = &ofWindow_;
  }
  piece_->sides.addBoxes(leaves->size());
  near_.collect(piece_->scene, tubes_, *leaves, pairs_);
}

void LeafSearch::begin(const LinkInPiece& piece, const BracketSearch& search) {
  piece_ = &piece;
  search_ = search;
  bounds_ = piece.evaluator.motion().bounds(piece.link);
}

bool LeafSearch::isFound(const LinkInPiece& piece, const BracketSearch& search, double at,
                         const NearLeaves* leaves, SidesPair& witness) {
  begin(piece, search);
  collectPairs(at, at, leaves);
  if (pairs_.empty() || !SideBracketer::isFound(piece.sides, piece.growth, piece.resolution, search,
                                                at, pairs_.front())) {
    return false;
  }
  witness = pairs_.front();
  return true;
}

std::optional<double> LeafSearch::findAmongPairs(double from, double to, SidesPair& witness) {
  if (pairs_.empty()) return std::nullopt;
  piece_->sides.addBoxes(pairs_.size());
  piece_->sides.limitTo(pairs_, true);
  return bracketer_.find(piece_->sides, piece_->growth, piece_->resolution, search_, from, to,
                         witness);
}

std::optional<double> LeafSearch::find(const LinkInPiece& piece, const BracketSearch& search,
                                       double from, const NearLeaves* leaves, SidesPair& witness) {
  begin(piece, search);
  const double end = search.way == BracketSearch::Way::Backward ? 0.0 : 1.0;
  const double least = kLeastWindow * (end - from);
  std::size_t refused = kMostPairs;
  double t = from, window = leaves != nullptr ? end - from : kFirstWindow * (end - from);
  while (t != end) {
    if (piece.sides.isSpent()) {
      return search.body == BracketSearch::Body::Grown ? std::optional<double>(t) : std::nullopt;
    }
    const bool isLast = std::abs(window) >= std::abs(end - t) || t + window == t;
    const double next = isLast ? end : t + window;
    collectPairs(t, next, leaves);
    const std::size_t count = pairs_.size();
    const bool getsFewer = 4 * count <= 3 * refused || count > kMostPairs;
    if (count > kFewPairs && std::abs(window) > std::abs(least) && getsFewer) {
      refused = count;
      window = kOfWindow * (next - t);
      continue;
    }
    if (const auto found = findAmongPairs(t, next, witness)) return found;
    refused = kMostPairs;
    if (2 * count <= kFewPairs) window *= 2.0;
    t = next;
  }
  return std::nullopt;
}

}  // namespace foretouch::internal
