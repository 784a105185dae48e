// bindings/python/triggers.cpp: foretouch.Triggers.
#include "middleware/triggers/triggers.h"

#include <array>
#include <limits>
#include <memory>
#include <utility>

#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"
#include "bindings/python/query_options.h"
#include "bindings/python/world.h"
#include "middleware/events/world_follower.h"
#include "middleware/triggers/volume_parts.h"

namespace foretouch::python {
namespace {

std::int32_t smallNumber(py::handle given, const char* what) {
  using Limits = std::numeric_limits<std::int32_t>;
  return static_cast<std::int32_t>(integer(given, what, Limits::min(), Limits::max()));
}

std::int64_t triggerInstant(py::handle given, const char* what) {
  return integer(given, what, -kMostUtimeUs, kMostUtimeUs);
}

template <typename T>
T triggerValue(Result<T> result) {
  if (!result.ok()) throw Failure(result.error());
  return std::move(result).value();
}

/// What the body of a trigger is made of, for those who ask the world about it.
BodyShape shapeOf(const TriggerVolume& volume) {
  const auto& parts = volume.parts();
  if (parts.solid) return {std::make_shared<const Avatar>(*parts.solid), nullptr};
  return {nullptr, std::make_shared<const Scene>(parts.mesh->scene())};
}

/// Volumes of one world, and the follower that they listen to.
class TriggersOf {
 public:
  TriggersOf(World& world, const Shown<shown::Integer>& fromUs)
      : world_(world),
        follower_(triggerValue(WorldFollower::start(triggerInstant(fromUs, "from_us")))) {}

  TriggerId add(const TriggerVolume& volume, const Shown<shown::Integer>& group,
                const Shown<shown::Truth>& byLink) {
    TriggerOptions options;
    options.group = smallNumber(group, "group");
    options.byLink = boolean(byLink, "by_link");
    TriggerId trigger = -1;
    world_.addWith(shapeOf(volume), [&](foretouch::World& world) -> Result<BodyId> {
      auto added = triggers_.add(world, volume, options);
      if (!added.ok()) return added.error();
      trigger = added.value();
      return triggers_.body(trigger);
    });
    return trigger;
  }

  void stand(TriggerId trigger, std::int64_t fromUs, const RigidPose& pose) {
    world_.with("trigger", [&](foretouch::World& world) {
      return triggers_.stand(world, trigger, fromUs, pose);
    });
  }

  void watch(TriggerId trigger, const Watched& watched) {
    world_.with("trigger",
                [&](foretouch::World& world) { return triggers_.watch(world, trigger, watched); });
  }

  [[nodiscard]] BodyId body(TriggerId trigger) const {
    if (trigger >= 0 && trigger < triggers_.numTriggers()) return triggers_.body(trigger);
    refuse(ErrorCode::UnknownName, "trigger",
           "expected one of " + std::to_string(triggers_.numTriggers()) + ", found " +
               std::to_string(trigger),
           trigger);
  }

  [[nodiscard]] py::list follow(std::int64_t untilUs) {
    world_.with("until_us", [&](foretouch::World& world) -> Result<Done> {
      auto followed = follower_.follow(world, untilUs, answer_);
      if (!followed.ok()) return followed;
      return triggers_.update(world, answer_, told_);
    });
    const py::object type = pythonType("TriggerEvent");
    py::list events;
    for (const TriggerEvent& e : told_.events) {
      events.append(type(toString(e.kind), e.trigger, e.body, linkOrNone(e.link), e.time.us,
                         e.time.fraction, e.since.us, e.since.fraction, e.isAssumed));
    }
    return events;
  }

  [[nodiscard]] py::list occupants() const {
    const py::object type = pythonType("Occupant");
    py::list all;
    for (const Occupant& o : triggers_.occupants()) {
      all.append(type(o.trigger, o.body, linkOrNone(o.link), o.isUnresolved, o.since.us,
                      o.since.fraction));
    }
    return all;
  }

 private:
  static py::object linkOrNone(LinkId link) {
    if (link == kEveryLink) return py::none();
    return py::int_(link);
  }

