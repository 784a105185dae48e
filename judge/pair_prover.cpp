// judge/pair_prover.cpp: pairs of parts and spans of time, halved in turn.
#include "judge/pair_prover.h"

#include <algorithm>
#include <tuple>

namespace foretouch::oracle {
namespace {

/// The deepest joint that is `a` or `b` itself or above, for both; -1: the world.
int commonAbove(const Motion& motion, int a, int b) {
  const auto depth = [&](int link) { return link < 0 ? 0 : motion.bounds(link).depth; };
  while (a != b) {
    int& deeper = depth(a) > depth(b) ? a : b;
    deeper = motion.parent(deeper);
  }
  return a;
}

Real farthest(const std::vector<Hull>& hulls) {
  Real rho = 0;
  for (const Hull& hull : hulls) {
    for (int k = 0; k < hull.count; ++k) {
      const Vec3r p = hull.points[static_cast<std::size_t>(k)].as<Real>();
      rho = std::max(rho, norm(p) + static_cast<Real>(hull.radius));
    }
  }
  return rho;
}

}  // namespace

PairProver::Side::Side(std::vector<Hull> ofLink)
    : hulls(std::move(ofLink)), parts(hulls), link(hulls.front().link) {}

PairProver::PairProver(const Motion& motion, std::vector<Hull> one, std::vector<Hull> other,
                       std::vector<RadiusSum> sums)
    : motion_(motion),
      one_(std::move(one)),
      other_(std::move(other)),
      sums_(std::move(sums)),
      frame_(commonAbove(motion, one_.link, other_.link)) {
  std::sort(sums_.begin(), sums_.end(), [](const RadiusSum& x, const RadiusSum& y) {
    return std::tie(x.piece, x.other) < std::tie(y.piece, y.other);
  });
  for (const Side* side : {&one_, &other_}) {
    const Real rho = farthest(side->hulls);
    scale_ = std::max(scale_, motion.reach(side->link, rho, frame_));
    scaleInWorld_ = std::max(scaleInWorld_, motion.reach(side->link, rho));
  }
  guard_ = kSoundGuard * scale_;
}

Real PairProver::shareOf(int piece, int other) const {
  const auto found = std::lower_bound(
      sums_.begin(), sums_.end(), std::tie(piece, other),
      [](const RadiusSum& x, const auto& y) { return std::tie(x.piece, x.other) < y; });
  if (found == sums_.end() || found->piece != piece || found->other != other) return 1;
  return static_cast<Real>(found->sum) /
         (static_cast<Real>(one_.hull(piece).radius) + other_.hull(other).radius);
}

Real PairProver::radius(int piece, int other) const {
  return shareOf(piece, other) * one_.hull(piece).radius;
}

Real PairProver::radiusOfOther(int piece, int other) const {
  return shareOf(piece, other) * other_.hull(other).radius;
}

Real PairProver::sumOf(int piece, int other) const {
  return radius(piece, other) + radiusOfOther(piece, other);
}

MovingPoint PairProver::centerOf(const Side& side, int part, Real t, Real half) const {
  const std::array<Vec3d, 1> center{side.parts.part(part).center};
  return motion_.pointsAt(side.link, center, t, half, frame_)[0];
}

/// Relative to `reference`, or to its own first point.
HullLook PairProver::lookAt(const Side& side, int piece, Real middle, Real half,
                            const Vec3d* reference) const {
  const Hull& hull = side.hull(piece);
  const auto points = motion_.pointsAt(side.link, hull.points, middle, half, frame_);
  const auto count = static_cast<std::size_t>(hull.count);
  return reference == nullptr ? hullLook(points.data(), count, half)
                              : hullLook(points.data(), count, half, *reference);
}

HullCheck PairProver::examine(Parts parts, Real middle, Real half) {
  const int piece = one_.parts.hullOf(one_.parts.part(parts.one));
  const int other = other_.parts.hullOf(other_.parts.part(parts.other));
  const HullLook look = lookAt(one_, piece, middle, half, nullptr);
  const HullLook there = lookAt(other_, other, middle, half, &look.reference);
  Real separation = 0;
  const HullCheck check = checkHull(look, sumOf(piece, other), guard_, there, separation);
  if (check == HullCheck::Touching) {
    outcome_.touching = middle;
    outcome_.separation = separation;
  }
  return check;
}

std::array<PairProver::Parts, 2> PairProver::halved(Parts parts) const {
  const BallPart& one = one_.parts.part(parts.one);
  const BallPart& other = other_.parts.part(parts.other);
  if (!one.isSingle() && (other.isSingle() || one.radius >= other.radius)) {
    return {Parts{one.left, parts.other}, Parts{one.right, parts.other}};
  }
  return {Parts{parts.one, other.left}, Parts{parts.one, other.right}};
}

bool PairProver::proveHalves(Parts parts, Real from, Real to) {
  const std::array<Parts, 2> halves = halved(parts);
  if (!proveSpan(halves[0], from, to)) {
    outcome_.freeUntil = from;  // the other half is unexamined
    return false;
  }
  return proveSpan(halves[1], from, to);
}

// At every instant each part lies within its radius of its center, and the two centers come nearer
// by `way` at most. Depth is bounded by the trees' and by kShortestSpan's 41 levels.
bool PairProver::proveSpan(Parts parts, Real from, Real to) {
  outcome_.freeUntil = from;
  if (++outcome_.looks > kMostLooks) return false;
  const Real middle = from + (to - from) / 2;
  const Real half = std::max(middle - from, to - middle);
  const MovingPoint one = centerOf(one_, parts.one, middle, half);
  const MovingPoint other = centerOf(other_, parts.other, middle, half);
  const BallPart& partOfOne = one_.parts.part(parts.one);
  const BallPart& partOfOther = other_.parts.part(parts.other);
  const MovingPoint relative{one.position - other.position, one.velocity - other.velocity,
                             one.speed + other.speed, one.acceleration + other.acceleration};
  const Real way = relative.stray(half);
  const Real radii = static_cast<Real>(partOfOne.radius) + partOfOther.radius;
  const bool isSingle = partOfOne.isSingle() && partOfOther.isSingle();
  const bool isShortest = to - from < kShortestSpan;
  bool isFree = norm(relative.position) - radii - way > kDoubleMargin * scale_;
  if (!isFree && isSingle) {
    const HullCheck check = examine(parts, middle, half);
    if (check == HullCheck::Touching) return false;
    isFree = check == HullCheck::Free;
    if (!isFree && isShortest) {
      ++outcome_.grazing;
      isFree = true;
    }
  }
  if (isFree) {
    outcome_.freeUntil = to;
    return true;
  }
  // A single hull's large ball, too, is a reason to come down to where certificates decide.
  const Real larger = std::max(partOfOne.radius, partOfOther.radius);
  if (!isSingle && (larger > way || isShortest)) return proveHalves(parts, from, to);
  return proveSpan(parts, from, middle) && proveSpan(parts, middle, to);
}

/// False if the links touch; within the guard counts as free.
bool PairProver::proveInstant(Real t) {
  const SpanOutcome before = outcome_;
  const bool isFree = proveSpan({}, t, t);
  outcome_.freeUntil = before.freeUntil;
  outcome_.grazing = before.grazing;
  return isFree;
}

// Middles never reach the ends: examines these two instants separately.
SpanOutcome PairProver::prove(Real from, Real to) {
  outcome_ = SpanOutcome{};
  outcome_.freeUntil = from;
  if (!proveInstant(from)) return outcome_;
  const bool isSpanFree = proveSpan({}, from, to);
  if (outcome_.touching) return outcome_;
  outcome_.free = proveInstant(to) && isSpanFree;
  return outcome_;
}

Real PairProver::separationFrom(int piece, int other, Real t) const {
  const HullLook look = lookAt(one_, piece, t, 0, nullptr);
  const HullLook there = lookAt(other_, other, t, 0, &look.reference);
  return closestPoints(look.exact, there.exact).distance - sumOf(piece, other);
}

Real PairProver::distanceInWorld(const Side& side, int piece, const Vec3r& point, Real t) const {
  const Hull& hull = side.hull(piece);
  const auto points = motion_.pointsAt(side.link, hull.points, t, 0);
  Corners<Real> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = points[std::min(i, static_cast<std::size_t>(hull.count - 1))].position - point;
  }
  return closestPoints(Vec3r{}, Vec3r{}, corners).distance;
}

Real PairProver::distanceToCore(int piece, const Vec3r& point, Real t) const {
  return distanceInWorld(one_, piece, point, t);
}

Real PairProver::distanceToOther(int other, const Vec3r& point, Real t) const {
  return distanceInWorld(other_, other, point, t);
}

Real PairProver::separationAt(Real t, double within) const {
  Real least = within;
  nearest({}, t, least);
  return least;
}

/// Skips parts whose balls are no nearer than the known least.
void PairProver::nearest(Parts parts, Real t, Real& least) const {
  const BallPart& one = one_.parts.part(parts.one);
  const BallPart& other = other_.parts.part(parts.other);
  const Vec3r between =
      centerOf(one_, parts.one, t, 0).position - centerOf(other_, parts.other, t, 0).position;
  if (norm(between) - one.radius - other.radius - kDoubleMargin * scale_ >= least) return;
  if (one.isSingle() && other.isSingle()) {
    least = std::min(least, separationFrom(one_.parts.hullOf(one), other_.parts.hullOf(other), t));
    return;
  }
  for (const Parts& half : halved(parts)) nearest(half, t, least);
}

}  // namespace foretouch::oracle
