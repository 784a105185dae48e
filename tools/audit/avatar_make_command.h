// tools/audit/avatar_make_command.h: `foretouch avatar bvh`, `mesh` and `urdf`.
#pragma once

#include "tools/console.h"

namespace CLI {
class App;
}  // namespace CLI

namespace foretouch::tools {

void addAvatarBvhCommand(CLI::App& avatar, ExitCode& exit);
void addAvatarMeshCommand(CLI::App& avatar, ExitCode& exit);
void addAvatarUrdfCommand(CLI::App& avatar, ExitCode& exit);

}  // namespace foretouch::tools
