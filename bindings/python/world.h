// bindings/python/world.h: a moving world, and the answer of one window of it.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "articulated/avatar.h"
#include "bindings/python/arguments.h"
#include "middleware/depth/depth.h"
#include "middleware/events/world_event.h"
#include "middleware/scene/scene.h"
#include "middleware/world/world.h"

namespace foretouch::python {

/// What a body is made of: an avatar or a mesh.
struct BodyShape {
  std::shared_ptr<const Avatar> avatar;
  std::shared_ptr<const Scene> mesh;
};
using BodyShapes = std::vector<BodyShape>;

/// Threads may call one, and wait for one another. Callers hold the GIL; the methods release it
/// while they work.
class World {
 public:
  /// Throws if the library refuses the options.
  World(std::shared_ptr<const Scene> still, const WorldOptions& options);
  /// A world of another owner, which outlives this one.
  World(std::shared_ptr<const Scene> still, const WorldOptions& options, foretouch::World& world);

  BodyId add(BodyShape shape, const BodyOptions& options);
  void push(BodyId body, std::int64_t utimeUs, const Pose& pose);
  void attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs, const Pose& pose);
  void detach(BodyId body, std::int64_t utimeUs, const Pose& pose);
  void ask(BodyGroup a, BodyGroup b, bool isAsked);
  void askStill(BodyGroup group, bool isAsked);
  void forgetBefore(std::int64_t utimeUs);
  std::int64_t forgetBeyond(std::size_t bytes);
  void thinBefore(std::int64_t utimeUs, double metres);
  std::size_t poseBytes();
  [[nodiscard]] std::optional<std::int64_t> knownUntilUs();
  [[nodiscard]] std::optional<BodyId> waitsFor();
  [[nodiscard]] foretouch::WorldContacts contacts(std::int64_t fromUs, std::int64_t toUs);

  /// Calls a function of the library's world without the GIL, and with no other thread in it.
  void with(const char* place, const std::function<Result<Done>(foretouch::World&)>& call);
  /// The same for one that adds a body of this shape.
  BodyId addWith(BodyShape shape, const std::function<Result<BodyId>(foretouch::World&)>& call);

  /// Null: nothing stands still.
  [[nodiscard]] const std::shared_ptr<const Scene>& still() const { return still_; }
  [[nodiscard]] double tolerance() const { return tolerance_; }
  /// The shapes of all bodies so far.
  [[nodiscard]] std::shared_ptr<const BodyShapes> shapes();
  /// Throws if the body is unknown.
  [[nodiscard]] BodyShape shape(BodyId body);

 private:
  /// Calls a function of `world_` without the GIL; its errors name `place` if they name nothing.
  template <typename Call>
  auto change(const char* place, const Call& call);

  std::shared_ptr<const Scene> still_;
  double tolerance_;
  std::mutex mutex_;  // never waited for with the GIL held
  std::optional<foretouch::World> own_;
  foretouch::World& world_;
  std::shared_ptr<const BodyShapes> shapes_ = std::make_shared<BodyShapes>();
  Scratch scratch_;
  bool isScratchSuspect_ = false;  // memory ran out half-way
};

/// A window's answer as Python sees it: foretouch.WorldContacts.
[[nodiscard]] py::object toPython(const foretouch::WorldContacts& answer, const Scene* still,
                                  const BodyShapes& shapes);
/// None: it is not known (kUnknownDepth).
[[nodiscard]] inline py::object depthOrNone(double depth) {
  return std::isnan(depth) ? py::object(py::none()) : py::float_(depth);
}
/// One side of an event of a world: foretouch.ContactSide. `object`: the event's; it counts where
/// no triangle says which it is.
[[nodiscard]] py::object sideToPython(const ContactSide& side, ObjectId object, const Scene* still,
                                      const BodyShapes& shapes);
/// What was reported of a world: foretouch.WorldEvents.
[[nodiscard]] py::object toPython(const WorldEvents& events, World& world);

/// The keywords of a world, and of what a body does when it is silent.
[[nodiscard]] WorldOptions worldOptionsFrom(const py::object& tolerance,
                                            const py::object& askMeshes,
                                            const py::object& workPerPair,
                                            const py::object& workPerWindow,
                                            const py::object& mostNear);
[[nodiscard]] WhenSilent whenSilentFrom(const py::object& given);
[[nodiscard]] std::int32_t smallInteger(py::handle given, const char* what);
[[nodiscard]] std::int64_t instantFrom(py::handle given, const char* what);

/// Borrows the classes that answers are made of from the module.
void bindWorldAnswer(py::module_& module);

}  // namespace foretouch::python
