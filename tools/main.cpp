// tools/main.cpp: the `foretouch` program.
#include "tools/commands/commands.h"

int main(int argc, char** argv) {
  return foretouch::tools::runForetouch(argc, argv);
}
