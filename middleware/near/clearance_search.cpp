#include "middleware/near/clearance_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/scene/eight_boxes.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using Span = ClearanceMemory::Span;
using Curve = ClearanceMemory::Curve;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The share of a tolerance that curves may be off by.
constexpr double kCurveShare = 1.0 / 64.0;
/// A span that is a shorter share of a motion is not halved any more.
constexpr double kShortest = 0x1p-40;
/// What floats of boxes, and of sums of three products, are off by, in parts of all lengths; more
/// than four times as much.
constexpr double kFloatSum = 32.0 * static_cast<double>(kUnitRoundoffOfFloat);
/// For squares of gaps.
constexpr double kFloatSquare = 1.0 + kFloatSum;
/// Beyond all places (m); its square is finite.
constexpr double kFarthest = 1e100;
/// Points of an axis whose distances cells know.
constexpr int kMostPoints = 8;
/// Places that count as one: normals with this cosine, times so near (of the motion).
constexpr double kAloneNormal = 0.999, kAloneTime = 0.02;
/// Halvings that find the time of the least separation of one pair.
constexpr int kSettlings = 12;
/// The share of the tolerance that is left when it ends earlier.
constexpr double kSettled = 1.0 / 256.0;

struct LessNear {
  bool operator()(const Span& x, const Span& y) const {
    if (x.bound != y.bound) return x.bound > y.bound;
    return x.curve != y.curve ? x.curve > y.curve : x.begin > y.begin;
  }
};

Hull hullFrom(const Vector3d& origin, const Triangle& triangle) {
  Hull hull = Hull::of(triangle);
  for (Vector3d& v : hull.points) v -= origin;
  return hull;
}

/// Where distances are expected to be asked about; from the scene's origin.
Eigen::AlignedBox3d boxOfCells(const Scene& scene, double reach) {
  const Vector3d& origin = scene.parts().origin;
  const Eigen::AlignedBox3d all(Vector3d(scene.audit().boxMin - origin),
                                Vector3d(scene.audit().boxMax - origin));
  if (!(reach > 0.0)) return all;
  const Vector3d half = Vector3d::Constant(reach);
  const Eigen::AlignedBox3d within(Vector3d(-half - origin), Vector3d(half - origin));
  const Eigen::AlignedBox3d both = all.intersection(within);
  return both.isEmpty() ? within : both;
}

/// How far, at most, a point of the axis moves within `half` of the instant.
double movesOf(const Curve& curve, const AxisCurve::Ends& ends, double half) {
  const AxisCurve& c = curve.curve;
  const double a = ends.velocityA.norm() + c.velocityRounding + 0.5 * half * c.accelerationA,
               b = ends.velocityB.norm() + c.velocityRounding + 0.5 * half * c.accelerationB;
  return kInflation * half * std::max(a, b);
}

}  // namespace

ClearancePlan::ClearancePlan(const Avatar& whose, const Scene& where, const ClearanceOptions& how)
    : avatar(whose),
      scene(where),
      options(how),
      table(avatar),
      ignored(countOf(avatar.numLinks())),
      extent((where.audit().boxMax - where.parts().origin).lpNorm<1>() +
             (where.audit().boxMin - where.parts().origin).lpNorm<1>()),
      cells(where, boxOfCells(where, how.reach)) {
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    if (ignored[slotOf(link)].collect(options.ignored, link)) continue;
    for (auto lss = table.first(link); lss < table.first(link + 1); ++lss) asked.push_back(lss);
  }
}

/// One LSS at the middle of a span, and how far it comes from there within it.
class ClearanceSearch::Look {
 public:
  Look(ClearanceSearch& search, const Curve& curve, const Span& span)
      : search_(search),
        plan_(*search.motion_.plan),
        scene_(plan_.scene.parts()),
        curve_(curve),
        ignored_(plan_.ignored[slotOf(plan_.table[curve.lss].link)]),
        t_(0.5 * (span.begin + span.end)),
        half_(0.5 * (span.end - span.begin) * kInflation),
        ends_(curve.curve.endsAt(t_)),
        sum_(curve.radius + curve.more),
        bends_{0.5 * curve.curve.accelerationA * half_ * half_,
               0.5 * curve.curve.accelerationB * half_ * half_},
        moves_(movesOf(curve, ends_, half_)) {
    for (int axis = 0; axis < 3; ++axis) {
      box_.lower[axis] = floatBelow(std::min(ends_.a[axis], ends_.b[axis]));
      box_.upper[axis] = floatAbove(std::max(ends_.a[axis], ends_.b[axis]));
    }
  }

