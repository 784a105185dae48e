// assets/import/file_damage.h: why a file was refused, told from the file itself. Where a
// reader of assimp refuses a damaged file, others try theirs, and the last one's reason is what
// assimp hands on ("No suitable reader found"). In foretouch-import only. Not installed.
#pragma once

#include <optional>
#include <string>

namespace foretouch::internal {

/// What is wrong and where; nothing where no damage is found, or the format (.glb, .gltf, and those
/// of XML) is not looked into. To be asked of refused files only: what a reader puts up with is no
/// reason to refuse a file.
[[nodiscard]] std::optional<std::string> damageOf(const std::string& path);

/// The same, to be asked before a reader is: of damage that no reader could put up with, and on
/// which assimp would spend much memory first.
[[nodiscard]] std::optional<std::string> hopelessDamageOf(const std::string& path);

}  // namespace foretouch::internal
