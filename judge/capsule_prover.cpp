// judge/capsule_prover.cpp: subdivision with two certificates, in double if that is enough.
#include "judge/capsule_prover.h"

#include "judge/certificate.h"

namespace foretouch::oracle {
namespace {

/// A first span may meet very many triangles; cutting it is cheaper than examining them all.
constexpr std::size_t kMostCandidates = 256;
/// Spans shorter than this keep all their candidates: the candidates no longer shrink with the
/// span.
constexpr Real kCrowdedSpan = 0x1p-8L;

}  // namespace

struct CapsuleProver::Look {
  Real middle = 0;
  HullLook hull;
  double around = 0;  // triangles farther from the axis than this need no look
  Box box;
};

CapsuleProver::CapsuleProver(const Scene& scene, const Motion& motion, int link,
                             const Capsule& capsule)
    : SurfaceInScene(scene), motion_(motion), link_(link), capsule_(capsule) {
  const Real rho = std::max(norm(capsule.ends[0].as<Real>()), norm(capsule.ends[1].as<Real>()));
  scale_ = std::max(Real(1), motion.reach(link, rho + static_cast<Real>(capsule.radius)));
  guard_ = kSoundGuard * scale_;
}

CapsuleProver::Look CapsuleProver::lookAt(Real from, Real to) const {
  Look look;
  look.middle = from + (to - from) / 2;
  // The larger half, so that rounding of the middle leaves no gap.
  const Real half = std::max(look.middle - from, to - look.middle);
  const auto ends = motion_.pointsAt(link_, capsule_.ends, look.middle, half);
  look.hull = hullLook(ends.data(), ends.size(), half);
  // Triangles outside this box are farther than stray + radius; the slack covers its own rounding.
  look.around = (look.hull.quick.stray + capsule_.radius) * (1 + kDoubleMargin) +
                static_cast<double>(scale_) * kDoubleMargin;
  const Vec3d around{look.around, look.around, look.around};
  for (const MovingPoint& end : ends) {
    const Vec3d p = end.position.as<double>();
    look.box.add(p - around);
    look.box.add(p + around);
  }
  return look;
}

/// Could the triangle be within look.around of the axis? By its ball: a slanted axis fills little
/// of its box.
bool CapsuleProver::isNear(const Look& look, int triangle) const {
  const Scene::Ball& ball = scene_.ballOf(triangle);
  const Vec3d from = ball.center - look.hull.reference - look.hull.quick.points[0];
  const Vec3d along = look.hull.quick.points[1] - look.hull.quick.points[0];
  const double length2 = dot(along, along), share = dot(from, along);
  Vec3d off = from;
  if (share >= length2) {
    off = from - along;
  } else if (share > 0) {
    off = from - (share / length2) * along;
  }
  const double reach = look.around + ball.radius;
  return dot(off, off) <= reach * reach * (1 + kDoubleMargin);
}

bool CapsuleProver::gather(const Look& look, const std::vector<int>* inherited,
                           std::vector<int>& candidates) const {
  if (inherited != nullptr) {
    for (const int id : *inherited) {
      if (scene_.boxOf(id).meets(look.box) && isNear(look, id)) candidates.push_back(id);
    }
    return true;
  }
  const bool crowded = look.hull.exact.halfSpan < kCrowdedSpan;
  const auto everything = static_cast<std::size_t>(scene_.numTriangles());
  const bool complete =
      scene_.collect(look.box, crowded ? everything : kMostCandidates, candidates);
  const auto far = [&](int id) { return !isNear(look, id); };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), far), candidates.end());
  return complete;
}

/// True if the triangle is proved free throughout the look's span.
bool CapsuleProver::examine(const Look& look, int triangle) {
  Real separation = 0;
  const HullCheck check =
      checkHull(look.hull, capsule_.radius, guard_, scene_.triangle(triangle), separation);
  if (check == HullCheck::Touching) {
    outcome_.touching = look.middle;
    outcome_.separation = separation;
  }
  return check == HullCheck::Free;
}

// Depth is bounded by kShortestSpan: at most 41 levels.
bool CapsuleProver::proveSpan(Real from, Real to, const std::vector<int>* inherited) {
  outcome_.freeUntil = from;
  if (++outcome_.looks > kMostLooks) return false;
  const Look look = lookAt(from, to);
  std::vector<int> candidates;
  const bool complete = gather(look, inherited, candidates);
  if (complete) {
    std::size_t i = 0;
    while (i < candidates.size() && examine(look, candidates[i])) ++i;
    if (i == candidates.size()) {
      outcome_.freeUntil = to;
      return true;
    }
    if (outcome_.touching) return false;
    std::swap(candidates[0], candidates[i]);  // a triangle that resists in the whole likely resists
                                              // in the halves
    if (to - from < kShortestSpan) {
      ++outcome_.grazing;
      outcome_.freeUntil = to;
      return true;
    }
  }
  const std::vector<int>* handed = complete ? &candidates : nullptr;
  return proveSpan(from, look.middle, handed) && proveSpan(look.middle, to, handed);
}

SpanOutcome CapsuleProver::prove(Real from, Real to) {
  outcome_ = SpanOutcome{};
  outcome_.freeUntil = from;
  // Middles never reach the ends: examines these two instants separately.
  constexpr double kNear = 1e-9;  // any positive number: only contact matters here
  const Real atStart = separationAt(from, kNear), atEnd = separationAt(to, kNear);
  if (touches(atStart)) {
    outcome_.touching = from;
    outcome_.separation = atStart;
    return outcome_;
  }
  outcome_.free = proveSpan(from, to, nullptr) && !touches(atEnd);
  if (touches(atEnd) && !outcome_.touching) {
    outcome_.touching = to;
    outcome_.separation = atEnd;
  }
  return outcome_;
}

std::array<Vec3r, 2> CapsuleProver::axisAt(Real t) const {
  const auto ends = motion_.pointsAt(link_, capsule_.ends, t, 0);
  return {ends[0].position, ends[1].position};
}

Real CapsuleProver::pairSeparation(const std::array<Vec3r, 2>& axis, int triangle) const {
  Corners<Real> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = scene_.triangle(triangle)[i].as<Real>() - axis[0];
  }
  return closestPoints(Vec3r{}, axis[1] - axis[0], corners).distance -
         static_cast<Real>(capsule_.radius);
}

Real CapsuleProver::separationFrom(int, int triangle, Real t) const {
  return pairSeparation(axisAt(t), triangle);
}

Real CapsuleProver::distanceToCore(int, const Vec3r& point, Real t) const {
  const auto axis = axisAt(t);
  return pointSegmentDistance(point, axis[0], axis[1]);
}

Real CapsuleProver::separationAt(Real t, double within) const {
  const auto axis = axisAt(t);
  Box box;
  for (const Vec3r& end : axis) box.add(end.as<double>());
  const double slack = kDoubleMargin * static_cast<double>(scale_);  // the box is rounded
  double reach = within + capsule_.radius + slack;
  Real least = within;
  scene_.visitNear(box, reach, [&](int id) {
    least = std::min(least, pairSeparation(axis, id));
    reach = std::min(reach, static_cast<double>(least) + capsule_.radius + slack);
  });
  return least;
}

}  // namespace foretouch::oracle
