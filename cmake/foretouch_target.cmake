# What every target of the house has in common.

# Several sources are compiled at once: headers cost far more than what includes them. In the kernel
# these are of one room, where no two sources give one name to different things, and a source that is
# compiled for every vector width is compiled alone.
#   foretouch_unity(<target> [batch size])
#   foretouch_unity_by_room(<target>)
#   foretouch_precompile(<target> [more headers])
#   foretouch_precompiled_as(<target> <other>): takes the other's, which costs seconds to make
function(foretouch_unity target)
  if(FORETOUCH_UNITY)
    set(batch ${ARGN} 8)
    list(GET batch 0 batch)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
    # A class that holds what is local to its source is fine as long as it is local as well.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()
function(foretouch_unity_by_room target)
  if(NOT FORETOUCH_UNITY)
    return()
  endif()
  foretouch_unity(${target})
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "[.]cpp$")
  foreach(source ${sources})
    file(STRINGS ${source} wide REGEX "define HWY_TARGET_INCLUDE" LIMIT_COUNT 1)
    if(NOT wide)
      get_filename_component(room ${source} DIRECTORY)
      math(EXPR count_${room} "0${count_${room}} + 1")
      math(EXPR batch "(${count_${room}} - 1) / 9")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${room}${batch}")
    endif()
  endforeach()
endfunction()
function(foretouch_precompile target)
  if(FORETOUCH_UNITY)
    target_precompile_headers(${target} PRIVATE
      <algorithm> <array> <cmath> <cstdint> <limits> <memory> <string> <utility> <vector>
      <Eigen/Core> <Eigen/Geometry> ${ARGN})
  endif()
endfunction()
function(foretouch_precompiled_as target other)
  # Hardened, a program is compiled as one (-fPIE), a library for all (-fPIC): headers serve one kind.
  get_target_property(type ${target} TYPE)
  get_target_property(other_type ${other} TYPE)
  if(FORETOUCH_HARDENED AND type STREQUAL EXECUTABLE AND NOT other_type STREQUAL EXECUTABLE)
    return()
  endif()
  if(FORETOUCH_UNITY)
    target_precompile_headers(${target} REUSE_FROM ${other})
  endif()
endfunction()

# What waits for files and terminals, and tests, which leave what is computed at length to the kernel
# and to the judge, gain nothing from the last optimizations, which cost a quarter of their compile
# time. Not for the kernel and the judge, nor for what a stream or a benchmark passes through.
function(foretouch_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# What Debian hardens its own programs by, and the marks of Intel's control-flow protection, for what is
# packaged and, in every release build, for what reads strangers' bytes (tests/packaging/hardening.sh
# holds both to it). The kernel reads nothing of a
# stranger's and gets the cheaper protection of the stack: of arrays of characters, not of every
# matrix that lives there.
#   foretouch_harden(<target>)
# (The reference, which is not packaged, takes the kernel's precompiled headers, and so its flags.)
set(foretouch_kernel foretouch_lss foretouch_articulated foretouch_tessellation foretouch_middleware
  foretouch_reference)
set(foretouch_readers foretouch_assets foretouch_gltf foretouch-import foretouch_network foretouch_codecs
  foretouch_addresses foretouch_player foretouch_tools foretouch-demo foretouch foretouch_verification
  foretouch-verify)
if(FORETOUCH_HARDENED AND FORETOUCH_SANITIZE)
  message(FATAL_ERROR "FORETOUCH_HARDENED and FORETOUCH_SANITIZE exclude one another")
endif()
include(CheckCXXCompilerFlag)
include(CheckPIESupported)
check_pie_supported(LANGUAGES C CXX)
check_cxx_compiler_flag(-fcf-protection FORETOUCH_HAS_CF_PROTECTION)  # x86 alone
check_cxx_compiler_flag(-fstack-clash-protection FORETOUCH_HAS_STACK_CLASH_PROTECTION)
function(foretouch_harden target)
  set(protector -fstack-protector-strong)
  if(target IN_LIST foretouch_kernel)
    set(protector -fstack-protector)
  endif()
  target_compile_options(${target} PRIVATE ${protector} -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2
    $<$<BOOL:${FORETOUCH_HAS_CF_PROTECTION}>:-fcf-protection>
    $<$<BOOL:${FORETOUCH_HAS_STACK_CLASH_PROTECTION}>:-fstack-clash-protection>
    # The same packages wherever they are built.
    -ffile-prefix-map=${PROJECT_SOURCE_DIR}=.)
  target_link_options(${target} PRIVATE -Wl,-z,relro,-z,now,-z,noexecstack)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
endfunction()

# Warnings, checks and sanitizers. -ffp-contract=off: the error bounds of docs/guarantees.md count one
# rounding an operation; a contracted multiply-add would round elsewhere and differ between CPUs.
function(foretouch_compile_options target)
  set_property(GLOBAL APPEND PROPERTY FORETOUCH_TARGETS ${target})
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
    -Woverloaded-virtual -ffp-contract=off
    # As GCC's -Wall, which has it for C alone: braces may be left out in C++.
    $<$<CXX_COMPILER_ID:Clang>:-Wno-missing-braces>
    # GCC looks through its memory for what it may free less often, which costs a tenth of its time.
    $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>
    $<$<BOOL:${FORETOUCH_WERROR}>:-Werror>)
  if(FORETOUCH_HARDENED OR (target IN_LIST foretouch_readers AND CMAKE_BUILD_TYPE STREQUAL Release
                            AND NOT FORETOUCH_SANITIZE AND NOT CMAKE_CROSSCOMPILING))
    foretouch_harden(${target})
  endif()
  target_compile_definitions(${target} PRIVATE
    FORETOUCH_CHECKS=$<IF:$<CONFIG:Debug,RelWithDebInfo>,1,0>)
  if(FORETOUCH_SANITIZE)
    # GCC takes what the sanitizers add for uses of variables that nothing has set.
    target_compile_options(${target} PRIVATE -fsanitize=${FORETOUCH_SANITIZE}
                           -fno-sanitize-recover=all -fno-omit-frame-pointer
                           $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    target_link_options(${target} PRIVATE -fsanitize=${FORETOUCH_SANITIZE})
  endif()
endfunction()

# Highway chooses among a processor's vectors at run time on x86-64 alone. Elsewhere the build settles
# for what all processors of the architecture have (NEON, SIMD128): GCC does not compile the choice
# there, and SVE's vectors cannot lie in the structs of our lanes.
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_compile_definitions(HWY_COMPILE_ONLY_STATIC)
endif()
# Highway's NEON includes AES, which nothing here uses: without the flag, GCC refuses to inline what it
# declares.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  add_compile_options(-march=armv8-a+crypto)
endif()

# The headers under the name that they have for others, <foretouch/...>, without an installation: for
# projects that add this one as a folder, and for the examples.
set(foretouch_built_headers ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${foretouch_built_headers}/foretouch)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/assets/foretouch.hpp
     ${foretouch_built_headers}/foretouch/foretouch.hpp SYMBOLIC)

