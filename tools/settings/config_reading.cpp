#include "tools/settings/config_reading.h"

#include <filesystem>
#include <vector>

#include "assets/bounds/bound_presets.h"

namespace foretouch::tools {

std::string besideFile(const std::string& path, const std::string& from) {
  if (path.empty() || path.rfind(kBoundPresetPrefix, 0) == 0) return path;
  return (std::filesystem::path(from).parent_path() / path).string();
}

void readTable(TomlSection& root, const char* table, TomlReading& reading, Settings& settings,
               const WhichSettings& which) {
  TomlSection section = root.table(table);
  for (Setting& setting : settings) {
    if (setting.table != table || !which(setting)) continue;
    section.read(setting, [&](const std::string& path) { return besideFile(path, reading.file); });
  }
}

void readWholeTable(TomlSection& root, const char* table, TomlReading& reading,
                    Settings& settings) {
  std::vector<std::string> keys;
  for (const Setting& setting : settings) {
    if (setting.table == table) keys.push_back(setting.key);
  }
  root.table(table).allowOnly(keys);
  readTable(root, table, reading, settings, [](const Setting&) { return true; });
}

}  // namespace foretouch::tools
