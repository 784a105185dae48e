#include "tools/settings/config_table.h"

#include <fmt/format.h>

#include "tools/settings/frame_settings.h"
#include "tools/settings/serve_settings.h"

namespace foretouch::tools {
namespace {

/// The setting's value as a configuration spells it.
std::string inToml(const Setting& setting) {
  if (!setting.mayBeEmpty && setting.shown().empty()) return "required";
  if (setting.shown() == kAsFileSays) return kAsFileSays;
  if (setting.kind == ValueKind::Flag) {
    return setting.words.empty() ? "`false`" : "`\"" + setting.shown() + "\"`";
  }
  const bool isNumber = setting.kind == ValueKind::Number && !setting.words.empty();
  if (isNumber && setting.json() == "null") return setting.shown();
  if (setting.kind == ValueKind::Text) return "`\"" + setting.shown() + "\"`";
  return "`" + setting.json() + "`";
}

std::string legalValues(const Setting& setting) {
  if (setting.kind == ValueKind::Number) return setting.legal;
  if (setting.kind == ValueKind::Flag && setting.words.empty()) return "true or false";
  if (!setting.words.empty()) {
    std::string text;
    for (const std::string& word : setting.words) {
      text += (text.empty() ? "`\"" : ", `\"") + word + "\"`";
    }
    return text;
  }
  if (setting.kind == ValueKind::List) return "texts";
  return setting.legal.empty() ? "a text" : setting.legal;
}

/// `|` ends a cell.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.insert(at, "\\");
  }
  return text;
}

}  // namespace

std::string configRows(const Settings& settings, std::initializer_list<const char*> tables,
                       const std::function<bool(const Setting&)>& which) {
  std::string text = "| key | option | default | legal | what it says |\n|---|---|---|---|---|\n";
  for (const char* const table : tables) {
    std::string title = fmt::format("`[{}]` ", table);
    for (const Setting& setting : settings) {
      if (setting.table != table || !which(setting)) continue;
      text += fmt::format("| {}`{}` | `{}` | {} | {} | {} |\n", title, setting.key, setting.option,
                          inToml(setting), cell(legalValues(setting)), cell(setting.help));
      title.clear();
    }
  }
  return text;
}

std::string configTable() {
  ServeConfig config;
  Settings settings;
  addServeSettings(settings, config);
  return configRows(settings, {"service", "scene", "query", "stream", "solid", "person"},
                    [](const Setting&) { return true; });
}

}  // namespace foretouch::tools
