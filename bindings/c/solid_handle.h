// bindings/c/solid_handle.h: the struct behind ft_solid.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bindings/c/handles.h"
#include "bindings/c/include/foretouch/solid.h"
#include "middleware/solid/solid_avatar.h"

/// For one thread. Computes a tick beside the last one, which it replaces once done.
struct ft_solid {
  static constexpr auto kMark = foretouch::c::Mark::Solid;
  static constexpr const char* kName = "solid";
  ft_solid(std::shared_ptr<const foretouch::c::AvatarParts> ofAvatar, foretouch::Scene inScene,
           foretouch::SolidAvatar made)
      : avatar(std::move(ofAvatar)),
        scene(std::move(inScene)),
        solid(std::move(made)),
        last(restPose(avatar->avatar.skeleton())) {}

  foretouch::c::Mark mark = kMark;
  std::shared_ptr<const foretouch::c::AvatarParts> avatar;
  foretouch::Scene scene;
  foretouch::SolidAvatar solid;
  bool isSuspect = false;  // an exception left `solid` half written
  foretouch::Pose last;    // where it goes on from
  bool hasLast = false;
  foretouch::Pose given;
  std::vector<std::uint8_t> isTracked;
  foretouch::SolidTick tick, next;
  bool hasTick = false;
};

namespace foretouch::c {

/// As SolidOptions has them.
[[nodiscard]] ft_solid_options defaultSolidOptions();
/// NULL: the usual ones. The library itself checks the values.
[[nodiscard]] ft_status readSolidOptions(const ft_solid_options* given, SolidOptions& options);
/// An error about an option or argument names it as C does.
[[nodiscard]] ft_status solidFailure(Error error);

/// Where, and how hard, a solid avatar presses: the same for what stands and for what moves.
template <typename Contact, typename Answer>
void copyPress(const Contact& contact, Answer& c) {
  Eigen::Map<Eigen::Vector3d>(c.point) = contact.p_W;
  Eigen::Map<Eigen::Vector3d>(c.normal) = contact.nhat_W;
  c.gap = contact.gap;
  c.push = contact.push;
  c.slip_speed = contact.slipSpeed;
}

// What a tick says, written as the functions of the header that are named so have it.
[[nodiscard]] ft_status writeTick(const SolidTick& tick, ft_solid_tick* written);
[[nodiscard]] ft_status writeJoints(const SolidTick& tick, ft_solid_joint* joints,
                                    std::size_t capacity, std::size_t* required);
[[nodiscard]] ft_status writeContacts(const SolidTick& tick, const Scene& scene,
                                      ft_solid_contact* contacts, std::size_t capacity,
                                      std::size_t* required);
[[nodiscard]] ft_status writeWay(const SolidTick& tick, std::size_t index, double* time,
                                 double* rotations, double* translations, std::size_t capacity,
                                 std::size_t* required);

}  // namespace foretouch::c
