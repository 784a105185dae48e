// bindings/python/solid_world.cpp: foretouch.SolidWorld.
#include "middleware/solid_world/solid_world.h"

#include <array>
#include <memory>
#include <new>
#include <pybind11/stl.h>
#include <utility>

#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"
#include "bindings/python/solid.h"
#include "bindings/python/world.h"
#include "lss/index.h"

namespace foretouch::python {
namespace {

constexpr std::array<std::pair<const char*, SolidReach>, 2> kReaches{
    {{"skin", SolidReach::Skin}, {"surface", SolidReach::Surface}}};

foretouch::SolidWorld built(const Scene& still, std::int64_t beginUs, const WorldOptions& options,
                            SolidReach reach) {
  auto made = foretouch::SolidWorld::build(still, beginUs, options, reach);
  if (!made.ok()) throw Failure(withKeywordsOfSolid(made.error()));
  return std::move(made).value();
}

/// Targets, with what they point to.
struct Targets {
  std::vector<Pose> poses;
  std::vector<std::vector<std::uint8_t>> tracked;
  std::vector<SolidBodyTarget> targets;
};

class SolidWorld {
 public:
  SolidWorld(std::shared_ptr<Scene> still, std::int64_t beginUs, const WorldOptions& options,
             SolidReach reach)
      : still_(std::move(still)),
        solids_(built(*still_, beginUs, options, reach)),
        world_(still_, options, solids_.world()) {}

  BodyId add(const std::shared_ptr<Avatar>& avatar, const SolidOptions& options,
             const BodyOptions& body) {
    return world_.addWith({avatar, nullptr}, [&](foretouch::World&) -> Result<BodyId> {
      auto added = solids_.add(*avatar, options, body);
      if (!added.ok()) return withKeywordsOfSolid(added.error());
      return added;
    });
  }

  std::vector<SolidBodyTick> tick(std::int64_t utimeUs, const Targets& targets) {
    std::vector<SolidBodyTick> ticks;
    world_.with("target", [&](foretouch::World&) {
      if (isBroken_) throw std::bad_alloc();  // an earlier tick ended half-way
      isBroken_ = true;
      auto done = solids_.tick(utimeUs, targets.targets, ticks);
      isBroken_ = false;
      return done;
    });
    return ticks;
  }

  py::object follow() {
    WorldEvents told;
    world_.with("follow", [&](foretouch::World&) { return solids_.follow(told); });
    return toPython(told, world_);
  }

  std::int64_t utimeUs() {
    std::int64_t us = 0;
    world_.with("", [&](foretouch::World&) -> Result<Done> {
      us = solids_.utimeUs();
      return Done{};
    });
    return us;
  }
  [[nodiscard]] World& world() { return world_; }
  [[nodiscard]] const std::shared_ptr<Scene>& still() const { return still_; }

