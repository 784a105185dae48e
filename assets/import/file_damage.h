// assets/import/file_damage.h: finds in a refused file itself the reason for the refusal. When one
// of assimp's readers refuses a damaged file, assimp tries the others, and reports the last one's
// reason ("No suitable reader found"). In foretouch-import only. Not installed.
#pragma once

#include <optional>
#include <string>

namespace foretouch::internal {

/// The damage and its place; nothing if there is none, or if the format is not one of those in
/// XML. Call it for refused files only: damage that a reader tolerates is not a reason to
/// refuse a file.
[[nodiscard]] std::optional<std::string> damageOf(const std::string& path);

}  // namespace foretouch::internal
