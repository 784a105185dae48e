// tests/bindings/moving_world.h: a moving world in C++ and in C, told the same.
#pragma once

#include <cstdint>
#include <foretouch/world.h>
#include <memory>
#include <vector>

#include "middleware/world/world.h"
#include "tests/bindings/c_world.h"

namespace foretouch::test {

struct ReleaseWorld {
  void operator()(ft_world* world) const { ft_world_destroy(world); }
};
using WorldHandle = std::unique_ptr<ft_world, ReleaseWorld>;

/// Fails the test if it cannot be made.
[[nodiscard]] WorldHandle makeWorld(const SceneHandle& still = nullptr,
                                    const ft_world_options* options = nullptr);

/// The last window's contacts, of C.
[[nodiscard]] std::vector<ft_world_contact> contactsOf(const ft_world* world);
[[nodiscard]] std::vector<ft_silent_body> silentOf(const ft_world* world);

class MovingWorld {
 public:
  explicit MovingWorld(double tolerance = 1e-3, const RawScene* still = nullptr,
                       bool asksMeshes = false, const WorldOptions& work = {});  // its budgets

  /// `asksSelf`: own links as well, by the derived rules. A surface is given in C as well.
  BodyId add(const Avatar& avatar, BodyOptions options = {}, bool asksSelf = false);
  BodyId add(const RawScene& mesh, const BodyOptions& options = {});
  void push(BodyId body, std::int64_t utimeUs, const Pose& pose);
  void push(BodyId body, std::int64_t utimeUs, const RigidPose& pose);
  void attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs, const RigidPose& pose);
  void detach(BodyId body, std::int64_t utimeUs, const RigidPose& pose);
  void ask(BodyGroup a, BodyGroup b, bool isAsked);
  void askStill(BodyGroup group, bool isAsked);
  void forgetBefore(std::int64_t utimeUs);

  /// Asks both, and expects the same of all that they say.
  void answer(std::int64_t fromUs, std::int64_t toUs);

  World cxx;
  WorldContacts answerOfCxx;
  WorldHandle c;

 private:
  void expectSameContacts() const;
  void expectSameSilent() const;
  void expectSameCounters() const;
  [[nodiscard]] std::int32_t objectOf(const ContactSide& side) const;

  std::optional<Scene> still_;
  std::vector<std::optional<Scene>> meshes_;  // per body
  Scratch scratch_;
};

/// A panel from (0, 0, 0) to (0.9, 2, 0), in the frame of its hinge: a door of two objects, the
/// lower triangle and the upper one.
[[nodiscard]] RawScene doorScene();
/// Turned about the hinge, which stands at `place`.
[[nodiscard]] RigidPose doorPose(double angle, const Eigen::Vector3d& place);

}  // namespace foretouch::test
