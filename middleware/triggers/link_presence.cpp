#include "middleware/triggers/link_presence.h"

#include <algorithm>
#include <limits>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// Instants of a gap at which it is asked, one after the other until one can be answered.
constexpr double kAskedAt[] = {0.5, 0.25, 0.75};

WorldTime atUs(std::int64_t us) {
  return {us, 0.0};
}

/// The instant at a share in (0,1) of the time from one to the other.
WorldTime between(const WorldTime& from, const WorldTime& to, double share) {
  const double after =
      from.fraction + share * microsecondsAfter(from.us, to) - share * from.fraction;
  const auto whole = static_cast<std::int64_t>(after);
  return {from.us + whole, std::min(after - static_cast<double>(whole), 0x1.fffffffffffffp-1)};
}

/// When the body is there first.
std::int64_t appearsUs(const WorldBody& body) {
  return body.episodes.empty() ? std::numeric_limits<std::int64_t>::max()
                               : body.episodes.front().beginUs;
}

LinkId linksOf(const WorldParts& world, BodyId body) {
  return world.kindOf(body).skeleton.numJoints();
}

}  // namespace

void appendCuts(const WorldParts& world, BodyId body, const Stretch& stretch,
                std::vector<BodyId>& chain, std::vector<std::int64_t>& cuts) {
  for (std::int64_t us = stretch.fromUs; us < stretch.toUs; us = world.chainEndUs(chain, us)) {
    world.chainAt(body, us, chain);
    const bool isCut = std::any_of(chain.begin(), chain.end(), [&](BodyId id) {
      const Episode* const episode = world.body(id).episodeAt(us);
      return episode != nullptr && episode->beginUs == us;
    });
    if (isCut) cuts.push_back(us);
  }
}

void LinkPresence::begin(const WorldParts& world, const Stretch& stretch) {
  world_ = &world;
  stretch_ = stretch;
  counters_ = {};
}

bool LinkPresence::isKept(TriggerId trigger, BodyId body) const {
  const auto first = ends_.lower_bound({trigger, body, kEveryLink});
  return first != ends_.end() && std::get<0>(first->first) == trigger &&
         std::get<1>(first->first) == body;
}

void LinkPresence::append(const TriggerPair& pair, std::vector<PresenceSpan>& spans) {
  for (LinkId link = 0; link < linksOf(*world_, pair.body); ++link) {
    if (pair.watchedLink != kEveryLink && pair.watchedLink != link) continue;
    const auto& avatar = world_->kindOf(pair.body).avatar;
    if (avatar && avatar->lss(link).empty()) continue;
    appendLink(pair, link, spans);
  }
}

void LinkPresence::appendLink(const TriggerPair& pair, LinkId link,
                              std::vector<PresenceSpan>& spans) {
  ++counters_.pairs;
  const std::size_t first = spans.size();
  appendParts(pair, link);
  findGaps(pair);
  spans.insert(spans.end(), touching_.begin(), touching_.end());
  for (const Gap& gap : gaps_) {
    const Decided decided = presenceIn(pair, link, gap);
    if (decided.presence == Presence::Outside) continue;
    spans.push_back({gap.from, gap.to, decided.presence, link, decided.isAssumed, gap.isNew});
  }
  const bool isTouching =
      std::any_of(touching_.begin(), touching_.end(),
                  [&](const PresenceSpan& span) { return !(span.to < atUs(stretch_.toUs)); });
  keep({pair.trigger, pair.body, link}, spans, first, isTouching);
}

/// Adds the link's own parts, and those of the whole body, to `touching_`.
void LinkPresence::appendParts(const TriggerPair& pair, LinkId link) {
  touching_.clear();
  for (const WorldPart& part : pair.parts) {
    if (part.a.link != link && part.a.link != kEveryLink) continue;
    const bool isNew = !part.beganBefore && part.from.fraction == 0.0 &&
                       std::binary_search(pair.cuts.begin(), pair.cuts.end(), part.from.us);
    const Presence presence =
        part.kind == PartKind::Contact ? Presence::Inside : Presence::Unresolved;
    touching_.push_back({part.from, part.to, presence, link, part.isAssumed, isNew});
  }
  std::sort(touching_.begin(), touching_.end(), [](const PresenceSpan& x, const PresenceSpan& y) {
    return x.from == y.from ? x.to < y.to : x.from < y.from;
  });
}

/// Finds what `touching_` leaves of the time in which both are there, cut where known anew.
void LinkPresence::findGaps(const TriggerPair& pair) {
  gaps_.clear();
  const std::int64_t thereUs = std::max({stretch_.fromUs, appearsUs(world_->body(pair.body)),
                                         appearsUs(world_->body(pair.ofTrigger))});
  WorldTime from = atUs(thereUs);
  auto cut = pair.cuts.begin();
  const auto addUntil = [&](const WorldTime& until) {
    while (from < until) {
      while (cut != pair.cuts.end() && atUs(*cut) < from) ++cut;
      const bool isNew = cut != pair.cuts.end() && atUs(*cut) == from;
      if (isNew) ++cut;
      Gap gap{from, until, isNew};
      if (cut != pair.cuts.end() && atUs(*cut) < until) gap.to = atUs(*cut);
      gaps_.push_back(gap);
      from = gap.to;
    }
  };
  for (const PresenceSpan& span : touching_) {
    addUntil(span.from);
    if (from < span.to) from = span.to;
  }
  addUntil(atUs(stretch_.toUs));
}

