// tools/settings/config_reading.h: tables of a TOML file read into settings. Only for
// configuration: it includes toml++.
#pragma once

#include <functional>
#include <string>

#include "tools/settings/settings.h"
#include "tools/settings/toml_section.h"

namespace foretouch::tools {

/// A path in the file `from`, relative to that file's folder. Empty stays empty.
[[nodiscard]] std::string besideFile(const std::string& path, const std::string& from);

/// Whether to read a setting.
using WhichSettings = std::function<bool(const Setting&)>;

/// Reads the values of one table's keys into the settings that `which` selects.
void readTable(TomlSection& root, const char* table, TomlReading& reading, Settings& settings,
               const WhichSettings& which);
/// The same for all settings; refuses every key that is not one of theirs.
void readWholeTable(TomlSection& root, const char* table, TomlReading& reading, Settings& settings);

}  // namespace foretouch::tools
