#include "bench/extremes/oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace foretouch::tools::extremes {
namespace {

constexpr long double kGuard = 256.0L;
/// From this depth of halving on, fifty digits are asked whatever long double says.
constexpr int kPatience = 20;
/// Spans are not halved more often than this.
constexpr int kMostHalvings = 220;
constexpr std::int64_t kMostQuick = 4'000'000, kMostPrecise = 60'000;
/// Fifty digits of the extents, less what the formulas lose.
const Precise kTouching("1e-40");
constexpr double kNoHull = 1e300;

template <typename Real>
Real rho(const Vector<Real>& p) {
  return norm(p) * (Real(1) + Real(1e-12));
}

template <typename Real>
Corners<Real> pointsOf(const OracleHull& hull) {
  const std::array<double, 3> zero{};
  return {relative<Real>(hull.points[0], zero), relative<Real>(hull.points[1], zero),
          relative<Real>(hull.points[2], zero)};
}

/// A hull where its link is at one instant.
template <typename Real>
struct Placed {
  Corners<Real> at, velocity;
};
template <typename Real>
Placed<Real> placed(const OracleHull& hull, const typename PreciseMotion<Real>::Frame& frame) {
  const Corners<Real> p_L = pointsOf<Real>(hull);
  Placed<Real> result;
  for (std::size_t i = 0; i < static_cast<std::size_t>(hull.count); ++i) {
    result.at[i] = frame.at(p_L[i]);
    result.velocity[i] = frame.velocityAt(result.at[i]);
  }
  return result;
}

template <typename Real>
struct SpanTest {
  Real separation;  // at the middle
  Real gap;         // of the plane there: the same, but for rounding
  Real least;       // over the span; not below it but for rounding
};

/// The header's inequality on the span of half length `half` around the instant of `now`.
template <typename Real>
SpanTest<Real> testSpan(const OracleHull& hull, const Placed<Real>& now,
                        const typename PreciseMotion<Real>::Bounds& bounds,
                        const Corners<Real>& triangle, const Real& half) {
  using std::abs;
  using std::max;
  using std::min;
  using std::sqrt;
  const Nearest<Real> nearest = nearestPoints(now.at, hull.count, triangle);
  const Real distance = sqrt(nearest.square), radius = Real(hull.radius);
  SpanTest<Real> test{distance - radius, Real(-1), Real(-1)};
  if (!(distance > 0)) return test;
  const Vector<Real> n = Real(1 / distance) * (nearest.onOne - nearest.onOther);
  const Real top =
      max(dot(n, triangle[0] - nearest.onOther),
          max(dot(n, triangle[1] - nearest.onOther), dot(n, triangle[2] - nearest.onOther)));
  const Corners<Real> p_L = pointsOf<Real>(hull);
  bool isFirst = true;
  for (std::size_t i = 0; i < static_cast<std::size_t>(hull.count); ++i) {
    const Real gap = dot(n, now.at[i] - nearest.onOther) - top - radius;
    const Real least = gap - half * abs(dot(n, now.velocity[i])) -
                       half * half / 2 * bounds.accelerationAt(rho(p_L[i]));
    test.least = isFirst ? least : min(test.least, least);
    test.gap = isFirst ? gap : min(test.gap, gap);
    isFirst = false;
  }
  return test;
}

double largest(const std::array<double, 3>& p) {
  return std::max(std::abs(p[0]), std::max(std::abs(p[1]), std::abs(p[2])));
}

}  // namespace

bool isAfterFall(double t, double high, double low, double radius) {
  // Doubles are multiples of 2^-1074 below 2^1024; products of two fit into twice that.
  using Exact = boost::multiprecision::number<
      boost::multiprecision::cpp_bin_float<4300, boost::multiprecision::digit_base_2>,
      boost::multiprecision::et_off>;
  return Exact(t) * (Exact(high) - Exact(low)) > Exact(high) - Exact(radius);
}