  /// Whether nothing comes nearer than the floor in the span; else what may. `near`: what is likely
  /// to, or -1.
  [[nodiscard]] std::optional<TriangleId> nearer(TriangleId near) {
    if (near >= 0 && !keepsAway(near)) return near;
    walkNearestFirst(scene_.bvh, *this);
    return nearer_;
  }

  // What the walk asks: bounds are squares of distances from the axis.
  [[nodiscard]] double limit() const {
    // Boxes that are none are infinitely far.
    const double limit = std::min(search_.floor() + sum_ + moves_, kFarthest);
    return nearer_ || limit < 0.0 ? -1.0 : limit * limit * kFloatSquare;
  }
  void bounds(const BvhNode& node, double (&bounds)[kBvhWidth]) const {
    float squares[kBvhWidth];
    squaredGaps(node.lower, node.upper, box_, squares);
    for (int k = 0; k < numPlanes_; ++k) {
      const Plane& plane = planes_[k];
      const auto far = [&](int axis) {
        return plane.isUp[axis] ? node.upper[axis] : node.lower[axis];
      };
      const float* const corner[1][3] = {{far(0), far(1), far(2)}};
      leaveOutBelow(corner, plane.nhat, cutOf(plane), squares);
    }
    for (int i = 0; i < kBvhWidth; ++i) bounds[i] = static_cast<double>(squares[i]);
  }
  void leaf(const BvhLeaf& leaf) {
    float lower[3][kBvhWidth], upper[3][kBvhWidth], squares[kBvhWidth];
    boxesOf(leaf, lower, upper);
    squaredGaps(lower, upper, box_, squares);
    for (int k = 0; k < numPlanes_; ++k) {
      leaveOutBelow(leaf.vertex, planes_[k].nhat, cutOf(planes_[k]), squares);
    }
    for (int i = 0; i < kBvhWidth && leaf.id[i] >= 0; ++i) {
      // Vertices are rounded to nearest.
      const double gap = std::sqrt(static_cast<double>(squares[i])) - vertexRounding();
      const double most = limit();
      if (nearer_) return;
      if (gap > 0.0 && gap * gap > most) continue;
      if (ignored_.has(plan_.scene, leaf.id[i])) continue;
      if (!keepsAway(leaf.id[i])) nearer_ = leaf.id[i];
    }
  }

 private:
  [[nodiscard]] double vertexRounding() const { return 2.0 * scene_.bvh.vertexRounding(); }

  /// What has no point as high along the normal as its cut is far all through the span.
  struct Plane {
    float nhat[3];
    bool isUp[3];
    double top;  ///< The axis', where it is lowest.
  };

  /// The first plane stays, and the last one of the others.
  void usePlane(const Vector3d& nhat) {
    numPlanes_ = std::min(numPlanes_ + 1, 2);
    Plane& plane = planes_[numPlanes_ - 1];
    for (int axis = 0; axis < 3; ++axis) {
      plane.nhat[axis] = static_cast<float>(nhat[axis]);
      plane.isUp[axis] = plane.nhat[axis] > 0.0F;
    }
    const Vector3d rounded(plane.nhat[0], plane.nhat[1], plane.nhat[2]);
    const std::array<double, 2> losses = lossesAlong(rounded);
    const double extent = plan_.extent + ends_.a.lpNorm<1>() + ends_.b.lpNorm<1>();
    plane.top = std::min(rounded.dot(ends_.a) - losses[0], rounded.dot(ends_.b) - losses[1]) -
                kFloatSum * extent - vertexRounding();
  }
  /// The floats' vector is longer than 1 by a few of their roundings.
  [[nodiscard]] float cutOf(const Plane& plane) const {
    return floatBelow(plane.top - (1.0 + kFloatSum) * (search_.floor() + sum_));
  }

  /// By how much each end comes closer along a unit normal, at most, before or after the middle.
  [[nodiscard]] std::array<double, 2> lossesAlong(const Vector3d& nhat) const {
    const double rounding =
        curve_.curve.velocityRounding +
        kSeparationRounding * (ends_.velocityA.lpNorm<1>() + ends_.velocityB.lpNorm<1>());
    return {kInflation * ((std::abs(nhat.dot(ends_.velocityA)) + rounding) * half_ + bends_[0]),
            kInflation * ((std::abs(nhat.dot(ends_.velocityB)) + rounding) * half_ + bends_[1])};
  }

