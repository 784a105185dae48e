// bindings/c/importer_place.h: where the importer lies, seen from this library.
#pragma once

#include <string>

namespace foretouch::c {

/// Engines keep plugins in folders of their own: the importer may be beside this library, or in an
/// installation's place. Empty if it is not, or this library has none: then the places of
/// SceneImportOptions count.
[[nodiscard]] std::string importerNearLibrary();

}  // namespace foretouch::c
