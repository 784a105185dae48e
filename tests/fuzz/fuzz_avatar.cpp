// tests/fuzz/fuzz_avatar.cpp: libFuzzer's entry to feedAvatar().
#include "tests/fuzz/fuzz_inputs.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  foretouch::fuzz::feedAvatar(data, size);
  return 0;
}
