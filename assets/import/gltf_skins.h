// assets/import/gltf_skins.h: skins of glTF files without "inverseBindMatrices". The format lets a
// file leave them out and means identities then; assimp 5.2 reads through a null pointer. Source:
// Khronos, "glTF 2.0 Specification", "skin.inverseBindMatrices". In foretouch-import only. Not
// installed.
#pragma once

#include <optional>
#include <string>

namespace foretouch::internal {

/// The file's bytes, .gltf or .glb by its extension, with a list of identities for every skin that
/// has none. Nothing if none lacks them, if the file is of another format, or if it is so damaged
/// that its reader must say why.
[[nodiscard]] std::optional<std::string> withBindMatrices(const std::string& path);

}  // namespace foretouch::internal
