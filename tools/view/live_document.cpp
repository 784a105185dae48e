#include "tools/view/live_document.h"

#include <fmt/format.h>

#include "tools/json_text.h"

namespace foretouch::tools {

std::string livePage() {
  return "<!doctype html><title>Foretouch</title>";
}

Result<std::string> liveDocument(const ServeConfig& config, const ServedWorld& world) {
  std::string avatars;
  for (const StreamSolver& avatar : world.avatars) {
    avatars += fmt::format("{}{{\"id\":{}}}", avatars.empty() ? "" : ",", avatar.id());
  }
  return fmt::format(
      R"({{"format":"foretouch-view","version":1,"tool":"foretouch {}","kind":"live","title":{},"avatars":[{}],"live":{{"events":"/events"}}}})",
      FORETOUCH_VERSION, jsonFileName(config.scene), avatars);
}

}  // namespace foretouch::tools
