// tests/fuzz/fuzz_bvh.cpp: libFuzzer's entry to feedBvh().
#include "tests/fuzz/fuzz_inputs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  foretouch::fuzz::feedBvh(data, size);
  return 0;
}
