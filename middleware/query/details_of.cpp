#include <algorithm>
#include <vector>

#include <Eigen/Core>

#include "lss/assert.h"
#include "lss/index.h"
#include "middleware/pair/approach.h"
#include "middleware/pair/query_plan.h"
#include "middleware/pair/side.h"
#include "middleware/query/manifold.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::Approach;
using internal::Manifold;
using internal::MaterialPoint;
using internal::QueryPlan;

MaterialPoint pointOf(const ChainMotion& motion, LinkId link, double t, const Vector3d& p_W) {
  return internal::materialPointAt(motion.stateAt(link, t), motion.bounds(link), p_W);
}

void describeApproach(const LinkContact& contact, const MaterialPoint& link,
                      const MaterialPoint& other, ContactDetails& details) {
  details.v_WLink = link.velocity;
  details.v_WOther = other.velocity;
  const Approach approach =
      approachAlong(contact.nhat_SL_W, contact.separation, link, other, 1.0 - contact.toi);
  details.approachSpeed = approach.speed;
  details.approachLower = approach.lower;
  details.approachUpper = approach.upper;
}

/// The pairs of one link and one object, or of two links, near each other at one instant.
class NearPoints {
 public:
  NearPoints(const QueryPlan& plan, const ChainMotion& motion, const LinkContact& contact,
             double within)
      : plan_(plan), motion_(motion), contact_(contact), within_(within) {
    manifold_.begin(within, contact.nhat_SL_W);
  }

  Manifold& ofScene(std::vector<TriangleId>& found) {
    const ObjectId object = plan_.scene.object(contact_.triangle);
    for (const Part& part : partsOf(contact_.link)) {
      found.clear();
      std::uint64_t visited = 0;
      plan_.scene.parts().bvh.collect(boxOf(part), found, visited);
      for (const TriangleId id : found) {
        if (plan_.scene.object(id) != object) continue;
        manifold_.offer(part, {Hull::of(plan_.scene.triangle(id)), 0.0, -1, id});
      }
    }
    return manifold_;
  }

  Manifold& ofLink(LinkId other) {
    std::vector<Part> ones = partsOf(contact_.link), others = partsOf(other);
    dropFar(ones, others);
    dropFar(others, ones);
    for (const Part& one : ones) {
      const Aabb box = boxOf(one);
      for (const Part& part : others) {
        if (box.overlaps(boxOf(part))) manifold_.offer(one, part);
      }
    }
    return manifold_;
  }

 private:
  using Part = internal::ManifoldPart;

  [[nodiscard]] Aabb boxOf(const Part& part) const {
    Aabb box;
    for (std::size_t i = 0; i < countOf(part.hull.count); ++i) box.add(part.hull.points[i]);
    box.grow(part.radius + within_);
    return box;
  }

  /// Drops those of some parts that are not near the box around all others.
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

  const QueryPlan& plan_;
  const ChainMotion& motion_;
  const LinkContact& contact_;
  double within_;
  Manifold manifold_;
};

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
  near.ofScene(found).choose(details);
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
  near.ofLink(contact.other).choose(details);
  return details;
}

}  // namespace internal
}  // namespace foretouch
