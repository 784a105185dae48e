// bindings/python/importer_place.h: where foretouch-import is, for a module that runs in another
// program. In this order: the argument `importer`; the environment variable
// FORETOUCH_IMPORTER; the package's installation or build tree; the installation path configured at
// build time. The library's own rule, "beside the running program", would look beside the Python
// interpreter.
#pragma once

#include <pybind11/pybind11.h>
#include <string>

namespace foretouch::python {

/// For SceneImportOptions::importer: empty if the library should look itself.
[[nodiscard]] std::string importerPlace(pybind11::handle argument);

}  // namespace foretouch::python
