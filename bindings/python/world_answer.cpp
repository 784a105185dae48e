// bindings/python/world_answer.cpp: the answer of a world's window as plain data.
#include "bindings/python/int_enum.h"
#include "bindings/python/poses.h"
#include "bindings/python/world.h"
#include "lss/index.h"
#include "middleware/events/told_depth.h"

namespace foretouch::python {
namespace {

// Borrowed from the module, which lives as long as the interpreter.
PyObject* worldVerdictType = nullptr;

py::object numberOrNone(std::int32_t number) {
  if (number < 0) return py::none();
  return py::int_(number);
}

/// The object of a triangle of the scene or of a mesh.
py::object objectNameOf(const Scene& scene, TriangleId triangle) {
  if (triangle < 0) return py::none();
  return readable(scene.objectNames()[slotOf(scene.object(triangle))]);
}

py::object sideOf(const py::object& type, const ContactSide& side, const Scene* still,
                  const BodyShapes& shapes) {
  const Numbers place(3, side.p_W.data());
  if (side.body == kStillScene) {
    const py::object object = still == nullptr ? py::none() : objectNameOf(*still, side.triangle);
    return type(py::none(), py::none(), numberOrNone(side.link), numberOrNone(side.lss),
                numberOrNone(side.triangle), object, place);
  }
  const BodyShape& shape = shapes[slotOf(side.body)];
  const bool hasName = shape.avatar && side.link != kEveryLink;
  return type(side.body, hasName ? py::object(nameOf(*shape.avatar, side.link)) : py::none(),
              numberOrNone(side.link), numberOrNone(side.lss), numberOrNone(side.triangle),
              shape.mesh ? objectNameOf(*shape.mesh, side.triangle) : py::none(), place);
}

py::list contactList(const foretouch::WorldContacts& answer, const Scene* still,
                     const BodyShapes& shapes) {
  const py::object contactType = pythonType("WorldContact"), sideType = pythonType("ContactSide");
  py::list contacts;
  for (const WorldContact& c : answer.contacts) {
    const py::object reason =
        c.reason == UndecidedReason::None ? py::object(py::none()) : py::str(toString(c.reason));
    contacts.append(contactType(
        memberOf(worldVerdictType, c.verdict), reason, c.time.us, c.time.fraction,
        sideOf(sideType, c.a, still, shapes), sideOf(sideType, c.b, still, shapes), c.separation,
        depthOrNone(toldDepth(c)), Numbers(3, c.nhat_BA_W.data()), c.isAssumed));
  }
  return contacts;
}

py::dict countersOfWorld(const WorldCounters& counted) {
  py::dict counters;
  counters["bodies"] = counted.bodies;
  counters["pairs"] = counted.pairs;
  counters["near_pairs"] = counted.nearPairs;
  counters["spans"] = counted.spans;
  return counters;
}

}  // namespace

py::object sideToPython(const ContactSide& side, ObjectId object, const Scene* still,
                        const BodyShapes& shapes) {
  const py::object type = pythonType("ContactSide");
  if (side.body < kStillScene) {  // kEveryBody
    return type(side.body, py::none(), py::none(), py::none(), py::none(), py::none(),
                Numbers(3, side.p_W.data()));
  }
  const py::object named = sideOf(type, side, still, shapes);
  const Scene* const mesh = side.body == kStillScene ? still : shapes[slotOf(side.body)].mesh.get();
  if (side.triangle >= 0 || object < 0 || mesh == nullptr) return named;
  return named.attr("_replace")(py::arg("object") = readable(mesh->objectNames()[slotOf(object)]));
}

py::object toPython(const foretouch::WorldContacts& answer, const Scene* still,
                    const BodyShapes& shapes) {
  const py::object silentType = pythonType("SilentBody");
  py::list silent;
  for (const SilentBody& one : answer.silent) {
    silent.append(silentType(one.body, one.sinceUs, toString(one.takenTo)));
  }
  return pythonType("WorldContacts")(contactList(answer, still, shapes), silent,
                                     countersOfWorld(answer.counters));
}

void bindWorldAnswer(py::module_& module) {
  worldVerdictType = module.attr("Verdict").ptr();
}

}  // namespace foretouch::python
