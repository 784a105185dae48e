#include "middleware/triggers/body_breaks.h"

#include <algorithm>
#include <limits>

namespace foretouch::internal {
namespace {

/// From when on nothing is known of a body in the episode of the instant, whatever carries it;
/// INT64_MAX: something is, or it is taken to hold still.
std::int64_t undecidedFrom(const WorldBody& body, std::int64_t us) {
  const Episode* const episode = body.episodeAt(us);
  const bool isTold = episode == nullptr || episode->isHeldFast() ||
                      body.options.whenSilent != WhenSilent::Undecided;
  return isTold ? std::numeric_limits<std::int64_t>::max() : episode->track.knownUntilUs();
}

}  // namespace

/// A motion that is known cannot change; a guess may turn out to be wrong.
bool BodyBreaks::Ground::holdsFor(const Ground& later) const {
  if (how != PlaceKnown::NotThere && episodeUs != later.episodeUs) return false;
  return how == PlaceKnown::Known || (how == later.how && pieceUs == later.pieceUs);
}

BodyBreaks::Ground BodyBreaks::groundOf(const WorldBody& body, std::int64_t us) {
  const BodyPiece known = bodyPieceAt(body, {us, 0.0});
  if (known.episode == nullptr) return {};
  return {known.how, known.episode->beginUs, known.piece.beginUs};
}

void BodyBreaks::find(const WorldParts& world, const Stretch& stretch) {
  const std::size_t known = ofBody_.size();
  ofBody_.resize(world.bodies.size());
  for (std::size_t i = 0; i < ofBody_.size(); ++i) {
    const Ground now = groundOf(world.bodies[i], stretch.fromUs);
    ofBody_[i].isElsewhere = i >= known || !ofBody_[i].atEnd.holdsFor(now);
  }
  for (std::size_t i = 0; i < ofBody_.size(); ++i) {
    follow(world, static_cast<BodyId>(i), stretch);
    ofBody_[i].atEnd = groundOf(world.bodies[i], stretch.toUs);
  }
}

void BodyBreaks::follow(const WorldParts& world, BodyId body, const Stretch& stretch) {
  Breaks& breaks = ofBody_[slotOf(body)];
  breaks.cuts.clear();
  breaks.silences.clear();
  for (std::int64_t us = stretch.fromUs, endUs = us; us < stretch.toUs; us = endUs) {
    world.chainAt(body, us, chain_);
    endUs = std::min(world.chainEndUs(chain_, us), stretch.toUs);
    const bool isCut = std::any_of(chain_.begin(), chain_.end(), [&](BodyId id) {
      const Episode* const episode = world.body(id).episodeAt(us);
      return (episode != nullptr && episode->beginUs == us) ||
             (us == stretch.fromUs && ofBody_[slotOf(id)].isElsewhere);
    });
    if (isCut) breaks.cuts.push_back(us);
    std::int64_t undecidedUs = endUs;
    for (const BodyId id : chain_) {
      undecidedUs = std::min(undecidedUs, undecidedFrom(world.body(id), us));
    }
    if (undecidedUs < endUs) breaks.silences.push_back({std::max(us, undecidedUs), endUs});
  }
}

}  // namespace foretouch::internal
