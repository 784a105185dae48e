// tools/settings/solid_settings.h: how a solid avatar follows its tracked poses
// (middleware/solid/solid_avatar.h): for every command that shows one.
#pragma once

#include "middleware/solid/solid_options.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

/// Title in help (tools/settings/setting.h has the others).
inline constexpr char kSolidGroup[] = "Solid avatar";

/// Each setting is legal by itself. What depends on an avatar, its world or other settings
/// (`ignored`, `self`, `workBudget`) stays as it is.
struct SolidRequest {
  bool isAsked = false;
  SolidOptions options;
};

/// --solid, --solid-skin, --catch-up, --floor, --snap and --around; `request` outlives the
/// settings.
void addSolidSettings(Settings& settings, SolidRequest& request);

}  // namespace foretouch::tools
