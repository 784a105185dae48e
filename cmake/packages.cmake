# Debian packages, by CPack: `./run package`. docs/packages.md says what is in which.
#   foretouch          component runtime   the program, its importer, the example, the systemd unit
#   libforetouch0.1    component c         the C library
#   libforetouch-dev   dev and c_dev       headers, static C++ libraries, CMake and pkg-config files
#   python3-foretouch  component python    where that component exists

set(library_package libforetouch${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(FORETOUCH_PACKAGE_CONTACT "Foretouch maintainers <root@localhost>" CACHE STRING
    "Who answers for the packages: Name <address>")
get_cmake_property(components COMPONENTS)

# What every package of Debian has.
set(package_of_runtime foretouch)
set(package_of_c ${library_package})
set(package_of_c_dev libforetouch-dev)
set(package_of_python python3-foretouch)
foreach(component runtime c c_dev python)
  if(component STREQUAL python AND NOT python IN_LIST components)
    continue()
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/packages/copyright
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package_of_${component}} COMPONENT ${component})
endforeach()

# The unit lies where systemd looks for it; nothing enables it. share/foretouch/systemd keeps the
# configuration to begin with.
if(FORETOUCH_TOOLS)
  install(FILES ${PROJECT_BINARY_DIR}/share/foretouch/systemd/foretouch.service
          DESTINATION lib/systemd/system COMPONENT runtime)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME foretouch)
set(CPACK_PACKAGE_VENDOR "")
set(CPACK_PACKAGE_CONTACT "${FORETOUCH_PACKAGE_CONTACT}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL runtime c dev c_dev)
set(CPACK_COMPONENT_DEV_GROUP development)
set(CPACK_COMPONENT_C_DEV_GROUP development)
set(CPACK_COMPONENT_RUNTIME_GROUP program)
set(CPACK_COMPONENT_C_GROUP library)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(same_version "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
# The first line of every description; `about` begins the rest.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "continuous collision detection of avatars")
string(CONCAT about
  "Foretouch tells what an articulated body (a VR user, a mocap actor, a robot)\n"
  "meets between two poses: when each link first touches the scene, where, and\n"
  "along which normal. It never reports a contact late, rounding included.\n\n"
  "This package holds")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME foretouch)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "${about} the program foretouch with its demonstration, its
service for pose streams over LCM (installed, not enabled), and the importer of
model files.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
# Models are read by a program of the package foretouch, in a process of its own.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "foretouch")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "${about} the C library, for engines.")

# The static C++ libraries ask for what they stand on; the C library does not.
set(development_needs libeigen3-dev libembree-dev libfmt-dev libhwy-dev nlohmann-json3-dev)
if(FORETOUCH_NETWORK)
  list(APPEND development_needs liblcm-dev liblcm-bin libcpp-httplib-dev)
endif()
list(JOIN development_needs ", " development_needs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libforetouch-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_package} ${same_version}, ${development_needs}")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "${about} the headers of C and C++, the static C++
libraries, CMake and pkg-config files, and an example in C.")

if(python IN_LIST components)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_COMPONENT_PYTHON_GROUP python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-foretouch)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "foretouch")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
      "${PROJECT_SOURCE_DIR}/cmake/packages/python/postinst;${PROJECT_SOURCE_DIR}/cmake/packages/python/prerm")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "${about} the module foretouch for Python 3.")
endif()

include(CPack)
