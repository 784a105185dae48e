#include "bindings/python/importer_place.h"

#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <system_error>

#include "bindings/python/arguments.h"

namespace foretouch::python {
namespace {

namespace fs = std::filesystem;

/// The folder of the package that this code was loaded from.
fs::path packageFolder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&packageFolder), &info) == 0 || info.dli_fname == nullptr) {
    return {};
  }
  std::error_code failure;
  const fs::path module = fs::canonical(info.dli_fname, failure);
  return failure ? fs::path() : module.parent_path();
}

}  // namespace

std::string importerPlace(py::handle argument) {
  if (!argument.is_none()) return path(argument, "importer");
  const char* const named = std::getenv("FORETOUCH_IMPORTER");
  const fs::path folder = packageFolder();
  if ((named != nullptr && *named != '\0') || folder.empty()) return "";
  // The first is a wheel's, which has all of an installation inside.
  for (const char* place :
       {"_installed/libexec/foretouch/foretouch-import", FORETOUCH_INSTALLED_IMPORTER_FROM_PACKAGE,
        FORETOUCH_BUILT_IMPORTER_FROM_PACKAGE}) {
    std::error_code failure;
    const fs::path importer = (folder / place).lexically_normal();
    if (fs::is_regular_file(importer, failure)) return importer.string();
  }
  return "";
}

}  // namespace foretouch::python
