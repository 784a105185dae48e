// tools/settings/config_table.h: the keys of configurations as rows for docs/formats.md.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>

#include "tools/settings/settings.h"

namespace foretouch::tools {

/// A Markdown table of the keys of these tables, of the settings that `which` selects: default,
/// legal values and purpose.
[[nodiscard]] std::string configRows(const Settings& settings,
                                     std::initializer_list<const char*> tables,
                                     const std::function<bool(const Setting&)>& which);

}  // namespace foretouch::tools
