#include "middleware/events/body_masses.h"

#include <string>

#include "lss/index.h"

namespace foretouch::internal {

Result<Done> BodyMasses::checked(const WorldParts& world) const {
  for (const auto& [body, entry] : masses_) {
    const auto error = [body = body](std::string text) {
      Error mismatch = Error::in("mass", ErrorCode::Mismatch, std::move(text));
      mismatch.index = body;
      return mismatch;
    };
    if (slotOf(body) >= world.bodies.size()) {
      return error("body " + std::to_string(body) + " weighs something, and there are " +
                   std::to_string(world.bodies.size()));
    }
    const std::int32_t joints = world.kindOf(body).skeleton.numJoints();
    const auto* const links = std::get_if<AvatarMass>(&entry->of);
    const std::int32_t expected = links != nullptr ? links->numLinks() : 1;
    if (joints == expected) continue;
    return error("body " + std::to_string(body) + " has " + std::to_string(joints) +
                 " links, and its mass is that of " + std::to_string(expected));
  }
  return Done{};
}

Eigen::Matrix3d BodyMasses::inverseAt(BodyId body, LinkId link,
                                      const std::vector<LinkState>& states,
                                      const Eigen::Vector3d& p) const {
  Entry& entry = *masses_.at(body);
  if (const auto* const rigid = std::get_if<Mass>(&entry.of)) {
    const RigidPose pose{Quaternion(states.front().R_WL).normalized(), states.front().p_WL};
    return inverseMassAt(*rigid, pose, p);
  }
  auto& avatar = std::get<AvatarMass>(entry.of);
  const std::lock_guard<std::mutex> lock(entry.placing);
  avatar.place(states);
  return avatar.inverseMassAt(link, p);
}

Eigen::Matrix3d BodyMasses::inverseBetween(BodyId body, LinkId one, const Eigen::Vector3d& p,
                                           LinkId other, const Eigen::Vector3d& q,
                                           const std::vector<LinkState>& states) const {
  Entry& entry = *masses_.at(body);
  auto* const avatar = std::get_if<AvatarMass>(&entry.of);
  if (avatar == nullptr) return Eigen::Matrix3d::Zero();  // it does not meet itself
  const std::lock_guard<std::mutex> lock(entry.placing);
  avatar->place(states);
  return avatar->inverseMassBetween(one, p, other, q);
}

}  // namespace foretouch::internal
