#include "verify/proof.h"

#include <algorithm>
#include <set>

namespace verify {
namespace {

bool isNot(double least, double most) {
  return !(least <= most);  // true where either is no number
}

/// Where in [0, 1] a span begins, in units of 2^-kDeepestLevel.
std::int64_t beginOf(const Span& span) {
  return span.index << (kDeepestLevel - span.level);
}
std::int64_t endOf(const Span& span) {
  return (span.index + 1) << (kDeepestLevel - span.level);
}

}  // namespace

SceneProof::SceneProof(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  for (const Triangle& triangle : triangles_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& [a, b, c] = triangle.corners;
      least_[axis].push_back(std::min({a[axis].lo, b[axis].lo, c[axis].lo}));
      most_[axis].push_back(std::max({a[axis].hi, b[axis].hi, c[axis].hi}));
    }
  }
}

SceneProof::Hull SceneProof::hullOf(const Capsule& capsule, std::size_t link, const Span& span,
                                    Motion& motion) {
  Hull hull;
  const Vector a = exactly(capsule.a), b = exactly(capsule.b);
  for (const std::int64_t index : {span.index, span.index + 1}) {
    const LinkPlace& place = motion.at(span.level, index, link);
    hull.corners.push_back(place.origin + place.rotation * a);
    hull.corners.push_back(place.origin + place.rotation * b);
  }
  const double far = std::max(length(a).hi, length(b).hi);
  const Interval width(std::ldexp(1.0, -span.level));
  const Interval stray = Interval(motion.acceleration(link, far)) * square(width) * Interval(0.125);
  hull.reach = up(capsule.radius + stray.hi);
  return hull;
}

/// Every point of the hull is surely beyond the plane's offset.
bool SceneProof::isInFront(const Hull& hull, const Plane& plane) {
  const Vector normal = exactly(plane.normal);
  const Interval lead = Interval(plane.offset) + length(normal) * Interval(hull.reach);
  return std::all_of(hull.corners.begin(), hull.corners.end(),
                     [&](const Vector& corner) { return dot(normal, corner).lo > lead.hi; });
}

bool SceneProof::isBehind(const Triangle& triangle, const Plane& plane) {
  const Vector normal = exactly(plane.normal);
  return std::all_of(triangle.corners.begin(), triangle.corners.end(),
                     [&](const Vector& corner) { return dot(normal, corner).hi <= plane.offset; });
}

/// Empty where it is proven.
std::string SceneProof::proveSpan(const Hull& hull, const Span& span, Tally& tally) const {
  for (const Plane& plane : span.planes) {
    if (!isInFront(hull, plane)) return "a plane that the LSS is not surely in front of";
  }
  std::array<double, 3> least{}, most{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    least[axis] = hull.corners[0][axis].lo;
    most[axis] = hull.corners[0][axis].hi;
    for (const Vector& corner : hull.corners) {
      if (isNot(corner[axis].lo, corner[axis].hi)) return "a place that is not known";
      least[axis] = std::min(least[axis], corner[axis].lo);
      most[axis] = std::max(most[axis], corner[axis].hi);
    }
    least[axis] = down(least[axis] - hull.reach);
    most[axis] = up(most[axis] + hull.reach);
    if (isNot(least[axis], most[axis])) return "a place that is not known";
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const bool isApart = most_[0][i] < least[0] || least_[0][i] > most[0] ||
                         most_[1][i] < least[1] || least_[1][i] > most[1] ||
                         most_[2][i] < least[2] || least_[2][i] > most[2];
    if (isApart) {
      ++tally.byBoxes;
      continue;
    }
    const bool isHeld =
        std::any_of(span.planes.begin(), span.planes.end(),
                    [&](const Plane& plane) { return isBehind(triangles_[i], plane); });
    if (!isHeld) return "triangle " + std::to_string(i) + " is behind none of its planes";
    ++tally.byPlanes;
  }
  return "";
}

Fault SceneProof::prove(const std::vector<Link>& links, const StepClaim& claim, Motion& motion,
                        Tally& tally) const {
  if (!motion.fault().empty()) return {claim.line, motion.fault()};
  ++tally.steps;
  for (const LinkClaim& link : claim.links) {
    if (link.link >= links.size()) return {link.line, "the avatar has no such link"};
    const std::vector<Capsule>& capsules = links[link.link].capsules;
    std::set<std::size_t> proven;
    for (const CapsuleClaim& capsule : link.capsules) {
      if (capsule.capsule >= capsules.size()) return {capsule.line, "the link has no such LSS"};
      std::int64_t reached = 0;
      for (const Span& span : capsule.spans) {
        if (beginOf(span) != reached) return {span.line, "it does not begin where the last ended"};
        reached = endOf(span);
        const Hull hull = hullOf(capsules[capsule.capsule], link.link, span, motion);
        std::string why = proveSpan(hull, span, tally);
        if (!why.empty()) return {span.line, std::move(why)};
        ++tally.spans;
        tally.planes += static_cast<std::int64_t>(span.planes.size());
      }
      if (reached != std::int64_t{1} << kDeepestLevel) {
        return {capsule.line, "its spans end before t = 1"};
      }
      proven.insert(capsule.capsule);
      ++tally.capsules;
    }
    if (proven.size() != capsules.size()) {
      return {link.line, "of the link's " + std::to_string(capsules.size()) + " LSS only " +
                             std::to_string(proven.size()) + " have spans"};
    }
    ++tally.links;
  }
  return {};
}

}  // namespace verify