  /// Whether it stays away all through the span, by a plane between, which leaves out others, too.
  [[nodiscard]] bool keepsAway(TriangleId id) {
    const Separation apart = separation(Hull::segment(ends_.a, ends_.b),
                                        hullFrom(scene_.origin, scene_.triangles[slotOf(id)]));
    search_.take(curve_, t_, apart, id);
    const std::array<double, 2> losses = lossesAlong(apart.nhat);
    const double least = std::min(apart.clearance[0] - losses[0], apart.clearance[1] - losses[1]);
    if (!(least >= search_.floor() + sum_)) return false;
    usePlane(apart.nhat);
    return true;
  }

  ClearanceSearch& search_;
  const ClearancePlan& plan_;
  const SceneParts& scene_;
  const Curve& curve_;
  const IgnoredObjects& ignored_;
  const double t_, half_;
  const AxisCurve::Ends ends_;
  const double sum_;
  const std::array<double, 2> bends_;
  const double moves_;
  LocalBox box_;
  int numPlanes_ = 0;
  Plane planes_[2];
  std::optional<TriangleId> nearer_;
};

ClearanceSearch::ClearanceSearch(const ClearanceOptions& options, ClearanceMemory& memory)
    : tolerance_(options.tolerance), within_(options.within), memory_(memory), lowest_(kInfinity) {
  memory_.places.clear();
}

void ClearanceSearch::look(const ClearanceMotion& motion) {
  motion_ = motion;
  memory_.curves.clear();
  memory_.spans.clear();
  addCurves();
  while (!memory_.spans.empty()) {
    std::pop_heap(memory_.spans.begin(), memory_.spans.end(), LessNear{});
    const Span span = memory_.spans.back();
    memory_.spans.pop_back();
    if (span.bound >= floor() || best_.upper <= 0.0) break;
    lookAt(span);
  }
}

void ClearanceSearch::addCurves() {
  const ClearancePlan& plan = *motion_.plan;
  const ChainMotion& motion = *motion_.motion;
  const Vector3d& origin = plan.scene.parts().origin;
  const int slabs = slabsFor(plan.table, motion, kCurveShare * tolerance_);
  const double ofPlaces = kSeparationRounding * (origin.lpNorm<1>() + plan.extent);
  for (int slab = 0; slab < slabs; ++slab) {
    const double begin = static_cast<double>(slab) / slabs,
                 end = static_cast<double>(slab + 1) / slabs;
    memory_.nodes.evaluate(motion, begin, end, origin);
    for (const std::int32_t lss : plan.asked) {
      const LssTable::Entry& entry = plan.table[lss];
      Curve curve{axisCurve(entry, motion.bounds(entry.link), memory_.nodes, nullptr), lss,
                  entry.radius, 0.0};
      curve.more = kInflation * (2.0 * curve.curve.error + motion_.rounding + ofPlaces);
      memory_.curves.push_back(curve);
      push({0.0, begin, end, static_cast<std::int32_t>(memory_.curves.size() - 1), -1});
    }
  }
}

/// What cells know of it: points along the axis stand for all of it.
void ClearanceSearch::boundByCells(Span& span) const {
  const Curve& curve = memory_.curves[slotOf(span.curve)];
  const ClearancePlan& plan = *motion_.plan;
  const AxisCurve::Ends ends = curve.curve.endsAt(0.5 * (span.begin + span.end));
  const double half = 0.5 * (span.end - span.begin) * kInflation;
  const double length = (ends.b - ends.a).norm();
  const int points =
      1 + static_cast<int>(std::min(length / plan.cells.diagonal(), double{kMostPoints}));
  DistanceCells::Near nearest{kInfinity, -1};
  for (int i = 0; i < points; ++i) {
    const auto near = plan.cells.near(ends.a + (i + 0.5) / points * (ends.b - ends.a));
    if (near.below < nearest.below) nearest = near;
  }
  const double more = 0.5 * length / points + curve.radius + curve.more;
  const double moves = movesOf(curve, ends, half);
  span.bound = std::max(span.bound, nearest.below - kInflation * (moves + more));
  span.ofQuarter = nearest.below - kInflation * (0.25 * moves + more);
  if (span.near < 0 &&
      !plan.ignored[slotOf(plan.table[curve.lss].link)].has(plan.scene, nearest.triangle)) {
    span.near = nearest.triangle;
  }
}

/// Pushes it, unless it is far.
void ClearanceSearch::push(Span span) {
  boundByCells(span);
  if (span.bound >= floor()) return;
  memory_.spans.push_back(span);
  std::push_heap(memory_.spans.begin(), memory_.spans.end(), LessNear{});
}

