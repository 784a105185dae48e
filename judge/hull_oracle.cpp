// judge/hull_oracle.cpp: halves spans, in long double if that is enough, else in fifty digits.
#include "judge/hull_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "judge/distance.h"
#include "judge/plain_distance.h"

namespace foretouch::oracle {
namespace {

constexpr Real kGuard = 256.0L;
/// From this depth of halving on, uses fifty digits whatever long double says.
constexpr int kPatience = 20;
/// Halves spans no more often than this.
constexpr int kMostHalvings = 220;
constexpr std::int64_t kMostQuick = 4'000'000, kMostPrecise = 60'000;
/// Fifty digits of the extents, less the formulas' rounding.
const Precise kTouching("1e-40");
constexpr double kNoHull = 1e300;

template <typename S>
S rho(const Vec3<S>& p) {
  return norm(p) * (S(1) + S(1e-12));
}

/// A hull at one instant.
template <typename S>
struct Placed {
  Corners<S> at, velocity;
};
template <typename S>
Placed<S> placed(const Hull& hull, const MovingFrame<S>& frame) {
  const Corners<S> p_L = cornersOf<S>(hull.points);
  Placed<S> result;
  for (std::size_t i = 0; i < static_cast<std::size_t>(hull.count); ++i) {
    result.at[i] = frame.at(p_L[i]);
    result.velocity[i] = frame.velocityAt(result.at[i]);
  }
  return result;
}

Closest<Real> closest(const Hull& hull, const Corners<Real>& at, const Corners<Real>& triangle) {
  return hull.count == 3 ? closestPoints(at, triangle) : closestPoints(at[0], at[1], triangle);
}
Closest<Precise> closest(const Hull& hull, const Corners<Precise>& at,
                         const Corners<Precise>& triangle) {
  const Nearest<Precise> nearest = nearestPoints(at, hull.count, triangle);
  return {sqrt(nearest.square), nearest.onOne, nearest.onOther};
}

template <typename S>
struct SpanTest {
  S separation;  // at the middle
  S gap;         // that of the plane there: the same, but for rounding
  S least;       // over the span; not below it but for rounding
};

/// The header's inequality on the span of half length `half` around the instant of `now`.
template <typename S>
SpanTest<S> testSpan(const Hull& hull, const Placed<S>& now, const MotionBounds<S>& bounds,
                     const Corners<S>& triangle, const S& half) {
  using std::abs;
  using std::max;
  using std::min;
  const Closest<S> nearest = closest(hull, now.at, triangle);
  const S radius = S(hull.radius);
  SpanTest<S> test{nearest.distance - radius, S(-1), S(-1)};
  if (!(nearest.distance > 0)) return test;
  const Vec3<S> n = (1 / nearest.distance) * (nearest.onSegment - nearest.onTriangle);
  S top = dot(n, triangle[0] - nearest.onTriangle);
  for (const Vec3<S>& corner : triangle) top = max(top, dot(n, corner - nearest.onTriangle));
  const Corners<S> p_L = cornersOf<S>(hull.points);
  bool isFirst = true;
  for (std::size_t i = 0; i < static_cast<std::size_t>(hull.count); ++i) {
    const S gap = dot(n, now.at[i] - nearest.onTriangle) - top - radius;
    const S least = gap - half * abs(dot(n, now.velocity[i])) -
                    half * half / 2 * bounds.accelerationAt(rho(p_L[i]));
    test.least = isFirst ? least : min(test.least, least);
    test.gap = isFirst ? gap : min(test.gap, gap);
    isFirst = false;
  }
  return test;
}

}  // namespace

bool isAfterFall(double t, double high, double low, double radius) {
  return Exact(t) * (Exact(high) - Exact(low)) > Exact(high) - Exact(radius);
}

HullOracle::HullOracle(HullWorld world) : world_(std::move(world)) {
  if (!world_.triangles.empty()) origin_ = world_.triangles.front()[0];
  quick_ = Motion(world_.joints, origin_);
  precise_ = MotionOf<Precise>(world_.joints, origin_);
  double scene = kLeastExtent;
  Real sceneFromOrigin = 0;
  for (const Triangle& triangle : world_.triangles) {
    quickTriangles_.push_back(cornersOf<Real>(triangle, origin_));
    preciseTriangles_.push_back(cornersOf<Precise>(triangle, origin_));
    for (const Vec3d& corner : triangle) scene = std::max(scene, oracle::extent(corner));
    for (const Vec3r& corner : quickTriangles_.back()) {
      sceneFromOrigin = std::max(sceneFromOrigin, norm(corner));
    }
  }
  const Motion fromWorld(world_.joints);
  extents_.assign(world_.joints.size(), scene);
  for (const Hull& hull : world_.hulls) guard(hull, fromWorld, scene, sceneFromOrigin);
}

void HullOracle::guard(const Hull& hull, const Motion& fromWorld, double scene,
                       Real sceneFromOrigin) {
  const auto &local = quick_.bounds(hull.link), &global = fromWorld.bounds(hull.link);
  Real out = 0;
  for (const Vec3r& p : cornersOf<Real>(hull.points)) out = std::max(out, rho(p));
  const auto radius = static_cast<Real>(hull.radius);
  double& extent = extents_[static_cast<std::size_t>(hull.link)];
  extent = std::max(extent,
                    scene + static_cast<double>(global.reach + out + radius + global.speedAt(out)));
  guards_.push_back(kGuard * static_cast<Real>(local.depth + 4) *
                    std::numeric_limits<Real>::epsilon() *
                    (local.reach + out + radius + sceneFromOrigin));
}

Precise HullOracle::separationAt(int link, double t) const {
  std::vector<MovingFrame<Real>> quickFrames;
  quick_.framesAt(static_cast<Real>(t), quickFrames);
  struct Near {
    std::size_t hull, triangle;
    Real separation;
  };
  std::vector<Near> all;
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t h = 0; h < world_.hulls.size(); ++h) {
    const Hull& hull = world_.hulls[h];
    if (hull.link != link) continue;
    const auto now = placed(hull, quickFrames[static_cast<std::size_t>(hull.link)]);
    for (std::size_t k = 0; k < quickTriangles_.size(); ++k) {
      const Real distance = closest(hull, now.at, quickTriangles_[k]).distance;
      all.push_back({h, k, distance - static_cast<Real>(hull.radius)});
      least = std::min(least, all.back().separation + guards_[h]);
    }
  }
  Precise separation = kNoHull;
  if (all.empty()) return separation;
  std::vector<MovingFrame<Precise>> frames;
  precise_.framesAt(t, frames);
  // Generous: long double may lose digits that the guard does not include.
  const Real reach = least + 1e-9L * static_cast<Real>(extent(link));
  for (const Near& near : all) {
    const Hull& hull = world_.hulls[near.hull];
    if (near.separation > reach + guards_[near.hull]) continue;
    const auto now = placed(hull, frames[static_cast<std::size_t>(hull.link)]);
    const Precise distance = closest(hull, now.at, preciseTriangles_[near.triangle]).distance;
    separation = std::min(separation, Precise(distance - hull.radius));
  }
  return separation;
}

