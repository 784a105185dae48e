#include "tools/audit/avatar_command.h"

#include "tools/audit/avatar_check_command.h"
#include "tools/audit/avatar_make_command.h"
#include "tools/audit/avatar_pairs_command.h"

namespace foretouch::tools {

Command avatarCommand() {
  Command avatar{"avatar", "Make and check avatars"};
  for (const auto command : {avatarBvhCommand, avatarMeshCommand, avatarUrdfCommand,
                             avatarCheckCommand, avatarPairsCommand}) {
    avatar.commands.push_back(command());
  }
  return avatar;
}

}  // namespace foretouch::tools
