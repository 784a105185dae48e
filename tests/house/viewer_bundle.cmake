# The page viewer/dist/viewer.html is committed as it was built, so that nobody needs node. This
# fails where it was not built from the sources beside it. cmake -DSOURCE_DIR=... -P this
set(viewer ${SOURCE_DIR}/viewer)
file(GLOB_RECURSE paths RELATIVE ${viewer} ${viewer}/src/*)
list(APPEND paths index.html package-lock.json package.json single_page.ts tsconfig.json vite.config.ts)
list(SORT paths)

# As viewer/vite.config.ts computes it: of the lines "HASH  PATH", in order of the paths.
set(lines "")
foreach(path ${paths})
  file(SHA256 ${viewer}/${path} hash)
  string(APPEND lines "${hash}  ${path}\n")
endforeach()
string(SHA256 expected "${lines}")

set(page ${viewer}/dist/viewer.html)
if(NOT EXISTS ${page})
  message(FATAL_ERROR "viewer/dist/viewer.html is missing: build it with ./run viewer")
endif()
file(READ ${page} start LIMIT 16384)
if(NOT start MATCHES "<meta name=\"foretouch-sources\" content=\"([0-9a-f]+)\">")
  message(FATAL_ERROR "viewer/dist/viewer.html says nothing of its sources: build it with ./run viewer")
endif()
if(NOT CMAKE_MATCH_1 STREQUAL expected)
  message(FATAL_ERROR "viewer/dist/viewer.html was not built from the sources in viewer/: build it with "
                      "./run viewer and commit it (sources ${expected}, page ${CMAKE_MATCH_1})")
endif()
message(STATUS "viewer/dist/viewer.html was built from the sources in viewer/")
