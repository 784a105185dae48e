#include "middleware/query/contact_details.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/separation.h"
#include "middleware/query/link_parts.h"
#include "middleware/query/query_plan.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::QueryPlan;

/// A point that moves with a link at one instant, and bounds on its motion from then on.
struct MaterialPoint {
  Vector3d velocity = Vector3d::Zero();
  double acceleration = 0.0, velocityRounding = 0.0;
};

MaterialPoint pointOf(const ChainMotion& motion, LinkId link, double t, const Vector3d& p_W) {
  const LinkState state = motion.stateAt(link, t);
  const MotionBounds bounds = motion.bounds(link);
  const double rho = (p_W - state.p_WL).norm() * internal::kInflation + bounds.originRounding;
  return {state.velocityOf(p_W), bounds.accelerationAt(rho), bounds.velocityRoundingAt(rho)};
}

/// Fills the speeds. Along a fixed normal the speed changes by no more than both accelerations; the
/// gap, the contact's separation, is closed by the root of its quadratic if it has one.
void describeApproach(const LinkContact& contact, const MaterialPoint& link,
                      const MaterialPoint& other, ContactDetails& details) {
  details.v_WLink = link.velocity;
  details.v_WOther = other.velocity;
  const double speed = -contact.nhat_SL_W.dot(link.velocity - other.velocity);
  const double acceleration = link.acceleration + other.acceleration;
  double within = 1.0 - contact.toi;
  const double square = speed * speed - 2.0 * acceleration * contact.separation;
  if (speed > 0.0 && square >= 0.0) {
    // The first instant at which the slowest such approach has closed the gap.
    within = std::min(within, 2.0 * contact.separation / (speed + std::sqrt(square)));
  }
  const double change = (acceleration * within + link.velocityRounding + other.velocityRounding) *
                        internal::kInflation;
  details.approachSpeed = speed;
  details.approachLower = speed - change;
  details.approachUpper = speed + change;
}

/// By separation, then by place: not by number.
bool comesBefore(const ContactPoint& x, const ContactPoint& y) {
  const auto key = [](const ContactPoint& p) {
    return std::make_tuple(p.separation, p.p_WOther.x(), p.p_WOther.y(), p.p_WOther.z(),
                           p.p_WLink.x(), p.p_WLink.y(), p.p_WLink.z(), p.lss, p.linkTriangle,
                           p.triangle);
  };
  return key(x) < key(y);
}

/// The pairs of one link and one object, or of two links, near each other at one instant.
class NearPoints {
 public:
  NearPoints(const QueryPlan& plan, const ChainMotion& motion, const LinkContact& contact,
             double within)
      : plan_(plan), motion_(motion), contact_(contact), within_(within) {}

  std::vector<ContactPoint> ofScene(std::vector<TriangleId>& found) {
    const ObjectId object = plan_.scene.object(contact_.triangle);
    for (const Part& part : partsOf(contact_.link)) {
      found.clear();
      std::uint64_t visited = 0;
      plan_.scene.parts().bvh.collect(boxOf(part), found, visited);
      for (const TriangleId id : found) {
        if (plan_.scene.object(id) != object) continue;
        offer(part, {Hull::of(plan_.scene.triangle(id)), 0.0, -1, id});
      }
    }
    return sorted();
  }

  std::vector<ContactPoint> ofLink(LinkId other) {
    std::vector<Part> ones = partsOf(contact_.link), others = partsOf(other);
    dropFar(ones, others);
    dropFar(others, ones);
    for (const Part& one : ones) {
      const Aabb box = boxOf(one);
      for (const Part& part : others) {
        if (box.overlaps(boxOf(part))) offer(one, part);
      }
    }
    return sorted();
  }

 private:
  /// An LSS, or a triangle of a mesh.
  struct Part {
    Hull hull;
    double radius;
    std::int32_t lss;
    std::int32_t triangle;
  };

  [[nodiscard]] Aabb boxOf(const Part& part) const {
    Aabb box;
    for (std::size_t i = 0; i < countOf(part.hull.count); ++i) box.add(part.hull.points[i]);
    box.grow(part.radius + within_);
    return box;
  }

  /// Of some parts those that are not near the box around all others.
  void dropFar(std::vector<Part>& parts, const std::vector<Part>& others) const {
    Aabb all;
    for (const Part& other : others) all.add(boxOf(other));
    parts.erase(std::remove_if(parts.begin(), parts.end(),
                               [&](const Part& part) { return !boxOf(part).overlaps(all); }),
                parts.end());
  }

