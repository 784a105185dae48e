#include "bindings/c/importer_place.h"

#include <dlfcn.h>
#include <filesystem>
#include <foretouch/foretouch.h>
#include <system_error>

namespace foretouch::c {

namespace fs = std::filesystem;

std::string importerNearLibrary() {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&ft_version), &library) == 0) return "";
  if (library.dli_fname == nullptr) return "";
  const fs::path folder = fs::path(library.dli_fname).parent_path();
  const fs::path installed = "libexec/foretouch/foretouch-import";
  // lib/, or lib/x86_64-linux-gnu/
  for (const fs::path& place :
       {folder / "foretouch-import", folder / ".." / installed, folder / "../.." / installed}) {
    std::error_code unknown;
    if (fs::is_regular_file(place, unknown)) return place.string();
  }
  return "";
}

}  // namespace foretouch::c
