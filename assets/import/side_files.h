// assets/import/side_files.h: which files besides the model itself an import may read. A model file
// is a stranger's, and names other files: what it names must not be any file of the user, or its
// bytes come back as vertices. Used by the importer, and by its parent for the cage. Not installed.
#pragma once

#include <string>
#include <vector>

namespace foretouch::internal {

/// Folders with all that is below them. For a URDF file, its own folder and the folders of packages
/// that the caller names; besides, its package (the nearest folder above it with a package.xml)
/// and what lies beside the package; without a package, the folder above its own, never the root.
/// For a MuJoCo model (.xml, .mjcf), its own folder and those that the caller names. For any other
/// model, its own folder.
[[nodiscard]] std::vector<std::string> foldersBeside(const std::string& model,
                                                     const std::vector<std::string>& packagePaths);

/// Is `path`, with every link followed, in one of the folders or below, with no folder or name in
/// between that begins with a dot (where programs keep keys and settings)?
[[nodiscard]] bool isWithin(const std::vector<std::string>& folders, const std::string& path);

/// May `path` be read as a part of `model`: a regular file, within the model's folder, with the
/// name of a buffer (.bin, .glbin, .glbuf) or of materials (.mtl)?
[[nodiscard]] bool isSideFile(const std::string& model, const std::string& path);

/// What isSideFile() expects, for messages.
inline constexpr const char* kSideFileRule =
    "a file beside this one or in a folder there, whose name ends in .bin, .glbin, .glbuf or .mtl "
    "and has no dot in front";

}  // namespace foretouch::internal
