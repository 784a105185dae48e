#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "middleware/mechanics/mass.h"

namespace foretouch {
namespace {

/// One collision, seen along its normal.
class Collision {
 public:
  explicit Collision(const CollisionPoint& point)
      : K_(point.inverseMass_W), n_(point.nhat_BA_W), u_(point.velocity_W), un_(n_.dot(u_)) {}

  /// The impulse for a material; zero where there is none.
  [[nodiscard]] CollisionImpulse impulseFor(const ContactMaterial& material) const {
    CollisionImpulse stick = sticking(material);
    const double push = n_.dot(stick.onA_W);
    const double rub = (stick.onA_W - push * n_).norm();
    if (push >= 0.0 && rub <= material.friction * push) return stick;
    return sliding(material, stick);
  }

  /// Whether it does something, and adds no kinetic energy but for rounding.
  [[nodiscard]] bool isLawful(const CollisionImpulse& impulse) const {
    constexpr double kRounding = 1e-14;
    const Eigen::Vector3d& J = impulse.onA_W;
    return !J.isZero(0.0) && J.dot(2.0 * u_ + K_ * J) <= kRounding * std::abs(J.dot(u_));
  }

 private:
  /// The impulse after which nothing slides.
  [[nodiscard]] CollisionImpulse sticking(const ContactMaterial& material) const {
    CollisionImpulse impulse;
    impulse.onA_W = K_.ldlt().solve(-material.restitution * un_ * n_ - u_);
    impulse.sticks = true;
    impulse.applied = material;
    return impulse;
  }

  /// Friction as strong as it can be, against the way they slide.
  [[nodiscard]] CollisionImpulse sliding(const ContactMaterial& material,
                                         const CollisionImpulse& stick) const {
    CollisionImpulse impulse;
    impulse.applied = material;
    const Eigen::Vector3d across = u_ - un_ * n_;
    const double speed = across.norm();
    // What does not slide yet would slide as the sticking impulse's friction says.
    const Eigen::Vector3d rub = stick.onA_W - n_.dot(stick.onA_W) * n_;
    const Eigen::Vector3d against = speed > 0.0        ? Eigen::Vector3d(-across / speed)
                                    : rub.norm() > 0.0 ? Eigen::Vector3d(rub.normalized())
                                                       : Eigen::Vector3d::Zero();
    const Eigen::Vector3d way = n_ + material.friction * against;
    const double parts = n_.dot(K_ * way);
    // Painleve: friction would press them together as fast as the normal parts them.
    if (!(parts > 0.0)) return impulse;
    impulse.onA_W = (-(1.0 + material.restitution) * un_ / parts) * way;
    return impulse;
  }

  const Eigen::Matrix3d& K_;
  const Eigen::Vector3d &n_, &u_;
  double un_;
};

/// One of the materials share(0) to share(1), of which the first is lawful: it is lawful, and its
/// neighbour is not.
template <typename Share>
CollisionImpulse mostLawful(const Collision& collision, const Share& share) {
  constexpr int kHalvings = 60;
  double low = 0.0, high = 1.0;
  CollisionImpulse best = collision.impulseFor(share(0.0));
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    const CollisionImpulse impulse = collision.impulseFor(share(middle));
    const bool isLawful = collision.isLawful(impulse);
    if (isLawful) best = impulse;
    (isLawful ? low : high) = middle;
  }
  return best;
}

}  // namespace

double effectiveMass(const CollisionPoint& point) {
  const double inverse = point.nhat_BA_W.dot(point.inverseMass_W * point.nhat_BA_W);
  return inverse > 0.0 ? 1.0 / inverse : std::numeric_limits<double>::infinity();
}

CollisionImpulse collisionImpulse(const CollisionPoint& point, const ContactMaterial& material) {
  CollisionImpulse none;
  if (!point.nhat_BA_W.allFinite() || !point.velocity_W.allFinite() ||
      !point.inverseMass_W.allFinite() || std::isnan(material.restitution) ||
      std::isnan(material.friction)) {
    return none;
  }
  ContactMaterial asked;
  asked.restitution = std::clamp(material.restitution, 0.0, 1.0);
  asked.friction = std::clamp(material.friction, 0.0, std::numeric_limits<double>::max());
  none.applied = asked;
  const bool approaches = point.nhat_BA_W.dot(point.velocity_W) < 0.0;
  if (!approaches || std::isinf(effectiveMass(point))) return none;

  const Collision collision(point);
  const CollisionImpulse whole = collision.impulseFor(asked);
  if (collision.isLawful(whole)) return whole;
  // Less restitution; if even none is too much, less friction. Without both, energy only falls.
  if (collision.isLawful(collision.impulseFor({0.0, asked.friction}))) {
    return mostLawful(collision, [&](double share) {
      return ContactMaterial{share * asked.restitution, asked.friction};
    });
  }
  return mostLawful(collision, [&](double share) {
    return ContactMaterial{0.0, share * asked.friction};
  });
}

}  // namespace foretouch
