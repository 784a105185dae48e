#include "middleware/ask/instant_bodies.h"

#include <algorithm>
#include <utility>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

bool areAlike(const std::vector<AskInstant>& x, const std::vector<AskInstant>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                    [](const AskInstant& one, const AskInstant& other) {
                      return one.body == other.body && one.time == other.time;
                    });
}

bool isThere(PlaceKnown known) {
  return known == PlaceKnown::Known || known == PlaceKnown::Assumed;
}

}  // namespace

bool InstantBodies::isBrought(const WorldParts& world, const WorldQuestion& question) const {
  return identity_ == world.identity && changes_ == world.changes && time_ == question.time &&
         areAlike(instants_, question.instants);
}

void InstantBodies::useWorld(const WorldParts& world) {
  world_ = &world;
  if (owner_ != world.identity) {
    kept_.clear();
    tables_.clear();
    identity_ = 0;
  }
  owner_ = world.identity;
  for (std::size_t kind = tables_.size(); kind < world.kinds.size(); ++kind) {
    tables_.emplace_back().assign(world.kinds[kind].asked());
  }
  kept_.resize(world.bodies.size());
  state_.resize(world.bodies.size());
}

void InstantBodies::bring(const WorldParts& world, const WorldQuestion& question) {
  useWorld(world);
  if (isBrought(world, question)) return;
  identity_ = 0;  // until all is there
  time_ = question.time;
  instants_ = question.instants;
  times_.assign(world.bodies.size(), time_);
  for (auto own = instants_.rbegin(); own != instants_.rend(); ++own) {
    times_[slotOf(own->body)] = own->time;
  }
  state_.assign(world.bodies.size(), {});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lower_[axis].resize(world.bodies.size());
    upper_[axis].resize(world.bodies.size());
  }
  others_.clear();
  extent_ = 0.0;
  for (BodyId body = 0; slotOf(body) < world.bodies.size(); ++body) bringBody(body);
  identity_ = world.identity;
  changes_ = world.changes;
}

void InstantBodies::bringBody(BodyId body) {
  setBox(body, roughBox(body));
  if (state_[slotOf(body)].known != PlaceKnown::Known) others_.push_back(body);
}

/// Sets what is known of it, too.
Aabb InstantBodies::roughBox(BodyId body) {
  State& state = state_[slotOf(body)];
  const WorldBody& asked = world_->body(body);
  const WorldTime& time = times_[slotOf(body)];
  if (const Aabb* box = kept_[slotOf(body)].rough.at(asked, world_->kindOf(body), time.us)) {
    state.known = PlaceKnown::Known;
    Aabb grown = *box;
    // It may have been found before poses went.
    grown.grow(world_->thinnedBy + skinSlack(world_->kindOf(body), grown));
    return grown;
  }
  const BodyPiece known = bodyPieceAt(asked, time);
  state.known = known.how;
  if (!isThere(known.how)) return {};
  state.isCarried = known.episode->carrier.has_value();
  if (state.isCarried) return boxOfPlaces(body);
  const BodyKind& kind = world_->kindOf(body);
  reach_.clear();
  reach_.add(kind.skeleton, *known.piece.from);
  reach_.add(kind.skeleton, *known.piece.to);
  Aabb box = reach_.box(kind);
  box.grow(skinSlack(kind, box));
  return box;
}

void InstantBodies::setBox(BodyId body, const Aabb& box) {
  for (int axis = 0; axis < 3; ++axis) {
    lower_[slotOf(axis)][slotOf(body)] = box.min[axis];
    upper_[slotOf(axis)][slotOf(body)] = box.max[axis];
  }
  if (box.min.x() > box.max.x()) return;
  extent_ = std::max({extent_, box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff()});
}

/// The piece that holds the instant, kept or made.
int InstantBodies::pieceOf(BodyId body, const BodyPiece& known) {
  Kept& kept = kept_[slotOf(body)];
  const auto found = std::find(kept.begins.begin(), kept.begins.end(), known.piece.beginUs);
  auto place = static_cast<std::size_t>(found - kept.begins.begin());
  if (found == kept.begins.end() && place < kPiecesKept) {
    kept.begins.push_back(0);
    kept.pieces.emplace_back();
  } else if (found == kept.begins.end()) {
    place = std::exchange(kept.oldest, (kept.oldest + 1) % kPiecesKept);
  }
  PieceBoxes& piece = kept.pieces[place];
  const bool isIt = found != kept.begins.end() && piece.endUs == known.piece.endUs &&
                    piece.isHeld == known.piece.isHeld && piece.episodeUs == known.episode->beginUs;
  if (!isIt) {
    fill(body, known, piece);
    kept.begins[place] = piece.beginUs;
  }
  return static_cast<int>(place);
}