 private:
  std::shared_ptr<Scene> still_;
  foretouch::SolidWorld solids_;
  World world_;
  bool isBroken_ = false;
};

std::unique_ptr<SolidWorld> create(std::shared_ptr<Scene> still,
                                   const Shown<shown::Integer>& beginUs,
                                   const Shown<shown::Text>& reach,
                                   const Shown<shown::Number>& tolerance,
                                   const Shown<shown::Integer>& workPerPair,
                                   const Shown<shown::Integer>& workPerWindow,
                                   const Shown<shown::Integer>& mostNear) {
  const auto options =
      worldOptionsFrom(tolerance, py::bool_(false), workPerPair, workPerWindow, mostNear);
  return std::make_unique<SolidWorld>(std::move(still), instantFrom(beginUs, "begin_us"), options,
                                      oneOf(reach, "reach", kReaches));
}

BodyId addSolid(SolidWorld& world, const std::shared_ptr<Avatar>& avatar,
                const Shown<shown::Integer>& group, const Shown<shown::Text>& whenSilent,
                const py::kwargs& options) {
  BodyOptions body;
  body.group = smallInteger(group, "group");
  body.whenSilent = whenSilentFrom(whenSilent);
  const auto solid = solidOptionsFrom(solidKeywords(options), *avatar, *world.still());
  return world.add(avatar, solid, body);
}

Targets targetsFrom(World& world, const py::object& poses, const py::object& isTracked) {
  const py::dict given = mapping(poses, "targets");
  const py::dict flags = isTracked.is_none() ? py::dict() : mapping(isTracked, "is_tracked");
  Targets all;
  all.poses.reserve(given.size());  // their places stay
  all.tracked.reserve(given.size());
  for (const auto& [key, value] : given) {
    const BodyId body = smallInteger(key, "targets");
    const auto avatar = world.shape(body).avatar;
    if (!avatar) refuse(ErrorCode::Mismatch, "targets", "expected solid avatars", body);
    all.poses.push_back(poseFrom(avatar->skeleton(), py::reinterpret_borrow<py::object>(value),
                                 "targets[" + std::to_string(body) + "]"));
    SolidBodyTarget target{body, &all.poses.back(), nullptr};
    if (flags.contains(key)) {
      all.tracked.push_back(flagsFrom(flags[key], *avatar));
      if (!all.tracked.back().empty()) target.isTracked = &all.tracked.back();
    }
    all.targets.push_back(target);
  }
  for (const auto& [key, value] : flags) {
    if (!given.contains(key)) {
      refuse(ErrorCode::Mismatch, "is_tracked", "expected bodies that have a target");
    }
  }
  return all;
}

/// The mesh's object, or None.
py::object objectOf(const BodyShape& shape, const SolidBodyContact& contact) {
  if (contact.triangle < 0 || !shape.mesh) return py::none();
  return readable(shape.mesh->objectNames()[slotOf(shape.mesh->object(contact.triangle))]);
}

py::object tickToPython(SolidBodyTick&& tick, const std::shared_ptr<Scene>& still,
                        const BodyShapes& shapes) {
  const auto& avatar = shapes[slotOf(tick.body)].avatar;
  const py::object contactType = pythonType("SolidBodyContact");
  const py::object crushType = pythonType("SolidCrush");
  py::list contacts, crushes;
  for (const SolidBodyContact& c : tick.contacts) {
    contacts.append(
        contactType(c.body, nameOf(*avatar, c.link), c.link, c.lss,
                    c.triangle < 0 ? py::object(py::none()) : py::object(py::int_(c.triangle)),
                    objectOf(shapes[slotOf(c.body)], c), Numbers(3, c.p_W.data()),
                    Numbers(3, c.nhat_W.data()), c.gap, c.push, c.slipSpeed));
  }
  for (const SolidCrush& c : tick.crushes) {
    crushes.append(
        crushType(c.body, nameOf(*avatar, c.link), c.link, c.sinceUs, c.isOver, c.depth));
  }
  return pythonType("SolidBodyTick")(
      tick.body, SolidTick{avatar, still, std::move(tick.tick)}, contacts, crushes,
      py::cast(tick.tools), py::cast(tick.looseTools), py::cast(tick.letGo), tick.isAssumed);
}

py::dict tickTo(SolidWorld& world, const Shown<shown::Integer>& utimeUs,
                const Shown<shown::Mapping>& targets, const Shown<shown::Mapping>& isTracked) {
  auto ticks =
      world.tick(instantFrom(utimeUs, "utime_us"), targetsFrom(world.world(), targets, isTracked));
  const auto shapes = world.world().shapes();
  py::dict all;
  for (SolidBodyTick& tick : ticks) {
    const BodyId body = tick.body;
    all[py::int_(body)] = tickToPython(std::move(tick), world.still(), *shapes);
  }
  return all;
}

}  // namespace

void bindSolidWorld(py::module_& module) {
  const WorldOptions usual;
  py::class_<SolidWorld>(
      module, "SolidWorld",
      "Solid avatars in a world in which other things move: doors push them, what they hold is\n"
      "solid with them, two of them meet and neither passes. What a shown body presses against\n"
      "is told from enter to leave. Threads that call one wait for one another.")
      .def(py::init(&create), py::arg("still").none(false), py::arg("begin_us"), py::kw_only(),
           py::arg("reach") = "skin", py::arg("tolerance") = usual.tolerance,
           py::arg("work_per_pair") = usual.workPerPair, py::arg("work_per_window") = py::none(),
           py::arg("most_near") = py::none(),
           "The first tick begins at begin_us. reach: solid avatars are found in contact with\n"
           "what they press against ('skin'), or with what crushes them alone ('surface'). The\n"
           "others: as of World.")
      .def("add", &addSolid, py::arg("avatar").none(false), py::kw_only(), py::arg("group") = 0,
           py::arg("when_silent") = toString(WhenSilent::Wait),
           "A solid avatar, by its number; it is there from its first target on. group,\n"
           "when_silent: as of World.add(). options: the keywords of SolidAvatar.")
      .def("tick", &tickTo, py::arg("utime_us"), py::arg("targets"),
           py::arg("is_tracked") = py::none(),
           "One tick, from the last one's end to utime_us. targets: {body: Pose}; whoever has\n"
           "none keeps his last one. is_tracked: {body: (n,)}, as of SolidAvatar.follow().\n"
           "Returns {body: SolidBodyTick} of all that have had a target.")
      .def("follow", &SolidWorld::follow,
           "What has happened from where the last call ended until the last tick's end:\n"
           "WorldEvents. Before World.forget_before().")
      .def_property_readonly("utime", &SolidWorld::utimeUs, "Where the last tick ended (us).")
      .def_property_readonly("world", &SolidWorld::world,
                             py::return_value_policy::reference_internal,
                             "The World: add what moves by itself, push its poses, attach what\n"
                             "hands hold. Solid avatars are moved by tick() alone.")
      .def_property_readonly("still", &SolidWorld::still);
}

}  // namespace foretouch::python
