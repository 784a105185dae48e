#include "tools/audit/avatar_command.h"

#include "tools/audit/avatar_check_command.h"
#include "tools/audit/avatar_make_command.h"

namespace foretouch::tools {

Command avatarCommand() {
  Command avatar{"avatar", "Make and check avatars"};
  for (const auto command :
       {avatarBvhCommand, avatarMeshCommand, avatarUrdfCommand, avatarCheckCommand}) {
    avatar.commands.push_back(command());
  }
  return avatar;
}

}  // namespace foretouch::tools
