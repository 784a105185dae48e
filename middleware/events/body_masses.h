// middleware/events/body_masses.h: what bodies weigh, for an event's effective mass.
// Not installed.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "articulated/result.h"
#include "middleware/mechanics/mass.h"
#include "middleware/world/world_contacts.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// Any number of threads may ask at once.
class BodyMasses {
 public:
  void set(BodyId body, const Mass& mass) { masses_[body] = std::make_unique<Entry>(mass); }
  void set(BodyId body, AvatarMass mass) {
    masses_[body] = std::make_unique<Entry>(std::move(mass));
  }
  [[nodiscard]] bool has(BodyId body) const { return masses_.count(body) != 0; }
  /// Whether each belongs to a body that can have it. Errors: Mismatch, with the body.
  [[nodiscard]] Result<Done> checked(const WorldParts& world) const;

  /// How a body's point answers an impulse there. `states`: of all its links; all in one frame
  /// whose axes are W's. Precondition: has(body).
  [[nodiscard]] Eigen::Matrix3d inverseAt(BodyId body, LinkId link,
                                          const std::vector<LinkState>& states,
                                          const Eigen::Vector3d& p) const;
  /// The same for two points of one body, each of which moves the other.
  [[nodiscard]] Eigen::Matrix3d inverseBetween(BodyId body, LinkId one, const Eigen::Vector3d& p,
                                               LinkId other, const Eigen::Vector3d& q,
                                               const std::vector<LinkState>& states) const;

 private:
  struct Entry {
    explicit Entry(const Mass& mass) : of(mass) {}
    explicit Entry(AvatarMass mass) : of(std::move(mass)) {}
    std::variant<Mass, AvatarMass> of;
    std::mutex placing;  // an avatar's answers belong to the pose that it was placed in
  };
  std::map<BodyId, std::unique_ptr<Entry>> masses_;
};

}  // namespace foretouch::internal
