#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/mechanics/mass.h"
#include "middleware/mechanics/tree_inertia.h"

namespace foretouch {
namespace {

using internal::wrench;

/// What turning a joint costs beyond the masses that turn, so that its inverse keeps its digits
/// (kg m2): next to nothing, and where the link weighs nothing a millionth of what hangs on it, at
/// 10 cm.
constexpr double kLeastTurn = 1e-12, kTurnOfCarried = 1e-8;

bool isNone(const Mass& mass) {
  return mass.kg == 0.0 && mass.center_B.isZero(0.0) && mass.inertia_B.isZero(0.0);
}

}  // namespace

struct AvatarMass::Parts {
  std::vector<Mass> masses;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> origins, centers;  // of the links' frames and masses, from `origin`
  std::vector<Eigen::Matrix3d> inertias;          // of the links, axes of W
  internal::TreeInertia inertia;
  std::vector<double> leastTurns;
  // Memory for the questions.
  std::vector<internal::Vector6d> forces;
  std::vector<Eigen::Vector3d> torques, turns, shifts, moreTurns;
  std::vector<internal::Twist> twists, moreTwists;

  /// The motion that `forces` and `torques` cause, in addition to that which is there.
  void addMotion() {
    inertia.solve(forces, torques, moreTurns, shifts, moreTwists);
    for (std::size_t j = 0; j < masses.size(); ++j) {
      turns[j] += moreTurns[j];
      twists[j].w += moreTwists[j].w;
      twists[j].v += moreTwists[j].v;
    }
  }
  /// The motion that an impulse at p causes, and its opposite at `other`'s point q (kNoParent:
  /// nowhere), both relative to `origin`.
  void answer(const Eigen::Vector3d& impulse, LinkId link, const Eigen::Vector3d& p, LinkId other,
              const Eigen::Vector3d& q) {
    // About one origin a light link far out loses digits: what is missing is solved for again.
    constexpr int kTimes = 3;
    twists.assign(masses.size(), {});
    turns.assign(masses.size(), Eigen::Vector3d::Zero());
    for (int i = 0; i < kTimes; ++i) {
      for (std::size_t j = 0; j < masses.size(); ++j) {
        forces[j] = -wrench(centers[j], masses[j].kg * twists[j].at(centers[j]));
        forces[j].head<3>() -= inertias[j] * twists[j].w;
        torques[j] = -leastTurns[j] * turns[j];
      }
      forces[slotOf(link)] += wrench(p, impulse);
      if (other != kNoParent) forces[slotOf(other)] -= wrench(q, impulse);
      addMotion();
    }
  }
};

AvatarMass::AvatarMass(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
AvatarMass::AvatarMass(AvatarMass&&) noexcept = default;
AvatarMass& AvatarMass::operator=(AvatarMass&&) noexcept = default;
AvatarMass::~AvatarMass() = default;

Result<AvatarMass> AvatarMass::build(const Skeleton& skeleton, std::vector<Mass> masses) {
  const auto n = countOf(skeleton.numJoints());
  if (masses.size() != n) {
    return Error::of(ErrorCode::Mismatch, "expected a mass for each of " + std::to_string(n) +
                                              " links, found " + std::to_string(masses.size()));
  }
  std::vector<double> carried(n, 0.0);
  for (std::size_t j = n; j-- > 0;) {
    const auto link = static_cast<std::int64_t>(j);
    if (!isNone(masses[j])) {
      auto checked = checkedMass(masses[j]);
      if (!checked) return Error::at(link, checked.error().code, checked.error().message);
      masses[j] = std::move(checked).value();
    }
    carried[j] += masses[j].kg;
    const JointId parent = skeleton.parents()[j];
    if (parent != kNoParent) {
      carried[slotOf(parent)] += carried[j];
    } else if (!(carried[j] > 0.0)) {
      return Error::at(link, ErrorCode::Empty, "expected a root that carries a mass");
    }
  }
  auto parts = std::make_unique<Parts>();
  parts->leastTurns.assign(n, kLeastTurn);
  for (std::size_t j = 0; j < n; ++j) {
    if (masses[j].kg == 0.0) parts->leastTurns[j] += kTurnOfCarried * carried[j];
  }
  parts->masses = std::move(masses);
  parts->origins.resize(n);
  parts->centers.assign(n, Eigen::Vector3d::Zero());
  parts->inertias.assign(n, Eigen::Matrix3d::Zero());
  parts->forces.resize(n);
  parts->torques.resize(n);
  parts->inertia.reset(skeleton.parents(), 0.0);
  return AvatarMass(std::move(parts));
}

std::int32_t AvatarMass::numLinks() const {
  return static_cast<std::int32_t>(parts_->masses.size());
}

void AvatarMass::place(const std::vector<LinkState>& states) {
  Parts& p = *parts_;
  p.origin = states.front().p_WL;
  p.inertia.begin();
  for (std::size_t j = 0; j < p.masses.size(); ++j) {
    const LinkState& state = states[j];
    const auto link = static_cast<LinkId>(j);
    p.origins[j] = state.p_WL - p.origin;
    p.inertia.setOrigin(link, p.origins[j]);
    const Mass& mass = p.masses[j];
    if (mass.kg == 0.0) continue;
    p.centers[j] = p.origins[j] + state.R_WL * mass.center_B;
    p.inertias[j] = state.R_WL * mass.inertia_B * state.R_WL.transpose();
    p.inertia.addBody(link, p.centers[j], mass.kg, p.inertias[j]);
  }
  p.inertia.factor(p.leastTurns);
}

Eigen::Matrix3d AvatarMass::inverseMassAt(LinkId link, const Eigen::Vector3d& p_W) const {
  return inverseMassBetween(link, p_W, kNoParent, p_W);
}

Eigen::Matrix3d AvatarMass::inverseMassBetween(LinkId one, const Eigen::Vector3d& pOne_W,
                                               LinkId other,
                                               const Eigen::Vector3d& pOther_W) const {
  Parts& p = *parts_;
  const Eigen::Vector3d x = pOne_W - p.origin, y = pOther_W - p.origin;
  Eigen::Matrix3d K;
  for (int i = 0; i < 3; ++i) {
    p.answer(Eigen::Vector3d::Unit(i), one, x, other, y);
    K.col(i) = p.twists[slotOf(one)].at(x);
    if (other != kNoParent) K.col(i) -= p.twists[slotOf(other)].at(y);
  }
  return 0.5 * (K + K.transpose());
}

void AvatarMass::respond(LinkId link, const Eigen::Vector3d& p_W, const Eigen::Vector3d& impulse_W,
                         std::vector<VelocityChange>& changes) const {
  Parts& p = *parts_;
  p.answer(impulse_W, link, p_W - p.origin, kNoParent, p.origin);
  changes.resize(p.masses.size());
  for (std::size_t j = 0; j < changes.size(); ++j) {
    changes[j] = {p.twists[j].w, p.twists[j].at(p.origins[j])};
  }
}

}  // namespace foretouch
