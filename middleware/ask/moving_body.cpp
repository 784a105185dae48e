#include "middleware/ask/moving_body.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

double durationOf(const TrackPiece& piece) {
  return piece.isHeld ? 1.0 : static_cast<double>(piece.endUs - piece.beginUs);
}

double rhoOf(const Hull& hull_L) {
  double rho = 0.0;
  for (std::size_t i = 0; i < countOf(hull_L.count); ++i) {
    rho = std::max(rho, hull_L.points[i].norm());
  }
  return rho * kInflation;
}

}  // namespace

PlaceKnown MovingBody::begin(const WorldParts& world, BodyId body, std::int64_t utimeUs,
                             std::int64_t toUs) {
  world_ = &world;
  body_ = body;
  beginUs_ = utimeUs;
  placesUs_ = -1.0;
  world.chainAt(body, utimeUs, chain_);
  endUs_ = std::min(toUs, world.chainEndUs(chain_, utimeUs));
  PlaceKnown how = PlaceKnown::Known;
  for (const BodyId member : chain_) {
    // A microsecond on: at the last pose itself nothing is known of what comes.
    const BodyPiece piece = bodyPieceAt(world.body(member), {utimeUs, 0.5});
    if (piece.how == PlaceKnown::NotThere || piece.how == PlaceKnown::Silent) return piece.how;
    if (piece.how == PlaceKnown::Assumed) how = PlaceKnown::Assumed;
    if (!piece.piece.isHeld) endUs_ = std::min(endUs_, piece.piece.endUs);
    if (member == body) piece_ = piece;
  }
  motion_.assign(piece_.episode->track.skeleton(), *piece_.piece.from, *piece_.piece.to);
  durationUs_ = durationOf(piece_.piece);
  if (isCarried()) findSpeeds();
  return how;
}

/// Begins with the body that is not carried.
void MovingBody::findSpeeds() {
  Speed carrier;
  for (std::size_t i = chain_.size(); i-- > 0;) {
    const BodyPiece own = bodyPieceAt(world_->body(chain_[i]), {beginUs_, 0.5});
    above_.assign(own.episode->track.skeleton(), *own.piece.from, *own.piece.to);
    const ChainMotion& motion = above_;
    const double duration = durationOf(own.piece);
    speeds_.resize(countOf(motion.numLinks()));
    for (LinkId link = 0; link < motion.numLinks(); ++link) {
      const MotionBounds bounds = motion.bounds(link);
      speeds_[slotOf(link)].ofTurn = kInflation * (carrier.ofTurn + bounds.angularSpeed / duration);
      speeds_[slotOf(link)].ofOrigin =
          kInflation * (carrier.ofOrigin + carrier.ofTurn * bounds.reach + bounds.speed / duration);
    }
    if (i == 0) break;
    const BodyPiece below = bodyPieceAt(world_->body(chain_[i - 1]), {beginUs_, 0.5});
    carrier = speeds_[slotOf(below.episode->carrier->link)];
  }
}

MovingPiece MovingBody::at(LinkId link, const Hull& hull_L, double us) {
  return isCarried() ? carried(link, hull_L, us) : alone(link, hull_L, us);
}

MovingPiece MovingBody::alone(LinkId link, const Hull& hull_L, double us) const {
  const double after = static_cast<double>(beginUs_ - piece_.piece.beginUs) + us;
  const double t = piece_.piece.isHeld ? 0.0 : std::min(1.0, after / durationUs_);
  const LinkState state = motion_.stateAt(link, t);
  const MotionBounds bounds = motion_.bounds(link);
  const double rho = rhoOf(hull_L);
  MovingPiece moving;
  moving.hull.count = hull_L.count;
  for (std::size_t i = 0; i < 3; ++i) {
    moving.hull.points[i] = state.pointAt(hull_L.points[i]);
    moving.velocities[i] = state.velocityAt(hull_L.points[i]) / durationUs_;
  }
  // The instant as t is rounded, too: a sum and a quotient.
  moving.rounding =
      kInflation * (bounds.positionRoundingAt(rho) + kSeparationRounding * bounds.speedAt(rho));
  moving.ofVelocity = kInflation *
                      (bounds.velocityRoundingAt(rho) +
                       kSeparationRounding * (bounds.speedAt(rho) + bounds.accelerationAt(rho))) /
                      durationUs_;
  moving.acceleration = kInflation * bounds.accelerationAt(rho) / (durationUs_ * durationUs_);
  return moving;
}

MovingPiece MovingBody::carried(LinkId link, const Hull& hull_L, double us) {
  if (placesUs_ != us) {
    // At the end itself, its carriers may be others.
    const double before = std::min(us, std::nextafter(static_cast<double>(endUs_ - beginUs_), 0.0));
    const double whole = std::floor(before);
    const WorldTime time{beginUs_ + static_cast<std::int64_t>(whole), before - whole};
    static_cast<void>(bodyPlaces_.at(*world_, body_, time, places_));
    placesUs_ = us;
  }
  const LinkPlace& place = places_[slotOf(link)];
  const Speed& speed = speeds_[slotOf(link)];
  const double rho = rhoOf(hull_L);
  MovingPiece moving;
  moving.hull.count = hull_L.count;
  for (std::size_t i = 0; i < 3; ++i) moving.hull.points[i] = place.at(hull_L.points[i]);
  moving.velocities.fill(Eigen::Vector3d::Zero());
  moving.ofVelocity = kInflation * (speed.ofOrigin + speed.ofTurn * rho);
  moving.rounding = place.roundingAt(rho) + moving.ofVelocity * kSeparationRounding * us;
  return moving;
}

}  // namespace foretouch::internal
