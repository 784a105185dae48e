#include "tests/reference/spheroid_query.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "middleware/pair/backtracking.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// A computed semi-axis or distance may be off by a few roundings; boxes are grown by this share.
constexpr double kBoxInflation = 1.0 + 1e-9;
/// At t = 0 we search ever larger spheroids, each this share of the whole: the triangle nearest to
/// the centre decides, and a body in the middle of a room touches thousands.
constexpr double kStartShares[] = {0.125, 0.25, 0.5, 1.0};

/// The links that the spheroid covers get its answer, each with its own number.
constexpr LinkId kAnyLink = 0;

class Sweep {
 public:
  Sweep(const SpheroidQuery& query, std::vector<TriangleId>& found, QueryCounters& counters)
      : query_(query),
        found_(found),
        counters_(counters),
        unitTolerance_(query.tolerance / (query.spheroid.longest() * kBoxInflation)) {}

  LinkContact run() {
    for (const double share : kStartShares) {
      collect(boxAt(share, 0.0));
      double nearest = unitTolerance_;
      for (const TriangleId id : found_) lookAtStart(id, nearest);
      // Every triangle nearer than `share` was in the box.
      if (best_ && best_->verdict == Verdict::StartsInContact && nearest <= share - 1.0) {
        return *best_;
      }
    }
    best_.reset();
    horizon_ = HUGE_VAL;
    Aabb box = boxAt(1.0, 0.0);
    box.add(boxAt(1.0, 1.0));
    collect(box);
    for (const TriangleId id : found_) advance(id);
    return best_ ? *best_ : clearContact(kAnyLink);
  }

 private:
  void collect(const Aabb& box) {
    found_.clear();
    query_.culler.collect(box, found_, counters_.nodes);
    found_.erase(
        std::remove_if(found_.begin(), found_.end(),
                       [this](TriangleId id) { return query_.ignored.has(query_.scene, id); }),
        found_.end());
    counters_.candidates += found_.size();
  }

  /// Around the spheroid shrunk to `share`, grown by the tolerance.
  [[nodiscard]] Aabb boxAt(double share, double t) const {
    const Spheroid& s = query_.spheroid;
    const Vector3d center = s.centerAt(t);
    Aabb box;
    box.add(center);
    for (int i = 0; i < 3; ++i) {
      const double n = s.axis[i];
      const double half = share * std::sqrt(s.across * s.across * std::max(0.0, 1.0 - n * n) +
                                            s.along * s.along * n * n);
      box.min[i] -= half * kBoxInflation;
      box.max[i] += half * kBoxInflation;
    }
    // The centre's own rounding, and that of 1 - n^2.
    box.grow(query_.tolerance + 1e-9 * s.longest() + 1e-15 * center.lpNorm<1>());
    return box;
  }

  /// Lowers `nearest` to the proven upper bound of the triangle's distance at t = 0; keeps one that
  /// touches and is not farther away.
  void lookAtStart(TriangleId id, double& nearest) {
    const SpheroidPair pair(query_.spheroid, query_.scene.triangle(id));
    if (pair.leastAtStart() - 1.0 > nearest) return;
    ++counters_.advancements;
    const SpheroidPair::Look look = pair.at(0.0);
    if (look.lower <= 0.0 && look.upper <= unitTolerance_) keep(contactOf(id, look, 0.0));
    nearest = std::min(nearest, look.upper);
  }

  void advance(TriangleId id) {
    const SpheroidPair pair(query_.spheroid, query_.scene.triangle(id));
    if (pair.leastOfAll() - 1.0 > unitTolerance_) return;
    const double floor = kFloorShare * unitTolerance_;
    double t = 0.0;
    while (t < 1.0 && t <= horizon_) {
      if (query_.meter.isSpent(counters_)) return giveUp(0.0, UndecidedReason::WorkBudget);
      ++counters_.advancements;
      const SpheroidPair::Look look = pair.at(t);
      if (look.upper <= unitTolerance_) return keep(contactOf(id, look, t));
      const double next = pair.provenFrom(t, look, floor);
      if (!(next > t)) return giveUp(t, UndecidedReason::Resolution);
      t = next;
    }
  }

  void keep(const LinkContact& contact) {
    if (contact.toi > horizon_) return;
    const bool isTied = contact.toi == horizon_ && best_ && best_->verdict != Verdict::Undecided;
    if (!isTied || comesFirst(contact, *best_)) best_ = contact;
    horizon_ = contact.toi;
  }

  /// A contact at this instant stands.
  void giveUp(double t, UndecidedReason reason) {
    if (t >= horizon_) return;
    best_ = undecidedContact(kAnyLink, t, reason);
    horizon_ = t;
  }

  [[nodiscard]] LinkContact contactOf(TriangleId id, const SpheroidPair::Look& look,
                                      double t) const {
    const Spheroid& s = query_.spheroid;
    // In the unit ball's space; the centre is t*toUnit(drift) there.
    const Vector3d center = t * s.toUnit(s.drift);
    const Vector3d away = center - look.onTriangle;
    const double distance = away.norm();
    const Vector3d nhat = look.nhat.squaredNorm() > 0.5
                              ? Vector3d(look.nhat.normalized())
                              : (distance > 0.0 ? Vector3d(away / distance) : Vector3d::UnitY());
    LinkContact contact;
    const bool starts = t == 0.0 && look.lower <= 0.0;
    contact.verdict = starts ? Verdict::StartsInContact : Verdict::Contact;
    contact.toi = contact.freeUntil = t;
    contact.triangle = id;
    contact.lss = 0;
    // A plane's normal transforms by the transposed inverse, and S is symmetric.
    contact.nhat_SL_W = s.toUnit(nhat).normalized();
    contact.p_WScene = s.start + s.fromUnit(look.onTriangle);
    contact.p_WLink = s.start + s.fromUnit(center - nhat);
    const double gap = s.fromUnit(center - nhat - look.onTriangle).norm();
    contact.separation = starts ? 0.0 : std::min(query_.tolerance, gap);
    contact.penetration = starts ? std::max(0.0, 1.0 - distance) * s.shortest() : 0.0;
    return contact;
  }

  const SpheroidQuery& query_;
  std::vector<TriangleId>& found_;
  QueryCounters& counters_;
  double unitTolerance_;
  std::optional<LinkContact> best_;  // nothing: horizon_ is infinite
  double horizon_ = HUGE_VAL;        // nothing later than this can change the answer
};

}  // namespace

LinkContact firstContactOf(const SpheroidQuery& query, std::vector<TriangleId>& found,
                           QueryCounters& counters) {
  return Sweep(query, found, counters).run();
}

}  // namespace foretouch::internal
