// tools/inputs/example_folder.h: where the bundled scene, clip and avatar lie.
#pragma once

#include <string>

#include "articulated/result.h"

namespace foretouch::tools {

/// $FORETOUCH_EXAMPLES, else share/foretouch/examples beside the program's folder: so in the build
/// tree as after installation.
[[nodiscard]] Result<std::string> exampleFolder();

}  // namespace foretouch::tools
