#include "middleware/depth/body_places.h"

#include <algorithm>

#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

constexpr double kTurnedPoint = MotionBounds::kPointRounding;
/// The rounding of the instant as the motion's t: a difference, a sum, a quotient.
constexpr double kInstantOfPlace = 4.0 * kUnitRoundoff;

LinkPlace placeOf(const LinkState& state, const MotionBounds& bounds) {
  LinkPlace place;
  place.R_WL = state.R_WL;
  place.p_WL = state.p_WL;
  place.ofOrigin = bounds.originRounding + kInstantOfPlace * bounds.speed;
  place.ofTurn = bounds.rotationRounding + kInstantOfPlace * bounds.angularSpeed;
  return place;
}

/// A frame in W that was given in the frame of its carrier.
LinkPlace carried(const LinkPlace& carrier, const LinkPlace& own) {
  LinkPlace place;
  place.R_WL = carrier.R_WL * own.R_WL;
  place.p_WL = carrier.at(own.p_WL);
  const double arm = own.p_WL.norm();
  place.ofTurn = (carrier.ofTurn + own.ofTurn + kTurnedPoint) * kInflation;
  place.ofOrigin = (carrier.roundingAt(arm) + own.ofOrigin) * kInflation;
  return place;
}

double instantOf(const TrackPiece& piece, const WorldTime& time) {
  if (piece.isHeld) return 0.0;
  const auto since = static_cast<double>(time.us - piece.beginUs) + time.fraction;
  return std::min(1.0, since / static_cast<double>(piece.endUs - piece.beginUs));
}

}  // namespace

double LinkPlace::roundingAt(double rho) const {
  return (ofOrigin + (ofTurn + kTurnedPoint) * rho + kTurnedPoint * (p_WL.norm() + rho)) *
         kInflation;
}

PlaceKnown BodyPlaces::at(const WorldParts& world, BodyId body, const WorldTime& time,
                          std::vector<LinkPlace>& places) {
  PlaceKnown how = PlaceKnown::Known;
  // Begins with the one that is not carried.
  for (world.chainAt(body, time.us, chain_); !chain_.empty(); chain_.pop_back()) {
    const PlaceKnown own = place(world.body(chain_.back()), time, places);
    if (own == PlaceKnown::Silent || own == PlaceKnown::NotThere) return own;
    if (own == PlaceKnown::Assumed) how = own;
  }
  return how;
}

BodyPiece bodyPieceAt(const WorldBody& body, const WorldTime& time) {
  const Episode* const episode = body.episodeAt(time.us);
  if (episode == nullptr || time.us < episode->track.knownFromUs()) return {};
  BodyPiece known{PlaceKnown::Known, episode, episode->track.pieceAt(time.us)};
  // At its last pose it is known; the piece that begins there is a guess.
  const TrackPiece& piece = known.piece;
  const bool isAfter = piece.isHeld && (time.us > piece.beginUs || time.fraction > 0.0);
  if (isAfter && !episode->isHeldFast()) {
    const bool isTakenToHold = body.options.whenSilent == WhenSilent::HoldStill;
    known.how = isTakenToHold ? PlaceKnown::Assumed : PlaceKnown::Silent;
  }
  return known;
}

/// Places one body; `places` has those of its carrier.
PlaceKnown BodyPlaces::place(const WorldBody& body, const WorldTime& time,
                             std::vector<LinkPlace>& places) {
  const auto [how, episode, piece] = bodyPieceAt(body, time);
  if (how == PlaceKnown::NotThere || how == PlaceKnown::Silent) return how;
  LinkPlace carrier;
  if (episode->carrier) carrier = places[slotOf(episode->carrier->link)];
  motion_.assign(episode->track.skeleton(), *piece.from, *piece.to);
  motion_.statesAt(instantOf(piece, time), states_);
  places.resize(states_.size());
  for (LinkId link = 0; link < motion_.numLinks(); ++link) {
    const LinkPlace own = placeOf(states_[slotOf(link)], motion_.bounds(link));
    places[slotOf(link)] = episode->carrier ? carried(carrier, own) : own;
  }
  return how;
}

Lss placed(const Lss& lss_L, const LinkPlace& place, double& rounding) {
  const double rho = std::max(lss_L.a.norm(), lss_L.b.norm()) * kInflation;
  rounding = std::max(rounding, place.roundingAt(rho));
  return {place.at(lss_L.a), place.at(lss_L.b), lss_L.radius};
}

Lss seenFrom(const LinkPlace& frame, const Lss& lss_W, double& rounding) {
  const auto seen = [&](const Eigen::Vector3d& p_W) {
    return Eigen::Vector3d(frame.R_WL.transpose() * (p_W - frame.p_WL));
  };
  const Lss lss{seen(lss_W.a), seen(lss_W.b), lss_W.radius};
  const double rho = std::max(lss.a.norm(), lss.b.norm()) * kInflation;
  // The frame's own uncertainty moves what is seen from it by as much; kTurnedPoint twice, as the
  // difference is rounded before it is turned.
  const double more = frame.roundingAt(rho) + kTurnedPoint * (lss_W.a.norm() + lss_W.b.norm());
  rounding = (rounding + more) * kInflation;
  return lss;
}

}  // namespace foretouch::internal