/// The subdivision of [0,1], all links at once: they share the frames.
class HullProver {
 public:
  HullProver(const HullOracle& oracle, const std::vector<double>& until)
      : oracle_(oracle), until_(until) {
    proofs_.resize(until.size());
    for (FreedomProof& proof : proofs_) proof.least = std::numeric_limits<double>::infinity();
  }

  std::vector<FreedomProof> run() {
    std::vector<Pair> pairs;
    for (std::size_t link = 0; link < until_.size(); ++link) lookAtEnd(static_cast<int>(link));
    for (std::size_t h = 0; h < oracle_.world_.hulls.size(); ++h) {
      for (std::size_t k = 0; k < oracle_.world_.triangles.size(); ++k) pairs.push_back({h, k});
    }
    prove(0.0L, 1.0L, pairs, 0);
    return std::move(proofs_);
  }

 private:
  struct Pair {
    std::size_t hull, triangle;
  };
  /// For a claim up to the step's end, whose last instant counts too.
  void lookAtEnd(int link) {
    const auto i = static_cast<std::size_t>(link);
    if (until_[i] < 1.0) return;
    const Precise separation = oracle_.separationAt(link, 1.0);
    note(i, static_cast<double>(separation));
    if (separation <= kTouching * Precise(oracle_.extent(link))) touch(i, 1.0);
  }