void InstantBodies::fill(BodyId body, const BodyPiece& known, PieceBoxes& piece) {
  piece.endUs = piece.beginUs - 1;  // no piece, until it is filled
  motion_.assign(known.episode->track.skeleton(), *known.piece.from, *known.piece.to);
  piece.origin = known.piece.from->translations[0];
  nodes_.evaluate(motion_, 0.0, 1.0, piece.origin);
  sweptBoxes(tables_[slotOf(world_->body(body).kind)], motion_, nodes_, 0.0, swept_);
  piece.box = Aabb();
  for (int axis = 0; axis < 3; ++axis) {
    const auto count = static_cast<std::ptrdiff_t>(swept_.count);
    std::vector<float>&lower = piece.lower[slotOf(axis)], &upper = piece.upper[slotOf(axis)];
    lower.assign(swept_.lower[axis], swept_.lower[axis] + count);
    upper.assign(swept_.upper[axis], swept_.upper[axis] + count);
    if (count == 0) continue;
    const double least = *std::min_element(lower.begin(), lower.end());
    const double most = *std::max_element(upper.begin(), upper.end());
    piece.box.min[axis] = piece.origin[axis] + least;
    piece.box.max[axis] = piece.origin[axis] + most;
  }
  if (piece.box.min.x() <= piece.box.max.x()) {
    piece.box.grow(skinSlack(world_->kindOf(body), piece.box));
  }
  piece.episodeUs = known.episode->beginUs;
  piece.beginUs = known.piece.beginUs;
  piece.endUs = known.piece.endUs;
  piece.isHeld = known.piece.isHeld;
}

/// For a body that is carried: by its places, as the poses of both decide where it is.
Aabb InstantBodies::boxOfPlaces(BodyId body) {
  State& state = state_[slotOf(body)];
  std::vector<LinkPlace>& places = kept_[slotOf(body)].places;
  state.known = bodyPlaces_.at(*world_, body, times_[slotOf(body)], places);
  state.isPosed = isThere(state.known);
  Aabb box;
  if (!state.isPosed) return box;
  const auto& volumes = world_->kindOf(body).asked();
  for (std::size_t link = 0; link < volumes.size(); ++link) {
    for (const Lss& lss : volumes[link]) {
      double rounding = 0.0;
      const Lss lss_W = placed(lss, places[link], rounding);
      Aabb one;
      one.add(lss_W.a);
      one.add(lss_W.b);
      one.grow(lss.radius + rounding);
      box.add(one);
    }
  }
  if (box.min.x() <= box.max.x()) box.grow(skinSlack(world_->kindOf(body), box));
  return box;
}

Aabb InstantBodies::box(BodyId body) const {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = lower_[slotOf(axis)][slotOf(body)];
    box.max[axis] = upper_[slotOf(axis)][slotOf(body)];
  }
  return box;
}

const PieceBoxes* InstantBodies::pieces(BodyId body) {
  State& state = state_[slotOf(body)];
  if (state.isCarried) return nullptr;
  if (state.piece < 0) {
    state.piece = pieceOf(body, bodyPieceAt(world_->body(body), times_[slotOf(body)]));
    setBox(body, kept_[slotOf(body)].pieces[slotOf(state.piece)].box);
  }
  return &kept_[slotOf(body)].pieces[slotOf(state.piece)];
}

const PieceBoxes& InstantBodies::piecesOf(BodyId body, const BodyPiece& known) {
  state_[slotOf(body)].piece = -1;  // the slot of the body's instant may be taken
  return kept_[slotOf(body)].pieces[slotOf(pieceOf(body, known))];
}

const std::vector<LinkPlace>& InstantBodies::places(BodyId body) {
  State& state = state_[slotOf(body)];
  std::vector<LinkPlace>& places = kept_[slotOf(body)].places;
  if (!state.isPosed) {
    state.isPosed = isThere(bodyPlaces_.at(*world_, body, times_[slotOf(body)], places));
    FORETOUCH_ASSERT(state.isPosed);
  }
  return places;
}

}  // namespace foretouch::internal
