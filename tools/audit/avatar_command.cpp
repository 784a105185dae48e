#include "tools/audit/avatar_command.h"

#include <CLI/CLI.hpp>

#include "tools/audit/avatar_check_command.h"
#include "tools/audit/avatar_make_command.h"

namespace foretouch::tools {

void addAvatarCommand(CLI::App& program, ExitCode& exit) {
  CLI::App* const avatar = program.add_subcommand("avatar", "Make and check avatars");
  avatar->require_subcommand(1);
  addAvatarBvhCommand(*avatar, exit);
  addAvatarMeshCommand(*avatar, exit);
  addAvatarUrdfCommand(*avatar, exit);
  addAvatarCheckCommand(*avatar, exit);
}

}  // namespace foretouch::tools
