#include "middleware/solid_world/around_rows.h"

#include <algorithm>

#include "lss/index.h"
#include "lss/separation.h"

namespace foretouch::internal {
namespace {

/// Where a point of one place is at another place of the same link.
Eigen::Vector3d carried(const LinkState& from, const LinkState& to, const Eigen::Vector3d& p) {
  return to.pointAt(from.R_WL.transpose() * (p - from.p_WL));
}

/// How far points within `rho` of the link's origin are from one place to the other.
double moveOf(const LinkState& from, const LinkState& to, double rho) {
  return (to.p_WL - from.p_WL).norm() + (to.R_WL - from.R_WL).norm() * rho;
}

}  // namespace

AroundRows::Placed& AroundRows::place(const AroundBody& body, std::int64_t beginUs,
                                      std::int64_t endUs) {
  if (placed_.size() == count_) placed_.emplace_back();
  Placed& at = placed_[count_];
  at.body = &body;
  at.atBegin = body.legAt(beginUs);
  at.atEnd = body.legAt(endUs);
  at.moves = 0.0;
  if (at.atBegin == nullptr) return at;
  if (at.atEnd == nullptr || at.atEnd->kind->skeleton.numJoints() - at.atEnd->kind->first !=
                                 at.atBegin->kind->skeleton.numJoints() - at.atBegin->kind->first) {
    at.atEnd = at.atBegin;
    endUs = at.atBegin->endUs;
  }
  body.placeAt(*at.atBegin, beginUs, at.begin);
  body.placeAt(*at.atEnd, endUs, at.end);
  const JointId shift = at.atEnd->kind->first - at.atBegin->kind->first;
  for (std::size_t j = slotOf(at.atBegin->kind->first); j < at.begin.size(); ++j) {
    const LinkState& end = at.end[j + static_cast<std::size_t>(shift)];
    at.moves = std::max(at.moves, moveOf(at.begin[j], end, at.atBegin->kind->rho));
  }
  return at;
}

const AroundRows::Placed* AroundRows::placed(const AroundBody* body) const {
  for (std::size_t i = 0; i < count_; ++i) {
    if (placed_[i].body == body) return &placed_[i];
  }
  return nullptr;
}

void AroundRows::append(PassageProver& prover, const Surroundings& around, std::int64_t beginUs,
                        std::int64_t endUs, const std::vector<LinkState>& states,
                        const std::vector<double>& reach, std::vector<ContactRow>& rows) {
  features_.clear();
  count_ = 0;
  farthestMove_ = 0.0;
  windowS_ = 1e-6 * static_cast<double>(endUs - beginUs);
  double widest = 0.0;
  for (const double one : reach) widest = std::max(widest, one);
  Eigen::AlignedBox3d box;
  for (std::size_t link = 0; link < states.size(); ++link) {
    for (const Lss& lss : prover.volumes()[link]) {
      const Eigen::Vector3d around_ = Eigen::Vector3d::Constant(lss.radius + widest);
      for (const Eigen::Vector3d& end :
           {states[link].pointAt(lss.a), states[link].pointAt(lss.b)}) {
        box.extend(end - around_);
        box.extend(end + around_);
      }
    }
  }
  for (const AroundBody* const body : around.bodies) {
    // The body's box holds all that it sweeps.
    if (!box.intersects(body->box())) continue;
    const Placed& at = place(*body, beginUs, endUs);
    if (at.atBegin == nullptr) continue;
    ++count_;
    farthestMove_ = std::max(farthestMove_, at.moves);
    reach_ = reach;
    for (double& one : reach_) one += at.moves;
    if (at.atBegin->kind->mesh) {
      appendMesh(at, prover, states, reach_, rows);
    } else {
      appendLss(at, prover, states, reach_, rows);
    }
  }
}

void AroundRows::push(const Placed& at, JointId joint, const ContactRow& row, std::int32_t lss,
                      TriangleId triangle, std::vector<ContactRow>& rows) {
  AroundFeature feature;
  feature.body = at.body;
  feature.joint = joint;
  feature.jointAtEnd = joint + at.atEnd->kind->first - at.atBegin->kind->first;
  feature.lss = lss;
  feature.triangle = triangle;
  const Eigen::Vector3d moved =
      carried(at.begin[slotOf(joint)], at.end[slotOf(feature.jointAtEnd)], row.y) - row.y;
  feature.comes = row.n.dot(moved);
  feature.velocity_W = moved / windowS_;
  features_.push_back(feature);
  rows.push_back(row);
}

void AroundRows::appendLss(const Placed& at, const PassageProver& prover,
                           const std::vector<LinkState>& states, const std::vector<double>& reach,
                           std::vector<ContactRow>& rows) {
  const AroundKind& kind = *at.atBegin->kind;
  for (std::size_t link = 0; link < states.size(); ++link) {
    const std::vector<Lss>& own = prover.volumes()[link];
    for (std::size_t i = 0; i < own.size(); ++i) {
      const LssInWorld one{states[link].pointAt(own[i].a), states[link].pointAt(own[i].b),
                           own[i].radius};
      for (std::size_t j = slotOf(kind.first); j < kind.volumes.size(); ++j) {
        for (std::size_t k = 0; k < kind.volumes[j].size(); ++k) {
          const Lss& lss = kind.volumes[j][k];
          const LssInWorld other{at.begin[j].pointAt(lss.a), at.begin[j].pointAt(lss.b),
                                 lss.radius};
          const double radii = one.radius + other.radius;
          ContactRow row;
          if (!findRow(one, other, radii, radii + reach[link], row)) continue;
          row.link = static_cast<LinkId>(link);
          row.lss = static_cast<std::int32_t>(i);
          push(at, static_cast<JointId>(j), row, static_cast<std::int32_t>(k), -1, rows);
        }
      }
    }
  }
}

void AroundRows::appendMesh(const Placed& at, PassageProver& prover,
                            const std::vector<LinkState>& states, const std::vector<double>& reach,
                            std::vector<ContactRow>& rows) {
  const AroundKind& kind = *at.atBegin->kind;
  const LinkState& mesh = at.begin[slotOf(kind.first)];
  seen_ = states;
  for (LinkState& state : seen_) {
    state.p_WL = mesh.R_WL.transpose() * (state.p_WL - mesh.p_WL);
    state.R_WL = mesh.R_WL.transpose() * state.R_WL;
  }
  const auto plan = prover.planOf(kind);
  if (!plan.ok()) return;  // prepare() has made it
  plan.value()->near().answer(seen_, reach, scratch_, near_);
  for (const NearFeature& feature : near_.features) {
    if (feature.nhat_SL_W.squaredNorm() == 0.0) continue;
    ContactRow row;
    row.link = feature.link;
    row.lss = feature.lss;
    row.x = mesh.pointAt(feature.p_WLink);
    row.y = mesh.pointAt(feature.p_WScene);
    row.n = mesh.R_WL * feature.nhat_SL_W;
    row.gap = feature.gap;
    push(at, kind.first, row, -1, feature.triangle, rows);
  }
}

double AroundRows::gapAtEnd(const ContactRow& row, const AroundFeature& feature,
                            const std::vector<std::vector<Lss>>& volumes,
                            const std::vector<LinkState>& states) const {
  const Placed& at = *placed(feature.body);
  const LinkState& there = at.end[slotOf(feature.jointAtEnd)];
  const LinkState& here = states[slotOf(row.link)];
  const Lss& own = volumes[slotOf(row.link)][slotOf(row.lss)];
  const Hull axis = Hull::segment(here.pointAt(own.a), here.pointAt(own.b));
  if (feature.lss >= 0) {
    const Lss& other = at.atBegin->kind->volumes[slotOf(feature.joint)][slotOf(feature.lss)];
    const Hull axisThere = Hull::segment(there.pointAt(other.a), there.pointAt(other.b));
    return separation(axis, axisThere).lower() - own.radius - other.radius;
  }
  Triangle triangle = at.atBegin->kind->mesh->triangle(feature.triangle);
  for (Eigen::Vector3d& v : triangle.vertices) v = there.pointAt(v);
  return separation(axis, Hull::of(triangle)).lower() - own.radius;
}

}  // namespace foretouch::internal
