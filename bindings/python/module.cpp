// bindings/python/module.cpp: foretouch._foretouch, the compiled half of the package `foretouch`.
#include "bindings/python/bindings.h"

PYBIND11_MODULE(_foretouch, module) {
  using namespace foretouch::python;
  module.doc() = "The compiled half of foretouch: import foretouch instead.";
  module.attr("__version__") = FORETOUCH_VERSION;
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
  bindSweep(module);
}
