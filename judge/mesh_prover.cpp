// judge/mesh_prover.cpp: parts of the link and spans of time, halved in turn.
#include "judge/mesh_prover.h"

#include <algorithm>
#include <utility>

namespace foretouch::oracle {
namespace {

/// A part may come near very many triangles; halving is cheaper than listing them all.
constexpr std::size_t kMostCandidates = 256;
/// Spans shorter than this list them anyway.
constexpr Real kCrowdedSpan = 0x1p-8L;

std::vector<Hull> hullsOf(int link, const std::vector<Triangle>& mesh) {
  std::vector<Hull> hulls;
  hulls.reserve(mesh.size());
  for (const Triangle& triangle : mesh) hulls.push_back({link, 3, triangle, 0.0});
  return hulls;
}

}  // namespace

MeshProver::MeshProver(const Scene& scene, const Motion& motion, int link,
                       const std::vector<Triangle>& mesh)
    : SurfaceInScene(scene),
      motion_(motion),
      link_(link),
      mesh_(mesh),
      parts_(hullsOf(link, mesh)) {
  Real rho = 0;
  for (const Triangle& t : mesh_) {
    for (const Vec3d& v : t) rho = std::max(rho, norm(v.as<Real>()));
  }
  scale_ = std::max(Real(1), motion.reach(link, rho));
  guard_ = kSoundGuard * scale_;
}

bool MeshProver::gather(const MovingPoint& center, double around, bool all,
                        const Candidates* inherited, Candidates& candidates) const {
  const Vec3d p = center.position.as<double>();
  const auto isNear = [&](int id) {
    const Scene::Ball& ball = scene_.ballOf(id);
    const double reach = (around + ball.radius) * (1 + kDoubleMargin);
    const Vec3d off = ball.center - p;
    return dot(off, off) <= reach * reach;
  };
  const Vec3d aside{around, around, around};
  Box box;
  box.add(p - aside);
  box.add(p + aside);
  if (inherited != nullptr) {
    for (const int id : *inherited) {
      if (scene_.boxOf(id).meets(box) && isNear(id)) candidates.push_back(id);
    }
    return true;
  }
  const auto everything = static_cast<std::size_t>(scene_.numTriangles());
  if (!scene_.collect(box, all ? everything : kMostCandidates, candidates)) return false;
  const auto isFar = [&](int id) { return !isNear(id); };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), isFar), candidates.end());
  return true;
}

/// Leaves the candidates that are not proved free.
void MeshProver::examine(int piece, Real middle, Real half, Candidates& candidates) {
  const auto corners =
      motion_.pointsAt(link_, mesh_[static_cast<std::size_t>(piece)], middle, half);
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

bool MeshProver::proveHalves(const BallPart& part, Real from, Real to,
                             const Candidates* candidates) {
  if (!proveSpan(part.left, from, to, candidates)) {
    outcome_.freeUntil = from;  // the other half is unexamined
    return false;
  }
  return proveSpan(part.right, from, to, candidates);
}

// At every instant the part lies within its radius of its center. Depth is bounded by the tree's
// and by kShortestSpan's 41 levels.
bool MeshProver::proveSpan(int index, Real from, Real to, const Candidates* inherited) {
  outcome_.freeUntil = from;
  if (++outcome_.looks > kMostLooks) return false;
  const BallPart& part = parts_.part(index);
  const bool single = part.isSingle(), shortest = to - from < kShortestSpan;
  const Real middle = from + (to - from) / 2;
  const Real half = std::max(middle - from, to - middle);
  const MovingPoint center =
      motion_.pointsAt(link_, std::array<Vec3d, 1>{part.center}, middle, half)[0];
  const auto way = static_cast<double>(center.stray(half));
  const double around =
      (part.radius + way) * (1 + kDoubleMargin) + static_cast<double>(scale_) * kDoubleMargin;
  Candidates candidates;
  const bool listAll = single || half < kCrowdedSpan;
  const bool complete = gather(center, around, listAll, inherited, candidates);
  if (single && !candidates.empty()) {
    examine(parts_.hullOf(part), middle, half, candidates);
    if (outcome_.touching) return false;
    if (!candidates.empty() && shortest) {
      ++outcome_.grazing;
      candidates.clear();
    }
  }
  if (complete && candidates.empty()) {
    outcome_.freeUntil = to;
    return true;
  }
  const Candidates* handed = complete ? &candidates : nullptr;
  if (!single && (part.radius > way || shortest)) return proveHalves(part, from, to, handed);
  return proveSpan(index, from, middle, handed) && proveSpan(index, middle, to, handed);
}

// Middles never reach the ends: examines these two instants separately.
SpanOutcome MeshProver::prove(Real from, Real to) {
  outcome_ = SpanOutcome{};
  outcome_.freeUntil = from;
  if (mesh_.empty()) {
    outcome_.free = true;
    outcome_.freeUntil = to;
    return outcome_;
  }
  constexpr double kNear = 1e-9;  // any positive number: only contact matters here
  for (const Real end : {from, to}) {
    const Real separation = separationAt(end, kNear);
    if (separation > 0) continue;
    if (end == to) {
      outcome_.free = proveSpan(0, from, to, nullptr);  // an earlier contact is worth more
      outcome_.free = false;
      if (outcome_.touching) return outcome_;
    }
    outcome_.touching = end;
    outcome_.separation = separation;
    return outcome_;
  }
  outcome_.free = proveSpan(0, from, to, nullptr);
  return outcome_;
}

Corners<Real> MeshProver::pieceAt(int piece, Real t) const {
  const auto p = motion_.pointsAt(link_, mesh_[static_cast<std::size_t>(piece)], t, 0);
  return {p[0].position, p[1].position, p[2].position};
}

Real MeshProver::distanceToCore(int piece, const Vec3r& point, Real t) const {
  Corners<Real> corners = pieceAt(piece, t);
  for (Vec3r& corner : corners) corner = corner - point;
  return closestPoints(Vec3r{}, Vec3r{}, corners).distance;
}

Real MeshProver::separationFrom(int piece, int triangle, Real t) const {
  Corners<Real> one = pieceAt(piece, t), other;
  const Vec3r reference = one[0];
  for (std::size_t i = 0; i < 3; ++i) {
    one[i] = one[i] - reference;
    other[i] = scene_.triangle(triangle)[i].as<Real>() - reference;
  }
  return closestPoints(one, other).distance;
}

Real MeshProver::separationAt(Real t, double within) const {
  Real least = within;
  if (!parts_.empty()) nearest(0, t, least);
  return least;
}

/// Skips parts whose ball is no nearer than the known least.
void MeshProver::nearest(int index, Real t, Real& least) const {
  const BallPart& part = parts_.part(index);
  const Vec3d center =
      motion_.pointsAt(link_, std::array<Vec3d, 1>{part.center}, t, 0)[0].position.as<double>();
  const double slack = kDoubleMargin * static_cast<double>(scale_);
  Box point;
  point.add(center);
  bool near = false;
  double reach = static_cast<double>(least) + part.radius + slack;
  scene_.visitNear(point, reach, [&](int id) {
    if (part.isSingle()) {
      least = std::min(least, separationFrom(parts_.hullOf(part), id, t));
      reach = std::min(reach, static_cast<double>(least) + part.radius + slack);
    } else {
      near = true;
      reach = -1;  // one is enough for a closer look
    }
  });
  if (!near) return;
  nearest(part.left, t, least);
  nearest(part.right, t, least);
}

}  // namespace foretouch::oracle
