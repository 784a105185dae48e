# FindLCM: LCM as Debian ships it, without CMake files of its own (its pkg-config file asks for GLib's
# headers, which nothing here needs).
#   LCM::lcm       the library
#   LCM_GEN        the type generator
#   foretouch_lcm_types(<target> FILES x_t.lcm ...)   an INTERFACE library of the C++ types
find_path(LCM_INCLUDE_DIR lcm/lcm.h)
find_library(LCM_LIBRARY lcm)
find_program(LCM_GEN lcm-gen)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LCM REQUIRED_VARS LCM_LIBRARY LCM_INCLUDE_DIR LCM_GEN
  REASON_FAILURE_MESSAGE "Debian packages: liblcm-dev liblcm-bin")
mark_as_advanced(LCM_INCLUDE_DIR LCM_LIBRARY LCM_GEN)

if(LCM_FOUND AND NOT TARGET LCM::lcm)
  add_library(LCM::lcm UNKNOWN IMPORTED)
  set_target_properties(LCM::lcm PROPERTIES
    IMPORTED_LOCATION "${LCM_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${LCM_INCLUDE_DIR}")
endif()

# Files are named <package>_<type>.lcm; lcm-gen writes <package>/<type>.hpp.
function(foretouch_lcm_types target)
  cmake_parse_arguments(ARG "" "" "FILES" ${ARGN})
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/lcm-types)
  set(headers)
  foreach(file ${ARG_FILES})
    get_filename_component(name ${file} NAME_WE)
    string(REGEX REPLACE "^([a-z]+)_(.*)$" "\\1/\\2.hpp" header ${name})
    add_custom_command(OUTPUT ${folder}/${header}
      COMMAND ${LCM_GEN} --cpp --cpp-std c++11 --cpp-hpath ${folder} ${CMAKE_CURRENT_SOURCE_DIR}/${file}
      DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file}
      COMMENT "lcm-gen ${file}" VERBATIM)
    list(APPEND headers ${folder}/${header})
  endforeach()
  add_custom_target(${target}_generated DEPENDS ${headers})
  add_library(${target} INTERFACE)
  # SYSTEM: generated code casts in the old style.
  target_include_directories(${target} SYSTEM INTERFACE ${folder} ${LCM_INCLUDE_DIR})
  add_dependencies(${target} ${target}_generated)
endfunction()
