// tools/inputs/file_roles.h: files that a command line names without an option: what each of them
// is, by its name and by what is in it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "assets/model/model.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

enum class FileRole : std::uint8_t {
  Scene,
  Avatar,
  Clip,     ///< A clip, an animated model, a table of joint positions, an event log.
  Body,     ///< A model with bones and without an animation.
  Robot,    ///< A URDF or an MJCF.
  Unknown,  ///< Also what cannot be read; whatever opens it says why.
};

/// The role by the name, and where that leaves it open by the content: for a model, whether bones
/// and animations are in it. Errors: a model that cannot be read.
[[nodiscard]] Result<FileRole> roleOfFile(const std::string& path);

/// Does it hold bones, or the spheres and capsules of a VRM avatar?
[[nodiscard]] bool holdsBody(const Model& model);

/// Is it a log of LCM events, by its first bytes or its ending?
[[nodiscard]] bool isEventLog(const std::string& path);

/// Files without an option, in any order: each becomes the value of --scene, --avatar, --motion or
/// --robot, as far as `settings` has them by now. A file of unknown role is a clip if no scene is
/// among these settings: so pipes are.
Setting& addFilesSetting(Settings& settings, std::vector<std::string>& files,
                         const char* help =
                             "The input files without their options, in any order; their names or "
                             "contents tell which is which");

}  // namespace foretouch::tools
