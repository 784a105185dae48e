// A program with a buffer on its stack and a call of the C library that can be checked.
#include <cstdio>
#include <cstring>

int main(int count, char** words) {
  char copy[64] = "";
  if (std::strlen(words[count - 1]) < sizeof copy) std::strcpy(copy, words[count - 1]);
  std::printf("%d %s\n", count, copy);
}
