// tests/fuzz/fuzz_target.cpp: libFuzzer's entry to FORETOUCH_FEED, a function of FORETOUCH_INPUTS.
#include FORETOUCH_INPUTS

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  foretouch::fuzz::FORETOUCH_FEED(data, size);
  return 0;
}
