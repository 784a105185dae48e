# Where machines that are not Debian's find what the library stands on: sysroot.sh has unpacked headers and
# sources, and packages/ builds from these.
get_filename_component(FORETOUCH_CROSS_SOURCES ${CMAKE_CURRENT_LIST_DIR}/../../build/cross/sources ABSOLUTE)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR}/packages)
list(APPEND CMAKE_FIND_ROOT_PATH ${FORETOUCH_CROSS_SOURCES})
# Boost's numbers, which nothing looks for.
set(CMAKE_CXX_STANDARD_INCLUDE_DIRECTORIES ${FORETOUCH_CROSS_SOURCES}/usr/include)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
