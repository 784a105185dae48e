#include "middleware/ask/flight_asker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/ask/piece_asker.h"
#include "middleware/ask/way_boxes.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Steps of one piece in one span. What needs more is not resolved: reported as unknown, never as
/// free.
constexpr int kMostFlightSteps = 512;

/// When the free space is used up that shrinks by `pace` per us, which itself grows by
/// `acceleration` per us; rounded down.
double usUntil(double free, double pace, double acceleration) {
  // The root of free - pace h - acceleration h^2/2 = 0, in the form that cancels nothing.
  const double root = std::sqrt(pace * pace + 2.0 * acceleration * free);
  const double below = pace > 0.0 ? pace + root : 0.0;
  if (below > 0.0) return 2.0 * free / (kInflation * below);
  if (!(acceleration > 0.0)) return std::numeric_limits<double>::infinity();
  return (root - pace) / (kInflation * acceleration);
}

/// How fast, at most, a shape of this velocity and the piece come closer along the normal.
double paceOf(const MovingPiece& piece, const Vector3d& nhat, const Vector3d& velocity) {
  double pace = nhat.dot(piece.velocities[0] - velocity);
  double most = velocity.lpNorm<1>() + piece.velocities[0].lpNorm<1>();
  for (std::size_t i = 1; i < countOf(piece.hull.count); ++i) {
    pace = std::max(pace, nhat.dot(piece.velocities[i] - velocity));
    most = std::max(most, velocity.lpNorm<1>() + piece.velocities[i].lpNorm<1>());
  }
  return pace + kSeparationRounding * most + kInflation * piece.ofVelocity;
}

/// The box that an LSS stays in.
Aabb boxOf(const PieceBoxes& boxes, std::size_t lss) {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = boxes.origin[axis] + static_cast<double>(boxes.lower[slotOf(axis)][lss]);
    box.max[axis] = boxes.origin[axis] + static_cast<double>(boxes.upper[slotOf(axis)][lss]);
  }
  box.grow(0.0);  // the sums are rounded
  return box;
}

}  // namespace

/// A shape on its flight and a piece that it meets.
struct FlightMeeting {
  MovingPiece piece;
  AskedShape shape;
  Meeting meeting;
};

FlightAsker::FlightAsker(const WorldParts& world, const FlightQuestion& question,
                         const AskFilter& filter, AskMemory& memory, FlightAnswer& answer)
    : world_(world),
      question_(question),
      filter_(filter),
      memory_(memory),
      boxes_(memory.bodies),
      moving_(memory.moving),
      answer_(answer),
      durationUs_(static_cast<double>(question.toUs - question.fromUs)),
      bestUs_(durationUs_) {
  begin_.lss = question.shape;
  begin_.takeHull(question.hull, memory.hull);
}

AskedShape FlightAsker::shapeAt(double us) const {
  AskedShape shape;
  const double share = std::min(1.0, (spanFromUs_ + us) / durationUs_);
  shape.lss = begin_.lss;
  shape.hull = begin_.hull;
  shape.lss.a += share * question_.way;
  shape.lss.b += share * question_.way;
  shape.moved = share * question_.way.norm();
  // Three roundings of the share, a product and a sum; the microseconds of a span are known to u of
  // those of the flight.
  shape.rounding = begin_.rounding + kSeparationRounding * (std::max(begin_.lss.a.lpNorm<1>(),
                                                                     begin_.lss.b.lpNorm<1>()) +
                                                            2.0 * question_.way.lpNorm<1>());
  return shape;
}

/// Counted from the span's begin.
double FlightAsker::limitUs() const {
  return std::min(spanUs_, bestUs_ - spanFromUs_);
}

