// tools/main.cpp: the `foretouch` program.
#include "tools/program.h"

int main(int argc, char** argv) {
  return foretouch::tools::runProgram(argc, argv);
}
