// tests/digests/at_width.cpp: the `foretouch` program with vectors of a given width, which the
// program itself does not ask for: at_width WIDTH ARGUMENTS...
#include <cstdio>
#include <vector>

#include "lss/simd.h"
#include "tools/commands/commands.h"

int main(int argc, char** argv) {
  const auto simd = argc > 1 ? foretouch::simdFromName(argv[1]) : std::nullopt;
  if (!simd || !foretouch::useSimd(simd)) {
    std::fputs("at_width: expected vectors that this processor has, as its first word\n", stderr);
    return 2;
  }
  std::vector<const char*> words(argv + 1, argv + argc);
  words.front() = argv[0];
  return foretouch::tools::runForetouch(argc - 1, words.data());
}
