#include "tools/inputs/example_folder.h"

#include <cstdlib>
#include <filesystem>

namespace foretouch::tools {

Result<std::string> exampleFolder() {
  namespace fs = std::filesystem;
  std::error_code failure;
  fs::path folder;
  if (const char* const named = std::getenv("FORETOUCH_EXAMPLES"); named != nullptr) {
    folder = named;
  } else {
    const fs::path program = fs::read_symlink("/proc/self/exe", failure);
    folder = program.parent_path().parent_path() / "share" / "foretouch" / "examples";
  }
  if (fs::is_regular_file(folder / "room.obj", failure)) return folder.string();
  return Error::in(folder.string(), ErrorCode::FileNotFound,
                   "holds no room.obj; expected the bundled example there, or its folder in the "
                   "environment variable FORETOUCH_EXAMPLES");
}

}  // namespace foretouch::tools