# What a build must have made before it is installed: cmake/check_built.cmake says what is missing.
#   foretouch_product(<component> <target> <file>)
function(foretouch_product component target file)
  set_property(GLOBAL APPEND_STRING PROPERTY FORETOUCH_PRODUCTS
    "product(${component} ${target} \"${file}\")\n")
endfunction()

# foretouch_library(<folder> [UNITY] HEADERS ... SOURCES ... LINKS ... PRIVATE_LINKS ...)
# makes target foretouch_<folder>, alias foretouch::<folder>, installed and exported.
function(foretouch_library folder)
  cmake_parse_arguments(ARG "UNITY" "" "HEADERS;SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  set(target foretouch_${folder})
  add_library(${target} ${ARG_SOURCES} ${ARG_HEADERS})
  add_library(foretouch::${folder} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${folder}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    POSITION_INDEPENDENT_CODE ON)
  foretouch_compile_options(${target})
  if(ARG_UNITY)
    foretouch_unity(${target})
  else()
    foretouch_unity_by_room(${target})
    if(TARGET foretouch_lss AND NOT target STREQUAL foretouch_lss)
      foretouch_precompiled_as(${target} foretouch_lss)
    else()
      foretouch_precompile(${target})
    endif()
  endif()
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  if(NOT PROJECT_IS_TOP_LEVEL)
    target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${foretouch_built_headers}>)
  endif()
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${foretouch_built_headers}/foretouch/${folder} SYMBOLIC)
  target_link_libraries(${target} PUBLIC ${ARG_LINKS} PRIVATE ${ARG_PRIVATE_LINKS})
  foreach(header ${ARG_HEADERS})
    set_property(GLOBAL APPEND PROPERTY FORETOUCH_HEADERS ${folder}/${header})
  endforeach()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL STATIC_LIBRARY)
    foretouch_product(dev ${target} $<TARGET_FILE:${target}>)
  else()
    foretouch_product(runtime ${target} $<TARGET_FILE:${target}>)
  endif()
  install(TARGETS ${target} EXPORT foretouchTargets
          ARCHIVE COMPONENT dev
          LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev)
endfunction()

# What is built where it can be: the cache variable <name> is AUTO, ON (demanded) or OFF.
#   foretouch_optional(<name> <what it builds>)
function(foretouch_optional name what)
  set(${name} AUTO CACHE STRING "${what}: AUTO (where it can be), ON or OFF")
  set_property(CACHE ${name} PROPERTY STRINGS AUTO ON OFF)
  if(NOT ${name} MATCHES "^(AUTO|ON|OFF)$")
    message(FATAL_ERROR "${name} is '${${name}}'; expected AUTO, ON or OFF")
  endif()
endfunction()