void FlightAsker::askStill(const Scene& scene) {
  AskedShape shape = begin_;
  const double length = question_.way.norm();
  if (length > 0.0) shape.way = question_.way / length;
  shape.reach = length;
  WorldAnswer& answer = memory_.ofStill;
  answer.hits.clear();
  HitList hits(length, AskWhich::Closest, answer);
  const LinkPlace inPlace;
  PieceAsker asker(filter_, shape, inPlace, false, hits);
  askScene(scene.parts(), ContactSide(), asker);
  if (answer.hits.empty()) return;
  const WorldHit& hit = answer.hits.front();
  const double share = length > 0.0 ? std::min(1.0, hit.distance / (kInflation * length)) : 0.0;
  bestUs_ = share * durationUs_;
  answer_.first = FlightHit{hit, worldTimeAt(question_.fromUs, question_.toUs, share)};
}

void FlightAsker::askBody(BodyId body) {
  const auto tell = [&](AskUnknown why) {
    const auto& unknown = answer_.unknown;
    const bool isTold = !unknown.empty() && unknown.back().body == body &&
                        (unknown.back().why == why || why == AskUnknown::Assumed);
    if (!isTold) answer_.unknown.push_back({body, why, kEveryObject});
  };
  for (std::int64_t us = question_.fromUs; us < question_.toUs; us = moving_.endUs()) {
    spanFromUs_ = static_cast<double>(us - question_.fromUs);
    if (spanFromUs_ > bestUs_) return;
    const PlaceKnown how = moving_.begin(world_, body, us, question_.toUs);
    if (how == PlaceKnown::NotThere) tell(AskUnknown::NotThere);
    if (how == PlaceKnown::Silent) tell(AskUnknown::Silent);
    if (how == PlaceKnown::NotThere || how == PlaceKnown::Silent) continue;
    isAssumed_ = how == PlaceKnown::Assumed;
    if (isAssumed_) tell(AskUnknown::Assumed);
    spanUs_ = static_cast<double>(moving_.endUs() - us);
    if (!askSpan(body)) tell(AskUnknown::Unresolved);
  }
}

bool FlightAsker::askSpan(BodyId body) {
  const BodyKind& kind = world_.kindOf(body);
  if (kind.mesh && !kind.surface) return false;
  const PieceBoxes* const boxes =
      moving_.isCarried() ? nullptr : &boxes_.piecesOf(body, moving_.piece());
  // A skin is not followed as it bends.
  if (kind.skin) return boxes != nullptr && !mayReach(boxes->box);
  ContactSide side;
  side.body = body;
  bool isResolved = true;
  std::size_t first = 0;  // LSS of the current link
  for (std::size_t i = 0; i < kind.linkOf.size(); ++i) {
    if (i > 0 && kind.linkOf[i] != kind.linkOf[i - 1]) first = i;
    side.link = kind.linkOf[i];
    side.lss = static_cast<std::int32_t>(i - first);
    if (boxes != nullptr && !mayReach(boxOf(*boxes, i))) continue;
    const LinkSurface* const surface = surfaceOf(kind, side.link);
    if (surface != nullptr && surface->hasTriangles(side.lss)) {
      isResolved = askTriangles(side, *surface) && isResolved;
    } else if (filter_.takes(body, side.link, kEveryObject)) {
      const Lss& lss = kind.volumes[slotOf(side.link)][slotOf(side.lss)];
      isResolved = askPiece(side, Hull::segment(lss.a, lss.b), lss.radius) && isResolved;
    }
  }
  return isResolved;
}

/// Whether the shape's way through the span meets the box that a body or piece stays in.
bool FlightAsker::mayReach(const Aabb& box) const {
  const double until = limitUs();
  if (until < 0.0) return false;
  const AskedShape from = shapeAt(0.0), to = shapeAt(until);
  Aabb swept;
  for (const AskedShape& shape : {from, to}) {
    const Aabb there = shape.box();
    swept.add(there.min);
    swept.add(there.max);
  }
  swept.grow(question_.shape.radius + from.rounding);
  return swept.overlaps(box);
}

