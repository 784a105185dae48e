# Highway, built from its sources: Debian has it for Debian's machines alone.
set(source ${FORETOUCH_CROSS_SOURCES}/src/highway)
if(NOT TARGET hwy::hwy)
  add_library(foretouch_hwy STATIC ${source}/hwy/aligned_allocator.cc ${source}/hwy/per_target.cc
    ${source}/hwy/print.cc ${source}/hwy/targets.cc)
  target_include_directories(foretouch_hwy PRIVATE ${source})
  target_compile_features(foretouch_hwy PRIVATE cxx_std_17)
  set_target_properties(foretouch_hwy PROPERTIES POSITION_INDEPENDENT_CODE ON)
  add_library(hwy::hwy INTERFACE IMPORTED GLOBAL)
  target_include_directories(hwy::hwy INTERFACE ${source})
  target_link_libraries(hwy::hwy INTERFACE foretouch_hwy)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(hwy REQUIRED_VARS source)
