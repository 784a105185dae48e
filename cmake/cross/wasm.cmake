# WebAssembly with SIMD128 and its own exceptions, by Debian's emscripten; node runs what it makes.
# `./run cross wasm`.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/packages.cmake)
set(CMAKE_CROSSCOMPILING_EMULATOR node --no-experimental-fetch)
foreach(language C CXX)
  set(CMAKE_${language}_FLAGS_INIT "-msimd128 -fwasm-exceptions")
endforeach()
# The tests read and write this machine's files, and see its environment.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-fwasm-exceptions -sALLOW_MEMORY_GROWTH=1 -sNODERAWFS=1 -sEXIT_RUNTIME=1 \
-sTOTAL_STACK=8MB -sENVIRONMENT=node --pre-js ${CMAKE_CURRENT_LIST_DIR}/wasm_environment.js")
