// assets/import/passed_over.h: what a file has and assimp's readers pass over without a word, or
// read wrongly: surfaces that are not polygons, curves between keys. In foretouch-import only. Not
// installed.
#pragma once

#include <string>
#include <vector>

namespace foretouch::internal {

/// One sentence each, for what counts here: surfaces and motions. Looks for the words of the
/// file's format; nothing if the file cannot be read, which its reader will say. Throws Failure for
/// what would be lost if it were read.
[[nodiscard]] std::vector<std::string> passedOver(const std::string& path, bool readsAnimations);

}  // namespace foretouch::internal