bool FlightAsker::askPiece(const ContactSide& side, const Hull& hull_L, double radius) {
  double us = 0.0;
  FlightMeeting met;
  const Outcome outcome = touches(side.link, hull_L, radius, us, met);
  if (outcome != Outcome::Touch) return outcome == Outcome::Free;
  const double whenUs = spanFromUs_ + us;
  if (answer_.first && whenUs >= bestUs_) return true;
  const Vector3d way = question_.way / durationUs_ - met.piece.velocities[0];
  if (way.norm() > 0.0) met.shape.way = way.normalized();
  FlightHit hit;
  hit.hit = hitOf(met.shape, met.piece.hull, radius, met.meeting);
  takeOwner(side, hit.hit);
  hit.hit.isAssumed = isAssumed_;
  const BodyKind& kind = world_.kindOf(side.body);
  if (kind.mesh) {
    hit.hit.what.lss = -1;
    hit.hit.object = kind.mesh->object(side.triangle);
  }
  // From the span's own begin: where it begins in touch, this is that instant, not one before it.
  const double wholeUs = std::floor(us);
  hit.time = {question_.fromUs + static_cast<std::int64_t>(spanFromUs_ + wholeUs), us - wholeUs};
  answer_.first = hit;
  bestUs_ = whenUs;
  return true;
}

/// The nearest in time first: what is below a node touches no earlier than it does.
bool FlightAsker::askTriangles(const ContactSide& side, const LinkSurface& surface) {
  const LssHierarchy& hierarchy = surface.hierarchy(side.lss);
  const auto codeOf = [](HierarchyChild child) {
    return child.isTriangle() ? ~child.index() : child.index();
  };
  const Scene* const mesh =
      world_.kindOf(side.body).mesh ? &*world_.kindOf(side.body).mesh : nullptr;
  const auto isLater = [](const AskMemory::LaterPart& x, const AskMemory::LaterPart& y) {
    return x.us > y.us;
  };
  bool isResolved = true;
  std::vector<AskMemory::LaterPart>& parts = memory_.parts;
  parts.assign(1, {0.0, codeOf(hierarchy.root())});
  while (!parts.empty()) {
    std::pop_heap(parts.begin(), parts.end(), isLater);
    const AskMemory::LaterPart part = parts.back();
    parts.pop_back();
    if (part.us > limitUs()) break;
    if (part.child < 0) {
      ContactSide one = side;
      one.triangle = ~part.child;
      const ObjectId object = mesh != nullptr ? mesh->object(one.triangle) : kEveryObject;
      if (!filter_.takes(side.body, side.link, object)) continue;
      const Hull triangle = Hull::of(surface.triangle(one.triangle));
      isResolved = askPiece(one, triangle, 0.0) && isResolved;
      continue;
    }
    const LssHierarchy::Node& node = hierarchy.node(part.child);
    double us = part.us;
    FlightMeeting unused;
    const Hull axis = Hull::segment(node.lss.a, node.lss.b);
    if (touches(side.link, axis, node.lss.radius, us, unused) == Outcome::Free) continue;
    for (const HierarchyChild child : node.children) {
      parts.push_back({us, codeOf(child)});
      std::push_heap(parts.begin(), parts.end(), isLater);
    }
  }
  return isResolved;
}

FlightAsker::Outcome FlightAsker::touches(LinkId link, const Hull& hull_L, double radius,
                                          double& us, FlightMeeting& met) {
  const double limit = limitUs();
  const Vector3d velocity = question_.way / durationUs_;
  for (int step = 0; step < kMostFlightSteps; ++step) {
    if (us > limit) return Outcome::Free;
    met.piece = moving_.at(link, hull_L, us);
    met.shape = shapeAt(us);
    met.meeting.apart = apartAfter(met.shape, 0.0, met.piece.hull);
    const Separation& apart = met.meeting.apart;
    const double sum =
        kInflation * (question_.shape.radius + radius + met.shape.rounding + met.piece.rounding);
    const double free = apart.lower() - sum;
    if (free <= 0.0 || apart.upper <= sum + kAskTolerance) return Outcome::Touch;
    const double pace = paceOf(met.piece, apart.nhat, velocity);
    const double next = std::nextafter(us + usUntil(free, pace, met.piece.acceleration), 0.0);
    if (next > limit) return Outcome::Free;
    if (!(next > us)) return Outcome::Touch;  // doubles do not resolve what is left
    us = next;
  }
  return Outcome::Unresolved;
}

}  // namespace foretouch::internal
