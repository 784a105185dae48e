// bindings/python/bindings.h: the parts of the module, each bound by its own source, in this order.
#pragma once

#include <pybind11/pybind11.h>

namespace foretouch::python {

void bindErrors(pybind11::module_& module);
void bindScene(pybind11::module_& module);
void bindAvatar(pybind11::module_& module);
void bindSurface(pybind11::module_& module);
void bindPairRules(pybind11::module_& module);
void bindClip(pybind11::module_& module);
void bindMotion(pybind11::module_& module);
void bindVerdict(pybind11::module_& module);
void bindContact(pybind11::module_& module);
void bindPairContact(pybind11::module_& module);
void bindAnswers(pybind11::module_& module);
void bindQuery(pybind11::module_& module);
void bindNear(pybind11::module_& module);
void bindPerson(pybind11::module_& module);
void bindSweep(pybind11::module_& module);
void bindSolid(pybind11::module_& module);
void bindWorld(pybind11::module_& module);
void bindSolidWorld(pybind11::module_& module);
void bindTriggers(pybind11::module_& module);
void bindAsk(pybind11::module_& module);
void bindFollower(pybind11::module_& module);
void bindRobots(pybind11::module_& module);

}  // namespace foretouch::python