Oracle::Oracle(OracleWorld world) : world_(std::move(world)) {
  if (!world_.triangles.empty()) origin_ = world_.triangles.front()[0];
  quick_ = PreciseMotion<Quick>(world_.joints, origin_);
  precise_ = PreciseMotion<Precise>(world_.joints, origin_);
  double scene = kLeastExtent;
  long double sceneFromOrigin = 0.0L;
  for (const OracleTriangle& triangle : world_.triangles) {
    Corners<Quick> quick;
    Corners<Precise> precise;
    for (std::size_t i = 0; i < 3; ++i) {
      quick[i] = relative<Quick>(triangle[i], origin_);
      precise[i] = relative<Precise>(triangle[i], origin_);
      scene = std::max(scene, largest(triangle[i]));
      sceneFromOrigin = std::max(sceneFromOrigin, norm(quick[i]));
    }
    quickTriangles_.push_back(quick);
    preciseTriangles_.push_back(precise);
  }
  const PreciseMotion<Quick> fromWorld(world_.joints, {});
  extents_.assign(world_.joints.size(), scene);
  for (const OracleHull& hull : world_.hulls) {
    const auto link = static_cast<std::size_t>(hull.link);
    const auto &local = quick_.bounds(link), &global = fromWorld.bounds(link);
    long double out = 0.0L;
    for (const Vector<Quick>& p : pointsOf<Quick>(hull)) out = std::max(out, rho(p));
    const auto radius = static_cast<long double>(hull.radius);
    extents_[link] =
        std::max(extents_[link],
                 scene + static_cast<double>(global.reach + out + radius + global.speedAt(out)));
    guards_.push_back(kGuard * (local.depth + 4) * std::numeric_limits<Quick>::epsilon() *
                      (local.reach + out + radius + sceneFromOrigin));
  }
}

Precise Oracle::separationAt(int link, double t) const {
  std::vector<PreciseMotion<Quick>::Frame> quickFrames;
  quick_.framesAt(static_cast<Quick>(t), quickFrames);
  struct Near {
    std::size_t hull, triangle;
    long double separation;
  };
  std::vector<Near> all;
  long double least = std::numeric_limits<long double>::infinity();
  for (std::size_t h = 0; h < world_.hulls.size(); ++h) {
    const OracleHull& hull = world_.hulls[h];
    if (hull.link != link) continue;
    const Placed<Quick> now = placed<Quick>(hull, quickFrames[static_cast<std::size_t>(hull.link)]);
    for (std::size_t k = 0; k < quickTriangles_.size(); ++k) {
      const long double square = nearestPoints(now.at, hull.count, quickTriangles_[k]).square;
      all.push_back({h, k, std::sqrt(square) - static_cast<long double>(hull.radius)});
      least = std::min(least, all.back().separation + guards_[h]);
    }
  }
  Precise separation = kNoHull;
  if (all.empty()) return separation;
  std::vector<PreciseMotion<Precise>::Frame> frames;
  precise_.framesAt(Precise(t), frames);
  // Thin triangles cost long double digits that the guard does not know of.
  const long double reach = least + 1e-9L * static_cast<long double>(extent(link));
  for (const Near& near : all) {
    const OracleHull& hull = world_.hulls[near.hull];
    if (near.separation > reach + guards_[near.hull]) continue;
    const Placed<Precise> now = placed<Precise>(hull, frames[static_cast<std::size_t>(hull.link)]);
    const Precise square =
        nearestPoints(now.at, hull.count, preciseTriangles_[near.triangle]).square;
    const Precise own = sqrt(square) - Precise(hull.radius);
    if (own < separation) separation = own;
  }
  return separation;
}

