// judge/skin_prover.cpp: triangles of a skin and spans of time, halved in turn.
#include "judge/skin_prover.h"

#include <algorithm>
#include <utility>

namespace foretouch::oracle {

SkinProver::SkinProver(const Scene& scene, const Motion& motion, std::vector<SkinTriangle> skin)
    : SurfaceInScene(scene), motion_(motion), skin_(std::move(skin)) {
  for (const SkinTriangle& triangle : skin_) {
    for (const SkinCorner& corner : triangle) {
      for (const SkinShare& share : corner) {
        scale_ = std::max(scale_, motion.reach(share.link, norm(share.point.as<Real>())));
      }
    }
  }
  guard_ = kSoundGuard * scale_;
}

// Weights are above 0, so the sums of the shares' bounds bound their sum.
std::array<MovingPoint, 3> SkinProver::cornersAt(int piece, Real t, Real half) const {
  std::array<MovingPoint, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const SkinShare& share : skin_[static_cast<std::size_t>(piece)][i]) {
      const MovingPoint own =
          motion_.pointsAt(share.link, std::array<Vec3d, 1>{share.point}, t, half)[0];
      const auto weight = static_cast<Real>(share.weight);
      corners[i].position = corners[i].position + weight * own.position;
      corners[i].velocity = corners[i].velocity + weight * own.velocity;
      corners[i].speed += weight * own.speed;
      corners[i].acceleration += weight * own.acceleration;
    }
  }
  return corners;
}

/// Around everything that the triangle covers within `half` of the instant.
Box SkinProver::boxOf(const std::array<MovingPoint, 3>& corners, Real half) const {
  Box box;
  for (const MovingPoint& corner : corners) {
    const double around = static_cast<double>(corner.stray(half)) * (1 + kDoubleMargin) +
                          static_cast<double>(scale_) * kDoubleMargin;
    const Vec3d p = corner.position.as<double>(), aside{around, around, around};
    box.add(p - aside);
    box.add(p + aside);
  }
  return box;
}

/// Leaves the candidates that are not proved free.
void SkinProver::examine(const std::array<MovingPoint, 3>& corners, Real middle, Real half,
                         Candidates& candidates) {
  const HullLook look = hullLook(corners.data(), corners.size(), half);
  Candidates open;
  for (const int id : candidates) {
    Real separation = 0;
    const HullCheck check = checkHull(look, 0, guard_, scene_.triangle(id), separation);
    if (check == HullCheck::Touching) {
      outcome_.touching = middle;
      outcome_.separation = separation;
      return;
    }
    if (check == HullCheck::Open) open.push_back(id);
  }
  candidates = std::move(open);
}

// Depth is bounded by kShortestSpan's 41 levels.
bool SkinProver::proveSpan(int piece, Real from, Real to, const Candidates& inherited) {
  if (++outcome_.looks > kMostLooks) return false;
  const Real middle = from + (to - from) / 2;
  const Real half = std::max(middle - from, to - middle);
  const auto corners = cornersAt(piece, middle, half);
  const Box box = boxOf(corners, half);
  Candidates candidates;
  for (const int id : inherited) {
    if (scene_.boxOf(id).meets(box)) candidates.push_back(id);
  }
  if (!candidates.empty()) examine(corners, middle, half, candidates);
  if (outcome_.touching) return false;
  if (candidates.empty()) return true;
  if (to - from < kShortestSpan) {
    ++outcome_.grazing;
    return true;
  }
  return proveSpan(piece, from, middle, candidates) && proveSpan(piece, middle, to, candidates);
}

// Middles never reach the ends: examines these two instants separately, the later one only if
// nothing touches before.
SpanOutcome SkinProver::prove(Real from, Real to) {
  constexpr double kNear = 1e-9;  // any positive number: only contact matters here
  outcome_ = SpanOutcome{};
  outcome_.freeUntil = from;
  const auto touchesAt = [&](Real end) {
    const Real separation = separationAt(end, kNear);
    if (separation > 0) return false;
    outcome_.touching = end;
    outcome_.separation = separation;
    return true;
  };
  if (touchesAt(from)) return outcome_;
  const Real half = (to - from) / 2;
  for (int piece = 0; piece < numPieces(); ++piece) {
    Candidates near;
    scene_.collect(boxOf(cornersAt(piece, from + half, half), half),
                   static_cast<std::size_t>(scene_.numTriangles()), near);
    if (!near.empty() && !proveSpan(piece, from, to, near)) return outcome_;
  }
  if (touchesAt(to)) return outcome_;
  outcome_.free = true;
  outcome_.freeUntil = to;
  return outcome_;
}

Corners<Real> SkinProver::pieceAt(int piece, Real t) const {
  const auto p = cornersAt(piece, t, 0);
  return {p[0].position, p[1].position, p[2].position};
}

Real SkinProver::distanceToCore(int piece, const Vec3r& point, Real t) const {
  Corners<Real> corners = pieceAt(piece, t);
  for (Vec3r& corner : corners) corner = corner - point;
  return closestPoints(Vec3r{}, Vec3r{}, corners).distance;
}

Real SkinProver::separationFrom(int piece, int triangle, Real t) const {
  Corners<Real> one = pieceAt(piece, t), other;
  const Vec3r reference = one[0];
  for (std::size_t i = 0; i < 3; ++i) {
    one[i] = one[i] - reference;
    other[i] = scene_.triangle(triangle)[i].as<Real>() - reference;
  }
  return closestPoints(one, other).distance;
}

Real SkinProver::separationAt(Real t, double within) const {
  Real least = within;
  for (int piece = 0; piece < numPieces(); ++piece) {
    double reach = static_cast<double>(least) + static_cast<double>(scale_) * kDoubleMargin;
    scene_.visitNear(boxOf(cornersAt(piece, t, 0), 0), reach, [&](int id) {
      least = std::min(least, separationFrom(piece, id, t));
      reach =
          std::min(reach, static_cast<double>(least) + static_cast<double>(scale_) * kDoubleMargin);
    });
  }
  return least;
}

}  // namespace foretouch::oracle