void ClearanceSearch::lookAt(const Span& span) {
  const Curve& curve = memory_.curves[slotOf(span.curve)];
  // Where cells will do for quarters of it, halves cost less than a look.
  const bool areCellsEnough = span.ofQuarter >= floor();
  const auto nearer = areCellsEnough ? span.near : Look(*this, curve, span).nearer(span.near);
  if (!isSettled_ && best_.upper > 0.0) settle(curve, span);
  if (!nearer) return;
  if (span.end - span.begin < kShortest) {
    lowest_ = std::min(lowest_, span.bound);
    return;
  }
  const double middle = 0.5 * (span.begin + span.end);
  push({span.bound, span.begin, middle, span.curve, *nearer});
  push({span.bound, middle, span.end, span.curve, *nearer});
}

void ClearanceSearch::take(const Curve& curve, double t, const Separation& apart, TriangleId id) {
  const double upper = std::max(0.0, kInflation * (apart.upper + curve.more) - curve.radius);
  if (upper > best_.upper + tolerance_ || upper > within_) return;
  const ClearancePlan& plan = *motion_.plan;
  const double length = apart.difference.norm();
  const Vector3d nhat =
      length > 0.0 ? Vector3d(apart.difference / length) : Vector3d(Vector3d::Zero());
  const LinkId link = plan.table[curve.lss].link;
  const double whole = motion_.begin + motion_.share * t;
  memory_.places.push_back({upper, whole, link, nhat});
  if (upper >= best_.upper) return;
  best_.upper = upper;
  best_.t = whole;
  best_.link = link;
  best_.lss = curve.lss - plan.table.first(link);
  best_.triangle = id;
  const Vector3d& origin = plan.scene.parts().origin;
  best_.p_WScene = apart.onOther + origin;
  best_.p_WLink = apart.onOne - std::min(curve.radius, apart.distance) * nhat + origin;
  best_.nhat_SL_W = nhat;
  prop_ = motion_.prop;
  isSettled_ = false;
}

/// When the nearest pair is nearest, about: the middle of its span is not. At once, as others then
/// need not be looked at.
void ClearanceSearch::settle(const Curve& curve, const Span& span) {
  const SceneParts& scene = motion_.plan->scene.parts();
  const Hull triangle = hullFrom(scene.origin, scene.triangles[slotOf(best_.triangle)]);
  double low = span.begin, high = span.end;
  double t = 0.5 * (low + high), lowRate = 0.0, highRate = 0.0;  // 0: not known
  for (int i = 0; i < kSettlings; ++i) {
    const AxisCurve::Ends ends = curve.curve.endsAt(t);
    const Separation apart = separation(Hull::segment(ends.a, ends.b), triangle);
    take(curve, t, apart, best_.triangle);
    const Vector3d axis = ends.b - ends.a;
    const double square = axis.squaredNorm();
    const double along =
        square > 0.0 ? std::clamp((apart.onOne - ends.a).dot(axis) / square, 0.0, 1.0) : 0.0;
    const double rate =
        apart.difference.dot(ends.velocityA + along * (ends.velocityB - ends.velocityA));
    (rate > 0.0 ? high : low) = t;
    (rate > 0.0 ? highRate : lowRate) = rate;
    if (std::abs(rate) * (high - low) <= kSettled * tolerance_ * apart.distance) break;
    // Where the rate vanishes, if it were linear; halved first, and now and then.
    const bool isKnown = lowRate < 0.0 && highRate > 0.0 && i % 3 != 2;
    t = isKnown ? low + (high - low) * (-lowRate / (highRate - lowRate)) : 0.5 * (low + high);
  }
  isSettled_ = true;
}

Clearance ClearanceSearch::finish() {
  const double proven = std::min(floor(), lowest_);
  Clearance clearance = best_;
  clearance.lower = std::max(0.0, proven);
  clearance.isAlone = clearance.upper > 0.0 && clearance.upper < kInfinity;
  for (const ClearanceMemory::Place& place : memory_.places) {
    if (place.upper > best_.upper + tolerance_) continue;
    const bool isSame = place.link == best_.link &&
                        place.nhat.dot(best_.nhat_SL_W) > kAloneNormal &&
                        std::abs(place.t - best_.t) < kAloneTime;
    clearance.isAlone = clearance.isAlone && isSame;
  }
  return clearance;
}

}  // namespace foretouch::internal