/// The subdivision of [0,1], all links at once: they share the frames.
class Prover {
 public:
  Prover(const Oracle& oracle, const std::vector<double>& until) : oracle_(oracle), until_(until) {
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
  using Quick = Oracle::Quick;

  /// Of a claim up to the step's end, whose last instant counts too.
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

  /// Nothing is left to ask of the link from `begin` on.
  [[nodiscard]] bool isSettled(std::size_t link, Quick begin) const {
    return static_cast<Quick>(until_[link]) <= begin ||
           (proofs_[link].freedom == Freedom::Touches &&
            static_cast<Quick>(proofs_[link].touchesAt) <= begin);
  }

  void prove(Quick begin, Quick end, const std::vector<Pair>& pairs, int halvings) {
    const Quick middle = (begin + end) / 2, half = (end - begin) / 2;
    std::vector<Pair> open;
    bool hasFrames = false, hasPreciseFrames = false;
    for (const Pair& pair : pairs) {
      const OracleHull& hull = oracle_.world_.hulls[pair.hull];
      const auto link = static_cast<std::size_t>(hull.link);
      if (isSettled(link, begin)) continue;
      if (!hasFrames) oracle_.quick_.framesAt(middle, frames_);
      hasFrames = true;
      ++quick_;
      const SpanTest<Quick> test =
          testSpan<Quick>(hull, placed<Quick>(hull, frames_[link]), oracle_.quick_.bounds(link),
                          oracle_.quickTriangles_[pair.triangle], half);
      const long double guard = oracle_.guards_[pair.hull];
      const bool isInside = middle < static_cast<Quick>(until_[link]);
      if (isInside) note(link, static_cast<double>(test.separation));
      if (test.least > guard) continue;
      // Next to triangles much larger than the gap the direction is lost in long double.
      const bool isNoisy = test.gap < 0.5L * test.separation;
      const bool isHard = isNoisy || test.separation <= 4.0L * guard || halvings >= kPatience;
      if (isHard && precisely_ < kMostPrecise) {
        if (!hasPreciseFrames) oracle_.precise_.framesAt(Precise(middle), preciseFrames_);
        hasPreciseFrames = true;
        if (isProvenPrecisely(pair, middle, half)) continue;
      }
      open.push_back(pair);
    }
    if (open.empty()) return;
    if (halvings >= kMostHalvings || quick_ > kMostQuick || precisely_ >= kMostPrecise) {
      return leaveOpen(open);
    }
    prove(begin, middle, open, halvings + 1);
    prove(middle, end, open, halvings + 1);
  }

  bool isProvenPrecisely(const Pair& pair, Quick middle, Quick half) {
    const OracleHull& hull = oracle_.world_.hulls[pair.hull];
    const auto link = static_cast<std::size_t>(hull.link);
    ++precisely_;
    const SpanTest<Precise> test = testSpan<Precise>(
        hull, placed<Precise>(hull, preciseFrames_[link]), oracle_.precise_.bounds(link),
        oracle_.preciseTriangles_[pair.triangle], Precise(half));
    const Precise touching = kTouching * Precise(oracle_.extent(hull.link));
    const bool isInside = middle < static_cast<Quick>(until_[link]);
    if (test.separation <= touching && isInside) touch(link, static_cast<double>(middle));
    return test.least > touching;
  }

  void leaveOpen(const std::vector<Pair>& pairs) {
    for (const Pair& pair : pairs) {
      FreedomProof& proof = proofs_[static_cast<std::size_t>(oracle_.world_.hulls[pair.hull].link)];
      if (proof.freedom == Freedom::Proven) proof.freedom = Freedom::Open;
    }
  }

  const Oracle& oracle_;
  const std::vector<double>& until_;
  std::vector<FreedomProof> proofs_;
  std::vector<PreciseMotion<Quick>::Frame> frames_;
  std::vector<PreciseMotion<Precise>::Frame> preciseFrames_;
  std::int64_t quick_ = 0, precisely_ = 0;
};

std::vector<FreedomProof> Oracle::proveFree(const std::vector<double>& until) const {
  return Prover(*this, until).run();
}

}  // namespace foretouch::tools::extremes
