// assets/import/packaged_importer.h: where the copy of Foretouch that a program was built against
// keeps foretouch-import. A static library does not know: its prefix may have been moved, and the
// program that it is part of lies elsewhere. foretouchConfig.cmake does, and says it to everybody
// who links foretouch::assets, as FORETOUCH_PACKAGED_IMPORTER.
#pragma once

namespace foretouch::internal {

/// Adds a place to those where the importer is looked for. `path` must live as long as the program.
bool notePackagedImporter(const char* path);

#ifdef FORETOUCH_PACKAGED_IMPORTER
inline const bool kPackagedImporterIsNoted = notePackagedImporter(FORETOUCH_PACKAGED_IMPORTER);
#endif

}  // namespace foretouch::internal