  void note(std::size_t link, double separation) {
    proofs_[link].least = std::min(proofs_[link].least, separation);
  }
  void touch(std::size_t link, double t) {
    FreedomProof& proof = proofs_[link];
    if (proof.freedom == Freedom::Touches && proof.touchesAt <= t) return;
    proof.freedom = Freedom::Touches;
    proof.touchesAt = t;
  }

  /// No open question about the link from `begin` on.
  [[nodiscard]] bool isSettled(std::size_t link, Real begin) const {
    return static_cast<Real>(until_[link]) <= begin ||
           (proofs_[link].freedom == Freedom::Touches &&
            static_cast<Real>(proofs_[link].touchesAt) <= begin);
  }

  void prove(Real begin, Real end, const std::vector<Pair>& pairs, int halvings) {
    const Real middle = (begin + end) / 2, half = (end - begin) / 2;
    std::vector<Pair> open;
    hasFrames_ = hasPreciseFrames_ = false;
    for (const Pair& pair : pairs) {
      const auto link = static_cast<std::size_t>(oracle_.world_.hulls[pair.hull].link);
      if (isSettled(link, begin) || isProven(pair, middle, half, halvings)) continue;
      open.push_back(pair);
    }
    if (open.empty()) return;
    if (halvings >= kMostHalvings || quick_ > kMostQuick || precisely_ >= kMostPrecise) {
      return leaveOpen(open);
    }
    prove(begin, middle, open, halvings + 1);
    prove(middle, end, open, halvings + 1);
  }

  bool isProven(const Pair& pair, Real middle, Real half, int halvings) {
    const Hull& hull = oracle_.world_.hulls[pair.hull];
    const auto link = static_cast<std::size_t>(hull.link);
    if (!hasFrames_) oracle_.quick_.framesAt(middle, frames_);
    hasFrames_ = true;
    ++quick_;
    const SpanTest<Real> test =
        testSpan(hull, placed(hull, frames_[link]), oracle_.quick_.bounds(hull.link),
                 oracle_.quickTriangles_[pair.triangle], half);
    const Real guard = oracle_.guards_[pair.hull];
    if (middle < static_cast<Real>(until_[link])) note(link, static_cast<double>(test.separation));
    if (test.least > guard) return true;
    // Next to triangles much larger than the gap the direction is lost in long double.
    const bool isNoisy = test.gap < 0.5L * test.separation;
    const bool isHard = isNoisy || test.separation <= 4.0L * guard || halvings >= kPatience;
    return isHard && precisely_ < kMostPrecise && isProvenPrecisely(pair, middle, half);
  }

  bool isProvenPrecisely(const Pair& pair, Real middle, Real half) {
    const Hull& hull = oracle_.world_.hulls[pair.hull];
    const auto link = static_cast<std::size_t>(hull.link);
    if (!hasPreciseFrames_) oracle_.precise_.framesAt(middle, preciseFrames_);
    hasPreciseFrames_ = true;
    ++precisely_;
    const SpanTest<Precise> test = testSpan<Precise>(
        hull, placed(hull, preciseFrames_[link]), oracle_.precise_.bounds(hull.link),
        oracle_.preciseTriangles_[pair.triangle], Precise(half));
    const Precise touching = kTouching * Precise(oracle_.extent(hull.link));
    const bool isInside = middle < static_cast<Real>(until_[link]);
    if (test.separation <= touching && isInside) touch(link, static_cast<double>(middle));
    return test.least > touching;
  }

  void leaveOpen(const std::vector<Pair>& pairs) {
    for (const Pair& pair : pairs) {
      FreedomProof& proof = proofs_[static_cast<std::size_t>(oracle_.world_.hulls[pair.hull].link)];
      if (proof.freedom == Freedom::Proven) proof.freedom = Freedom::Open;
    }
  }

  const HullOracle& oracle_;
  const std::vector<double>& until_;
  std::vector<FreedomProof> proofs_;
  std::vector<MovingFrame<Real>> frames_;
  std::vector<MovingFrame<Precise>> preciseFrames_;
  bool hasFrames_ = false, hasPreciseFrames_ = false;  // of the current span
  std::int64_t quick_ = 0, precisely_ = 0;
};

std::vector<FreedomProof> HullOracle::proveFree(const std::vector<double>& until) const {
  return HullProver(*this, until).run();
}

}  // namespace foretouch::oracle