  World& world_;
  WorldFollower follower_;
  Triggers triggers_;
  WorldEvents answer_;
  TriggerEvents told_;
};

TriggerId addBox(TriggersOf& triggers, const Shown<shown::Array>& halfExtents,
                 const Shown<shown::Integer>& group, const Shown<shown::Truth>& byLink) {
  const auto half = point(halfExtents, "half_extents");
  return triggers.add(triggerValue(TriggerVolume::box(half)), group, byLink);
}

TriggerId addSphere(TriggersOf& triggers, const Shown<shown::Number>& radius,
                    const Shown<shown::Integer>& group, const Shown<shown::Truth>& byLink) {
  return triggers.add(triggerValue(TriggerVolume::sphere(number(radius, "radius"))), group, byLink);
}

TriggerId addMesh(TriggersOf& triggers, const Scene& closed, const Shown<shown::Integer>& group,
                  const Shown<shown::Truth>& byLink) {
  return triggers.add(triggerValue(TriggerVolume::mesh(closed)), group, byLink);
}

void stand(TriggersOf& triggers, const Shown<shown::Integer>& trigger,
           const Shown<shown::Integer>& fromUs, const Shown<shown::Array>& translation) {
  triggers.stand(smallNumber(trigger, "trigger"), triggerInstant(fromUs, "from_us"),
                 {Quaternion::Identity(), point(translation, "translation")});
}

void watch(TriggersOf& triggers, const Shown<shown::Integer>& trigger,
           const Shown<shown::Integer>& body, const py::object& link) {
  const LinkId which = link.is_none() ? kEveryLink : smallNumber(link, "link");
  triggers.watch(smallNumber(trigger, "trigger"), {smallNumber(body, "body"), which});
}

/// None: every link, as of what has none.
LinkId linkOfBody(World& world, BodyId body, const py::object& link, const char* what) {
  if (link.is_none()) return kEveryLink;
  const BodyShape shape = body >= 0 ? world.shape(body) : BodyShape{};
  if (shape.avatar) return linkOf(*shape.avatar, link, what);
  refuse(ErrorCode::Mismatch, what, "expected None: the body has no links of its own");
}

py::object depthIn(World& world, const Shown<shown::Integer>& utimeUs,
                   const Shown<shown::Integer>& body, const py::object& other,
                   const py::object& link, const py::object& otherLink) {
  DepthQuestion question;
  question.a = smallNumber(body, "body");
  question.b = other.is_none() ? kStillScene : smallNumber(other, "other");
  question.linkOfA = linkOfBody(world, question.a, link, "link");
  question.linkOfB = linkOfBody(world, question.b, otherLink, "other_link");
  const WorldTime time{triggerInstant(utimeUs, "utime_us"), 0.0};
  WorldDepth found;
  Scratch scratch;
  world.with("depth", [&](foretouch::World& of) -> Result<Done> {
    auto asked = of.depth(time, question, scratch);
    if (!asked.ok()) return asked.error();
    found = asked.value();
    return Done{};
  });
  const Depth& depth = found.depth;
  return pythonType("Depth")(depth.lower, depth.upper, Numbers(3, depth.wayOut.data()),
                             depth.isCertified, depth.numPairs, found.isAssumed);
}

}  // namespace

void bindTriggers(py::module_& module) {
  module.attr("World").attr("depth") = py::cpp_function(
      &depthIn, py::name("depth"), py::is_method(module.attr("World")), py::arg("utime_us"),
      py::arg("body"), py::arg("other") = py::none(), py::kw_only(), py::arg("link") = py::none(),
      py::arg("other_link") = py::none(),
      "How deep a body is in another (None: in what stands still) at an instant: Depth. link,\n"
      "other_link: of avatars, one of their links alone.");
  const auto group = py::arg("group") = kTriggerGroup;
  const auto byLink = py::arg("by_link") = false;
  py::class_<TriggersOf>(
      module, "Triggers",
      "Volumes of a world that tell who is in them, from an instant on. Each is a body of the\n"
      "world: stand() puts it somewhere, or World.push() and attach() move body(trigger).")
      .def(py::init<World&, const Shown<shown::Integer>&>(), py::arg("world"), py::arg("from_us"),
           py::keep_alive<1, 2>())
      .def("add_box", &addBox, py::arg("half_extents"), py::kw_only(), group, byLink,
           "A box around the origin of its frame. by_link: each link enters by itself.")
      .def("add_sphere", &addSphere, py::arg("radius"), py::kw_only(), group, byLink)
      .def("add_mesh", &addMesh, py::arg("closed"), py::kw_only(), group, byLink,
           "What is inside some object of a Scene, each of which must be closed.")
      .def(
          "body",
          [](const TriggersOf& triggers, const Shown<shown::Integer>& trigger) {
            return triggers.body(smallNumber(trigger, "trigger"));
          },
          py::arg("trigger"), "The trigger's body in the world.")
      .def("stand", &stand, py::arg("trigger"), py::arg("from_us"), py::arg("translation"),
           "Puts one that has no pose where it stays, not turned.")
      .def("watch", &watch, py::arg("trigger"), py::arg("body"), py::arg("link") = py::none(),
           "Looks at this body, or this link of it by its number, and no more at everybody.")
      .def(
          "follow",
          [](TriggersOf& triggers, const Shown<shown::Integer>& untilUs) {
            return triggers.follow(triggerInstant(untilUs, "until_us"));
          },
          py::arg("until_us"),
          "Who entered and left from where the last call ended until then: TriggerEvents.")
      .def_property_readonly("occupants", &TriggersOf::occupants,
                             "Who is inside, or may be, where the last follow() ended.");
}

}  // namespace foretouch::python
