// A library that was built without the importer.
#include "bindings/c/importer_place.h"

namespace foretouch::c {

std::string importerNearLibrary() {
  return "";
}

}  // namespace foretouch::c