LinkPresence::Decided LinkPresence::presenceIn(const TriggerPair& pair, LinkId link,
                                               const Gap& gap) {
  if (!pair.volume->mesh) return {};  // what does not touch what is solid is outside
  if (!gap.isNew && gap.from == atUs(stretch_.fromUs)) {
    // Nothing has touched the surface since the stretch before.
    const auto kept = ends_.find({pair.trigger, pair.body, link});
    if (kept == ends_.end()) return {};
    if (kept->second == End::Inside) {
      // Whether it is assumed may have changed; that alone is asked.
      Decided decided = decide(pair, link, between(gap.from, gap.to, kAskedAt[0]));
      decided.presence = Presence::Inside;
      return decided;
    }
  }
  Decided decided;
  for (const double share : kAskedAt) {
    decided = decide(pair, link, between(gap.from, gap.to, share));
    if (decided.presence != Presence::Unresolved) break;
  }
  return decided;
}

LinkPresence::Decided LinkPresence::decide(const TriggerPair& pair, LinkId link,
                                           const WorldTime& time) {
  if (isCarriedBy(pair, link, time.us)) return {};
  ++counters_.decided;
  const PlaceKnown trigger = bodies_.at(*world_, pair.ofTrigger, time, ofTrigger_);
  const PlaceKnown body = bodies_.at(*world_, pair.body, time, ofBody_);
  const auto isUnknown = [](PlaceKnown how) {
    return how == PlaceKnown::Silent || how == PlaceKnown::NotThere;
  };
  if (isUnknown(trigger) || isUnknown(body)) return {Presence::Unresolved, false};
  Decided decided;
  decided.isAssumed = trigger == PlaceKnown::Assumed || body == PlaceKnown::Assumed;
  findPieces(pair.body, link);
  for (const Lss& lss : pieces_) {
    // Nothing of the piece is at the surface: one point says where it is.
    double rounding = 0.0;
    const Lss seen =
        seenFrom(ofTrigger_.front(), placed(lss, ofBody_[slotOf(link)], rounding), rounding);
    const PointPlace place = pair.volume->mesh->placeOf(seen.a, rounding, memory_);
    if (place == PointPlace::Inside) {
      decided.presence = Presence::Inside;
      return decided;
    }
    if (place == PointPlace::AtSurface) decided.presence = Presence::Unresolved;
  }
  return decided;
}

/// An LSS is one; so are triangles that hang together.
void LinkPresence::findPieces(BodyId body, LinkId link) {
  const BodyKind& kind = world_->kindOf(body);
  const LinkSurface* const surface = surfaceOf(kind, link);
  const std::vector<Lss>& volumes = kind.volumes[slotOf(link)];
  if (surface == nullptr) {
    pieces_ = volumes;
    return;
  }
  pieces_.clear();
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    if (!surface->hasTriangles(static_cast<std::int32_t>(i))) pieces_.push_back(volumes[i]);
  }
  for (const Eigen::Vector3d& corner : surface->cornerOfPieces()) {
    pieces_.push_back({corner, corner, 0.0});
  }
}

/// A body and the link that carries it are not asked whether they meet (World::attach()).
bool LinkPresence::isCarriedBy(const TriggerPair& pair, LinkId link, std::int64_t us) const {
  const Episode* const ofTrigger = world_->body(pair.ofTrigger).episodeAt(us);
  const Episode* const ofBody = world_->body(pair.body).episodeAt(us);
  const auto is = [](const Episode* episode, BodyId carrier, LinkId carrying) {
    return episode != nullptr && episode->carrier && episode->carrier->body == carrier &&
           episode->carrier->link == carrying;
  };
  const bool isRoot = world_->kindOf(pair.body).skeleton.parent(link) == kNoParent;
  return is(ofTrigger, pair.body, link) ||
         (is(ofBody, pair.ofTrigger, 0) && (isRoot || ofBody->isHeldFast()));
}

void LinkPresence::keep(const Key& key, const std::vector<PresenceSpan>& spans, std::size_t first,
                        bool isTouching) {
  ends_.erase(key);
  for (std::size_t i = first; i < spans.size(); ++i) {
    if (spans[i].to < atUs(stretch_.toUs)) continue;
    const End end = spans[i].presence == Presence::Unresolved ? End::Unresolved
                    : isTouching                              ? End::Touching
                                                              : End::Inside;
    const auto [place, isNew] = ends_.emplace(key, end);
    if (!isNew && end != End::Inside) place->second = end;
  }
}

}  // namespace foretouch::internal
