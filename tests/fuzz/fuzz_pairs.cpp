// tests/fuzz/fuzz_pairs.cpp: libFuzzer's entry to feedPairs().
#include "tests/fuzz/fuzz_inputs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  foretouch::fuzz::feedPairs(data, size);
  return 0;
}
