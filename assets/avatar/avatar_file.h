// assets/avatar/avatar_file.h: avatars as JSON files, format "foretouch-avatar" version 1, and pair
// rules, format "foretouch-pairs" version 1 (docs/formats.md). Links by name; lengths in metres,
// quaternions (w, x, y, z).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "articulated/avatar.h"
#include "articulated/pair_rules.h"
#include "articulated/result.h"

namespace foretouch {

/// Largest avatar file, in bytes. The format bounds its nesting: the parser refuses a bracket where
/// the format has none.
inline constexpr std::size_t kMaxAvatarFileBytes = 64u << 20;

/// Reads and checks an avatar file. Refuses unknown and repeated keys, wrong types, a parent that
/// is not listed before its child, and every breach of the rules of Skeleton and Avatar; errors
/// name line, link and expectation.
[[nodiscard]] Result<Avatar> readAvatarFile(const std::string& path);

/// The same for text in memory; errors name `name` as the file. Safe on hostile input.
[[nodiscard]] Result<Avatar> parseAvatar(std::string_view json, const std::string& name);

/// The text of an avatar file; parseAvatar() of it gives the same avatar, bit for bit.
[[nodiscard]] std::string formatAvatar(const Avatar& avatar);

/// Writes a temporary file and renames it into place: never half a file.
[[nodiscard]] Result<Done> writeAvatarFile(const Avatar& avatar, const std::string& path);

/// Largest file of pair rules, in bytes.
inline constexpr std::size_t kMaxPairsFileBytes = 64u << 20;

/// Reads the rules of an avatar. Refuses unknown and repeated keys, wrong types, names that are not
/// a link with LSS of this avatar, pairs listed twice, reasons that this avatar disproves (links
/// that are not adjacent, LSS that do not overlap at rest), radii that do not fit its LSS, and
/// rules that leave no pair to ask. Errors name line, pair and expectation.
[[nodiscard]] Result<PairRules> readPairsFile(const std::string& path, const Avatar& avatar);

/// The same for text in memory; errors name `name` as the file. Safe on hostile input.
[[nodiscard]] Result<PairRules> parsePairs(std::string_view json, const std::string& name,
                                           const Avatar& avatar);

/// The text of a file: parsePairs() of it gives the same rules, bit for bit, but for pairs of links
/// without LSS, which are never asked and not in the text. Precondition: rules of this avatar.
[[nodiscard]] std::string formatPairs(const PairRules& rules, const Avatar& avatar);

/// Writes a temporary file and renames it into place: never half a file.
[[nodiscard]] Result<Done> writePairsFile(const PairRules& rules, const Avatar& avatar,
                                          const std::string& path);

}  // namespace foretouch
