// bindings/python/solid_tick.cpp: foretouch.SolidTick, SolidState and SolidJointState.
#include <array>
#include <cstdio>

#include "bindings/python/bindings.h"
#include "bindings/python/int_enum.h"
#include "bindings/python/poses.h"
#include "bindings/python/solid.h"
#include "lss/index.h"

namespace foretouch::python {
namespace {

// Borrowed from the module, which lives as long as the interpreter.
PyObject* solidStateType = nullptr;

/// A view of the tick that cannot be written to.
template <typename Element>
py::array viewOf(const Element* first, std::size_t count, const py::object& owner) {
  py::array array(py::dtype::of<Element>(), Shape{static_cast<py::ssize_t>(count)},
                  Shape{static_cast<py::ssize_t>(sizeof(Element))}, first, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

const foretouch::SolidTick& tickOf(const py::object& self) {
  return self.cast<const SolidTick&>().tick;
}

py::object jointsOf(const py::object& self) {
  static_assert(sizeof(SolidJointState) == 1);
  const auto& joints = tickOf(self).joints;
  return viewOf(reinterpret_cast<const std::uint8_t*>(joints.data()), joints.size(), self);
}

py::object linkDeviationOf(const py::object& self) {
  const auto& deviation = tickOf(self).linkDeviation;
  return viewOf(deviation.data(), deviation.size(), self);
}

py::object timesOf(const py::object& self) {
  return viewOf(tickOf(self).times.data(), tickOf(self).numWay, self);
}

py::object wayOf(const SolidTick& tick) {
  const auto& way = tick.tick.way;
  const auto end = way.begin() + static_cast<std::ptrdiff_t>(tick.tick.numWay);
  return toPython(std::vector<Pose>(way.begin(), end), countOf(tick.avatar->numLinks()));
}

py::object limitOf(const SolidTick& tick) {
  if (tick.tick.limit == SolidLimit::None) return py::none();
  return py::str(toString(tick.tick.limit));
}

py::object snapInOf(const SolidTick& tick) {
  if (tick.tick.snapInS < 0.0) return py::none();
  return py::float_(tick.tick.snapInS);
}

/// The scene's object, or None for an own link.
py::object objectOfSolid(const SolidTick& tick, const SolidContact& contact) {
  if (contact.triangle < 0) return py::none();
  return readable(tick.scene->objectNames()[slotOf(tick.scene->object(contact.triangle))]);
}

py::list contactsOf(const SolidTick& tick) {
  const py::object type = pythonType("SolidContact");
  py::list contacts;
  for (const SolidContact& c : tick.tick.contacts) {
    const bool isOfScene = c.triangle >= 0;
    contacts.append(
        type(nameOf(*tick.avatar, c.link), c.link, c.lss,
             isOfScene ? py::object(py::int_(c.triangle)) : py::none(), objectOfSolid(tick, c),
             isOfScene ? py::object(py::none()) : nameOf(*tick.avatar, c.other),
             Numbers(3, c.p_W.data()), Numbers(3, c.nhat_W.data()), c.gap, c.push, c.slipSpeed));
  }
  return contacts;
}

py::dict countersOf(const SolidTick& tick) {
  const SolidCounters& counted = tick.tick.counters;
  py::dict counters;
  counters["queries"] = counted.queries;
  counters["iterations"] = counted.iterations;
  counters["features"] = counted.features;
  counters["rows"] = counted.rows;
  counters["around_queries"] = counted.aroundQueries;
  counters["placing_queries"] = counted.placingQueries;
  counters["work"] = counted.work;
  return counters;
}

std::string textOfTick(const SolidTick& tick) {
  std::array<char, 96> numbers{};
  std::snprintf(numbers.data(), numbers.size(), ", %.3g mm off, %zu contacts%s>",
                1e3 * tick.tick.deviation, tick.tick.contacts.size(),
                tick.tick.isCertified ? "" : ", not certified");
  return std::string("<foretouch.SolidTick: ") + toString(tick.tick.state) + numbers.data();
}

}  // namespace

void bindSolidTick(py::module_& module) {
  solidStateType = addIntEnum(module, "SolidState", membersOf<SolidState>(kNumSolidStates));
  static_cast<void>(
      addIntEnum(module, "SolidJointState", membersOf<SolidJointState>(kNumSolidJointStates)));
  const auto field = [](auto member) {
    return [member](const SolidTick& tick) { return tick.tick.*member; };
  };
  py::class_<SolidTick>(module, "SolidTick",
                        "What a solid avatar shows at one tick, and why. Metres, world frame. The\n"
                        "arrays have one element a link; they are views and cannot be written to.")
      .def_property_readonly(
          "shown", [](const SolidTick& tick) { return toPython(tick.tick.shown); },
          "The Pose to draw.")
      .def_property_readonly(
          "state", [](const SolidTick& tick) { return memberOf(solidStateType, tick.tick.state); },
          "A SolidState.")
      .def_property_readonly("limit", &limitOf,
                             "Why it is not nearer, though surfaces let it: 'budget', 'catch-up' "
                             "or 'inside'; None.")
      .def_property_readonly("is_certified", field(&foretouch::SolidTick::isCertified),
                             "Whether nothing is touched on the whole way from the pose shown "
                             "before: proven.")
      .def_property_readonly(
          "has_appeared", field(&foretouch::SolidTick::hasAppeared),
          "Whether it appeared where its way begins: its first place, one after\n"
          "it was inside, or a snap. The only breaks of what is shown.")
      .def_property_readonly("deviation", field(&foretouch::SolidTick::deviation),
                             "Of shown from tracked, the largest of all links.")
      .def_property_readonly("lift", field(&foretouch::SolidTick::lift),
                             "How far the target was lifted.")
      .def_property_readonly(
          "clearance", field(&foretouch::SolidTick::clearance),
          "Lower bound on the separation on the whole way; infinite if it did not\n"
          "move, 0 if not certified.")
      .def_property_readonly("snap_in", &snapInOf,
                             "Seconds until it snaps, if nothing changes; None: it does not.")
      .def_property_readonly("joints", &jointsOf, "uint8, to be compared with SolidJointState.")
      .def_property_readonly("link_deviation", &linkDeviationOf)
      .def_property_readonly("contacts", &contactsOf,
                             "SolidContact: where surfaces hold it, by link, LSS and triangle.")
      .def_property_readonly("way", &wayOf,
                             "Poses: the way from the pose shown before, piece by piece; the last\n"
                             "is `shown`. Empty if it did not move.")
      .def_property_readonly("times", &timesOf,
                             "(k,), when each pose of the way is reached, in (0, 1] of the tick\n"
                             "(0: it appeared there).")
      .def_property_readonly("counters", &countersOf, "Work done, by kind.")
      .def("__repr__", &textOfTick);
}

}  // namespace foretouch::python
