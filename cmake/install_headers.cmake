# Installs the public headers as <foretouch/...>, and lets them find one another by that name: in the
# sources they are "lss/...", names too common for somebody else's include path.
#   headers   the public headers, relative to source
#   source    the root of the sources
#   staging   a folder for the time being
#   place     where <foretouch/...> is to be found, relative to the prefix
foreach(header IN LISTS headers)
  string(REGEX MATCH "^[^/]+" folder "${header}")
  list(APPEND folders "${folder}")
endforeach()
list(REMOVE_DUPLICATES folders)
list(JOIN folders "|" folders)
foreach(header IN LISTS headers)
  get_filename_component(folder "${header}" DIRECTORY)
  file(READ "${source}/${header}" text)
  string(REGEX REPLACE "#include \"((${folders})/[^\"\n]+)\"" "#include <foretouch/\\1>" text "${text}")
  # The one header that stands for the others has no folder in its name, nor has that for OMPL.
  if(header MATCHES "^(assets/foretouch.hpp|planning/ompl.h)$")
    set(folder "")
  endif()
  get_filename_component(name "${header}" NAME)
  file(WRITE "${staging}/${folder}/${name}" "${text}")
  file(INSTALL "${staging}/${folder}/${name}" TYPE FILE
       DESTINATION "${CMAKE_INSTALL_PREFIX}/${place}/foretouch/${folder}")
endforeach()
file(REMOVE_RECURSE "${staging}")
