#include "tools/stream/serve_config.h"

#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "tools/inputs/policy_section.h"
#include "tools/settings/config_reading.h"

namespace foretouch::tools {
namespace {

static_assert(kMaxServeConfigBytes == kMaxTomlBytes);

void readAvatars(TomlSection root, TomlReading& reading, ServeConfig& config) {
  const toml::node* const node = root.find("avatar");
  if (node == nullptr || (node->is_array() && node->as_array()->empty())) {
    return reading.fail(ErrorCode::Empty, -1, "expected at least one [[avatar]]");
  }
  if (!node->is_array_of_tables()) {
    return reading.fail(ErrorCode::Syntax, lineOf(*node),
                        "avatar: expected tables, each under a line [[avatar]]");
  }
  if (node->as_array()->size() > kMaxServeAvatars) {
    return reading.fail(ErrorCode::LimitExceeded, lineOf(*node),
                        "expected at most " + std::to_string(kMaxServeAvatars) + " avatars");
  }
  std::set<std::int32_t> ids;
  for (const toml::node& element : *node->as_array()) {
    TomlSection section(reading, *element.as_table(), "[[avatar]]");
    NumberedAvatar avatar;
    section.allowOnly({"id", "file"});
    section.integer("id", 0, std::numeric_limits<std::int32_t>::max(), avatar.id);
    section.text("file", avatar.path, false);
    avatar.path = besideFile(avatar.path, reading.file);
    if (avatar.path.empty()) {
      reading.fail(ErrorCode::Empty, section.line(), "[[avatar]]: expected a file");
    }
    if (!ids.insert(avatar.id).second) {
      reading.fail(ErrorCode::DuplicateName, section.line(),
                   "[[avatar]]: the id " + std::to_string(avatar.id) +
                       " is used twice (an avatar without an id has 1)");
    }
    config.avatars.push_back(std::move(avatar));
  }
}

}  // namespace

Result<ServeConfig> parseServeConfig(std::string_view text, const std::string& file) {
  FORETOUCH_TRY(const auto parsed, parseToml(text, file));
  TomlReading reading{file, std::nullopt};
  ServeConfig config;
  TomlSection root(reading, parsed, "the file");
  // A project file may be a configuration, too: what it says about a clip is not about streams.
  root.allowOnly({"service", "scene", "query", "policy", "stream", "solid", "person", "avatar",
                  "clip", "made"});
  Settings settings;
  addServeSettings(settings, config);
  for (const char* const table : {"service", "scene", "query", "stream", "solid", "person"}) {
    readWholeTable(root, table, reading, settings);
  }
  readPolicies(root, reading, config.world.policies);
  if (!config.worldPath.empty()) {
    // Scene and avatars are those of the world file.
    const bool isBoth = root.find("avatar") != nullptr || !config.world.scenePath.empty();
    if (isBoth) {
      reading.fail(ErrorCode::Mismatch, -1,
                   "expected either a world, or a scene and avatars: a world file has its own");
    }
    if (reading.error) return *reading.error;
    return config;
  }
  readAvatars(root, reading, config);
  if (config.world.scenePath.empty()) {
    reading.fail(ErrorCode::Empty, -1, "expected a file in [scene]");
  }
  if (reading.error) return *reading.error;
  return config;
}

Result<ServeConfig> readServeConfig(const std::string& path) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxServeConfigBytes));
  return parseServeConfig(text, path);
}

}  // namespace foretouch::tools
