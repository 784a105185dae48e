// bindings/python/module.cpp: foretouch._foretouch, the compiled half of the package `foretouch`.
#include "bindings/python/bindings.h"

PYBIND11_MODULE(_foretouch, module) {
  using namespace foretouch::python;
  namespace py = pybind11;
  module.doc() = "The compiled half of foretouch: import foretouch instead.";
  module.attr("__version__") = FORETOUCH_VERSION;
  // Where people find the classes, and help() says they are.
  module.attr("__module__") = "foretouch";
  bindErrors(module);
  bindScene(module);
  bindAvatar(module);
  bindSurface(module);
  bindPairRules(module);
  bindClip(module);
  bindMotion(module);
  bindVerdict(module);
  bindContact(module);
  bindPairContact(module);
  bindAnswers(module);
  bindQuery(module);
  bindNear(module);
  bindPerson(module);
  bindSweep(module);
  bindSolid(module);
  bindWorld(module);
  bindSolidWorld(module);
  bindTriggers(module);
  bindAsk(module);
  bindFollower(module);
  bindRobots(module);
  py::delattr(module, "__module__");
}
