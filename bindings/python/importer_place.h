// bindings/python/importer_place.h: where foretouch-import is, for a module that runs in somebody
// else's program. In this order: the argument `importer`; the environment variable
// FORETOUCH_IMPORTER; where the package's installation or build tree has it; where it was to be
// installed when this was built. The library's own rule, "beside the running program", would look
// beside the Python interpreter.
#pragma once

#include <pybind11/pybind11.h>
#include <string>

namespace foretouch::python {

/// For SceneImportOptions::importer: empty where the library is to look itself.
[[nodiscard]] std::string importerPlace(pybind11::handle argument);

}  // namespace foretouch::python
