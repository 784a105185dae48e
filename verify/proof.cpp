#include "verify/proof.h"

#include <algorithm>
#include <set>

namespace verify {
namespace {

bool isNot(double least, double most) {
  return !(least <= most);  // true where either is not a number
}

}  // namespace

Hull Hull::of(const Capsule& capsule, const LinkPlace& begin, const LinkPlace& end,
              const Motion::Bound& bound, int level, double more) {
  Hull hull;
  const Vector a = exactly(capsule.a), b = exactly(capsule.b);
  for (const LinkPlace* const place : {&begin, &end}) {
    hull.corners.push_back(place->origin + place->rotation * a);
    hull.corners.push_back(place->origin + place->rotation * b);
  }
  const double far = std::max(length(a).hi, length(b).hi);
  const Interval width(std::ldexp(1.0, -level));
  const Interval stray = Interval(bound.at(far)) * square(width) * Interval(0.125);
  hull.reach = up(up(capsule.radius + stray.hi) + more);
  hull.isKnown = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hull.least[axis] = hull.corners[0][axis].lo;
    hull.most[axis] = hull.corners[0][axis].hi;
    for (const Vector& corner : hull.corners) {
      if (isNot(corner[axis].lo, corner[axis].hi)) hull.isKnown = false;
      hull.least[axis] = std::min(hull.least[axis], corner[axis].lo);
      hull.most[axis] = std::max(hull.most[axis], corner[axis].hi);
    }
    hull.least[axis] = down(hull.least[axis] - hull.reach);
    hull.most[axis] = up(hull.most[axis] + hull.reach);
    if (isNot(hull.least[axis], hull.most[axis])) hull.isKnown = false;
  }
  return hull;
}

bool Hull::isInFrontOf(const Plane& plane) const {
  const Vector normal = exactly(plane.normal);
  const Interval lead = Interval(plane.offset) + length(normal) * Interval(reach);
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vector& corner) { return dot(normal, corner).lo > lead.hi; });
}

bool Hull::isBehind(const Plane& plane) const {
  const Vector normal = exactly(plane.normal);
  const Interval lead = Interval(plane.offset) - length(normal) * Interval(reach);
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vector& corner) { return dot(normal, corner).hi <= lead.lo; });
}

SceneProof::SceneProof(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  for (const Triangle& triangle : triangles_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& [a, b, c] = triangle.corners;
      least_[axis].push_back(std::min({a[axis].lo, b[axis].lo, c[axis].lo}));
      most_[axis].push_back(std::max({a[axis].hi, b[axis].hi, c[axis].hi}));
    }
  }
}

bool SceneProof::isBehind(const Triangle& triangle, const Plane& plane) {
  const Vector normal = exactly(plane.normal);
  return std::all_of(triangle.corners.begin(), triangle.corners.end(),
                     [&](const Vector& corner) { return dot(normal, corner).hi <= plane.offset; });
}

/// Empty where it is proven.
std::string SceneProof::proveSpan(const Hull& hull, const Span& span,
                                  const std::vector<Ignored>& ignored, Tally& tally) const {
  for (const Plane& plane : span.planes) {
    if (!hull.isInFrontOf(plane)) return "a plane that the LSS is not surely in front of";
  }
  if (!hull.isKnown) return "a place that is not known";
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const bool isApart = most_[0][i] < hull.least[0] || least_[0][i] > hull.most[0] ||
                         most_[1][i] < hull.least[1] || least_[1][i] > hull.most[1] ||
                         most_[2][i] < hull.least[2] || least_[2][i] > hull.most[2];
    if (isApart) {
      ++tally.byBoxes;
      continue;
    }
    const bool isHeld =
        std::any_of(span.planes.begin(), span.planes.end(),
                    [&](const Plane& plane) { return isBehind(triangles_[i], plane); });
    if (isHeld) {
      ++tally.byPlanes;
    } else if (!isIgnored(ignored, i)) {
      return "triangle " + std::to_string(i) + " is behind none of its planes";
    }
  }
  return "";
}

Fault SceneProof::prove(const std::vector<Link>& links, const LinkClaim& claim, Motion& motion,
                        double clearance, const std::vector<Ignored>& ignored, Tally& tally) const {
  if (claim.link >= links.size()) return {claim.line, "the avatar has no such link"};
  const std::vector<Capsule>& capsules = links[claim.link].capsules;
  const Motion::Bound bound = motion.boundOf(claim.link);
  std::set<std::size_t> proven;
  for (const CapsuleClaim& capsule : claim.capsules) {
    if (capsule.capsule >= capsules.size()) return {capsule.line, "the link has no such LSS"};
    const auto why = [&](const Span& span) {
      const LinkPlace begin = motion.at(span.level, span.index, claim.link);
      const LinkPlace& end = motion.at(span.level, span.index + 1, claim.link);
      const Hull hull =
          Hull::of(capsules[capsule.capsule], begin, end, bound, span.level, clearance);
      std::string what = proveSpan(hull, span, ignored, tally);
      if (!what.empty()) return what;
      ++tally.spans;
      tally.planes += static_cast<std::int64_t>(span.planes.size());
      return what;
    };
    Fault fault = proveSpans(capsule.spans, capsule.line, why);
    if (!fault.what.empty()) return fault;
    proven.insert(capsule.capsule);
    ++tally.capsules;
  }
  if (proven.size() != capsules.size()) {
    return {claim.line, "of the link's " + std::to_string(capsules.size()) + " LSS only " +
                            std::to_string(proven.size()) + " have spans"};
  }
  ++tally.links;
  return {};
}

Fault SceneProof::prove(const std::vector<Link>& links, const StepClaim& claim, Motion& motion,
                        Tally& tally) const {
  if (!motion.fault().empty()) return {claim.line, motion.fault()};
  ++tally.steps;
  for (const LinkClaim& link : claim.links) {
    Fault fault = prove(links, link, motion, 0.0, {}, tally);
    if (!fault.what.empty()) return fault;
  }
  return {};
}

}  // namespace verify
