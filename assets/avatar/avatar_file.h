// assets/avatar/avatar_file.h: avatars as JSON files, format "foretouch-avatar" version 1
// (docs/formats.md). Lengths in metres, quaternions (w, x, y, z).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "articulated/avatar.h"
#include "articulated/result.h"

namespace foretouch {

/// An avatar file may not be larger than this (bytes). Its nesting is bounded by its shape: a
/// bracket where the format has none is refused as it is met.
inline constexpr std::size_t kMaxAvatarFileBytes = 64u << 20;

/// Reads and checks an avatar file. Unknown and repeated keys, wrong types, a parent that is not
/// listed before its child and every breach of Skeleton and Avatar are refused, naming line, link
/// and what was expected.
[[nodiscard]] Result<Avatar> readAvatarFile(const std::string& path);

/// The same for text in memory; `name` stands for the file in errors. Safe on hostile input.
[[nodiscard]] Result<Avatar> parseAvatar(std::string_view json, const std::string& name);

/// The text of an avatar file; parseAvatar() of it gives the same avatar, bit for bit.
[[nodiscard]] std::string formatAvatar(const Avatar& avatar);

/// Writes through a temporary file that is renamed into place: never half a file.
[[nodiscard]] Result<Done> writeAvatarFile(const Avatar& avatar, const std::string& path);

}  // namespace foretouch
