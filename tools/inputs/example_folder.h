// tools/inputs/example_folder.h: the folder of the bundled scene, clip and avatar.
#pragma once

#include <string>

#include "articulated/result.h"

namespace foretouch::tools {

/// $FORETOUCH_EXAMPLES, else share/foretouch/examples beside the program's folder, both in the
/// build tree and after installation.
[[nodiscard]] Result<std::string> exampleFolder();

}  // namespace foretouch::tools
