#include "tools/setup/check_list.h"

#include <fmt/format.h>

namespace foretouch::tools {

const char* toString(CheckState state) {
  switch (state) {
    case CheckState::Good: return "good";
    case CheckState::Doubt: return "doubt";
    case CheckState::Bad: return "bad";
  }
  return "?";
}

std::string describe(const std::vector<PlacementCheck>& checks) {
  std::string text;
  for (const PlacementCheck& check : checks) {
    const char* const mark = check.state == CheckState::Good    ? "ok"
                             : check.state == CheckState::Doubt ? "?"
                                                                : "WRONG";
    text += fmt::format("  {:<6}{:<14}{}\n", mark, check.name, check.text);
    if (!check.tryThis.empty()) text += fmt::format("  {:<20}try {}\n", "", check.tryThis);
  }
  return text;
}

void writeChecks(const std::vector<PlacementCheck>& checks, JsonWriter& out) {
  out.beginArray();
  for (const PlacementCheck& check : checks) {
    out.beginObject();
    out.field("name", check.name);
    out.field("state", toString(check.state));
    out.field("text", check.text);
    if (!check.tryThis.empty()) out.field("try", check.tryThis);
    out.endObject();
  }
  out.endArray();
}

}  // namespace foretouch::tools
