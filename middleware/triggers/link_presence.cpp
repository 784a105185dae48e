#include "middleware/triggers/link_presence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// Instants of a gap at which it is asked, one after the other until one can be answered.
constexpr double kAskedAt[] = {0.5, 0.25, 0.75};
/// The last fraction of a microsecond that can be written.
constexpr double kLastFraction = 0x1.fffffffffffffp-1;

WorldTime atUs(std::int64_t us) {
  return {us, 0.0};
}

/// The instant at a share in (0,1) of the time from one to the other.
WorldTime between(const WorldTime& from, const WorldTime& to, double share) {
  const double after =
      from.fraction + share * microsecondsAfter(from.us, to) - share * from.fraction;
  const auto whole = static_cast<std::int64_t>(after);
  return {from.us + whole, std::min(after - static_cast<double>(whole), kLastFraction)};
}

/// The last instant before one that can be written.
WorldTime justBefore(const WorldTime& time) {
  if (time.fraction > 0.0) return {time.us, std::nextafter(time.fraction, 0.0)};
  return {time.us - 1, kLastFraction};
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
    const Presence presence = presenceIn(pair, link, gap);
    if (presence == Presence::Outside) continue;
    spans.push_back({gap.from, gap.to, presence, link, isAssumedIn(pair, gap), gap.isNew});
  }
  const bool isTouching =
      std::any_of(touching_.begin(), touching_.end(),
                  [&](const PresenceSpan& span) { return !(span.to < atUs(stretch_.toUs)); });
  keep({pair.trigger, pair.body, link}, spans, first, isTouching);
}

/// Adds the link's own parts, those of the whole body, and where it is silent, to `touching_`.
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
  for (const Stretch& silence : pair.silences) {
    touching_.push_back({atUs(silence.fromUs), atUs(silence.toUs), Presence::Unresolved, link});
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

Presence LinkPresence::presenceIn(const TriggerPair& pair, LinkId link, const Gap& gap) {
  if (!pair.volume->mesh) return Presence::Outside;  // what does not touch what is solid is outside
  if (!gap.isNew && gap.from == atUs(stretch_.fromUs)) {
    // Nothing has touched the surface since the stretch before.
    const auto kept = ends_.find({pair.trigger, pair.body, link});
    if (kept == ends_.end()) return Presence::Outside;
    if (kept->second == End::Inside) return Presence::Inside;
  }
  Presence presence = Presence::Unresolved;
  for (const double share : kAskedAt) {
    presence = decide(pair, link, between(gap.from, gap.to, share));
    if (presence != Presence::Unresolved) break;
  }
  return presence;
}

/// Within a gap who is silent stays so: its end says it.
bool LinkPresence::isAssumedIn(const TriggerPair& pair, const Gap& gap) {
  const WorldTime last = justBefore(gap.to);
  return bodies_.at(*world_, pair.ofTrigger, last, ofTrigger_) == PlaceKnown::Assumed ||
         bodies_.at(*world_, pair.body, last, ofBody_) == PlaceKnown::Assumed;
}

Presence LinkPresence::decide(const TriggerPair& pair, LinkId link, const WorldTime& time) {
  if (isCarriedBy(pair, link, time.us)) return Presence::Outside;
  ++counters_.decided;
  const PlaceKnown trigger = bodies_.at(*world_, pair.ofTrigger, time, ofTrigger_);
  const PlaceKnown body = bodies_.at(*world_, pair.body, time, ofBody_);
  const auto isUnknown = [](PlaceKnown how) {
    return how == PlaceKnown::Silent || how == PlaceKnown::NotThere;
  };
  if (isUnknown(trigger) || isUnknown(body)) return Presence::Unresolved;
  Presence presence = Presence::Outside;
  findPieces(pair.body, link);
  for (const Lss& lss : pieces_) {
    // Nothing of the piece is at the surface: one point says where it is.
    double rounding = 0.0;
    const Lss seen =
        seenFrom(ofTrigger_.front(), placed(lss, ofBody_[slotOf(link)], rounding), rounding);
    const PointPlace place = pair.volume->mesh->placeOf(seen.a, rounding, memory_);
    if (place == PointPlace::Inside) return Presence::Inside;
    if (place == PointPlace::AtSurface) presence = Presence::Unresolved;
  }
  return presence;
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