  /// A link's surface at the contact's instant. At exact fidelity its triangles, and the LSS that
  /// hold none.
  [[nodiscard]] std::vector<Part> partsOf(LinkId link) const {
    std::vector<Part> parts;
    const LinkState state = motion_.stateAt(link, contact_.toi);
    const internal::LinkSurface* const surface = plan_.of(link).surface;
    const std::vector<Lss>& lss = plan_.avatar.lss(link);
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(lss.size()); ++i) {
      const Lss& one = lss[slotOf(i)];
      if (surface != nullptr && surface->hasTriangles(i)) continue;
      parts.push_back(
          {Hull::segment(state.pointAt(one.a), state.pointAt(one.b)), one.radius, i, -1});
    }
    for (std::size_t k = 0; surface != nullptr && k < surface->triangles().size(); ++k) {
      Triangle triangle = surface->triangles()[k];
      for (Vector3d& v : triangle.vertices) v = state.pointAt(v);
      parts.push_back({Hull::of(triangle), 0.0, -1, static_cast<std::int32_t>(k)});
    }
    return parts;
  }

  /// The closest points, and those of the corners: what lies on a face is held at its corners.
  void offer(const Part& one, const Part& other) {
    const auto corner = [](const Hull& hull, std::size_t i) {
      return Hull::segment(hull.points[i], hull.points[i]);
    };
    keep(one, other, one.hull, other.hull);
    for (std::size_t i = 0; i < countOf(one.hull.count); ++i) {
      keep(one, other, corner(one.hull, i), other.hull);
    }
    for (std::size_t i = 0; i < countOf(other.hull.count); ++i) {
      keep(one, other, one.hull, corner(other.hull, i));
    }
  }

  void keep(const Part& one, const Part& other, const Hull& hull, const Hull& otherHull) {
    const Separation apart = separation(hull, otherHull);
    const double gap = apart.distance - (one.radius + other.radius);
    if (gap > within_) return;
    const Vector3d n =
        apart.distance > 0.0 ? Vector3d(apart.difference.stableNormalized()) : contact_.nhat_SL_W;
    points_.push_back({apart.onOne - one.radius * n, apart.onOther + other.radius * n, gap,
                       other.triangle, one.lss, one.triangle});
  }

  std::vector<ContactPoint> sorted() {
    std::sort(points_.begin(), points_.end(), comesBefore);
    return std::move(points_);
  }

  const QueryPlan& plan_;
  const ChainMotion& motion_;
  const LinkContact& contact_;
  double within_;
  std::vector<ContactPoint> points_;
};

/// Moves the point that `measure` finds largest, if that is above zero, to the details.
template <typename Measure>
bool takeLargest(const std::vector<ContactPoint>& points, const Measure& measure,
                 ContactDetails& details) {
  double largest = 0.0;
  const ContactPoint* best = nullptr;
  for (const ContactPoint& point : points) {
    const double size = measure(point.p_WOther);
    if (size > largest) {
      largest = size;
      best = &point;
    }
  }
  if (best == nullptr) return false;
  details.points[details.numPoints++] = *best;
  return true;
}

/// Up to four of the points, which come nearest first.
void choosePoints(const std::vector<ContactPoint>& points, ContactDetails& details) {
  if (points.empty()) return;
  details.points[details.numPoints++] = points.front();
  const auto at = [&](std::size_t i) -> const Vector3d& { return details.points[i].p_WOther; };
  const auto distance = [&](const Vector3d& p) { return (p - at(0)).squaredNorm(); };
  if (!takeLargest(points, distance, details)) return;
  const auto area = [&](const Vector3d& p) { return (at(1) - at(0)).cross(p - at(0)).norm(); };
  if (!takeLargest(points, area, details)) return;
  const Vector3d side = (at(1) - at(0)).cross(at(2) - at(0));
  // How far outside of the triangle: on the far side of one of its edges.
  const auto outside = [&](const Vector3d& p) {
    double most = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d edge = at((i + 1) % 3) - at(i);
      most = std::max(most, -edge.cross(p - at(i)).dot(side));
    }
    return most;
  };
  takeLargest(points, outside, details);
}

bool hasContact(const LinkContact& contact) {
  return contact.verdict == Verdict::Contact || contact.verdict == Verdict::StartsInContact;
}

}  // namespace

namespace internal {

ContactDetails detailsOf(const QueryPlan& plan, const ChainMotion& motion,
                         const LinkContact& contact, std::vector<TriangleId>& found) {
  ContactDetails details;
  FORETOUCH_ASSERT(hasContact(contact));
  if (!hasContact(contact)) return details;
  describeApproach(contact, pointOf(motion, contact.link, contact.toi, contact.p_WLink), {},
                   details);
  if (!isOfLinks(plan.options.fidelity)) return details;
  NearPoints near(plan, motion, contact, plan.of(contact.link).tolerance);
  choosePoints(near.ofScene(found), details);
  return details;
}

ContactDetails detailsOf(const QueryPlan& plan, const ChainMotion& motion,
                         const PairContact& contact) {
  ContactDetails details;
  FORETOUCH_ASSERT(hasContact(contact) && contact.other >= 0);
  if (!hasContact(contact) || contact.other < 0) return details;
  describeApproach(contact, pointOf(motion, contact.link, contact.toi, contact.p_WLink),
                   pointOf(motion, contact.other, contact.toi, contact.p_WScene), details);
  const double tolerance =
      std::min(plan.of(contact.link).tolerance, plan.of(contact.other).tolerance);
  NearPoints near(plan, motion, contact, tolerance);
  choosePoints(near.ofLink(contact.other), details);
  return details;
}

}  // namespace internal
}  // namespace foretouch
