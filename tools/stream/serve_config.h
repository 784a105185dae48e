// tools/stream/serve_config.h: the file of `foretouch serve --config`: one TOML file that
// configures a service. docs/formats.md, "Service configuration", has its keys.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "articulated/result.h"
#include "tools/settings/serve_settings.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxServeConfigBytes = std::size_t{1} << 20;

/// `file`: the path of `text`, for errors, and for relative paths, which are relative to its
/// folder. Errors name the line: broken TOML, unknown or repeated keys (with the nearest legal
/// one), wrong types, values out of range, missing keys. Never throws; bounds the nesting.
[[nodiscard]] Result<ServeConfig> parseServeConfig(std::string_view text, const std::string& file);

/// The same for a file of at most kMaxServeConfigBytes.
[[nodiscard]] Result<ServeConfig> readServeConfig(const std::string& path);

}  // namespace foretouch::tools
