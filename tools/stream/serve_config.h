// tools/stream/serve_config.h: what `foretouch serve --config` reads: one TOML file that says all
// of what a service does. docs/formats.md, "Service configuration", has its keys.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "articulated/result.h"
#include "tools/settings/serve_settings.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxServeConfigBytes = std::size_t{1} << 20;

/// `file` is the path that `text` came from: for errors, and for relative paths, which count from
/// its folder. Errors name the line: broken TOML, unknown or repeated keys (with the nearest legal
/// one), wrong types, values out of range, what is missing. Never throws; nesting is bounded.
[[nodiscard]] Result<ServeConfig> parseServeConfig(std::string_view text, const std::string& file);

/// The same of a file of at most kMaxServeConfigBytes.
[[nodiscard]] Result<ServeConfig> readServeConfig(const std::string& path);

}  // namespace foretouch::tools
