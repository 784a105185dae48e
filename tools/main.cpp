// tools/main.cpp: the `foretouch` program.
#include "tools/commands/commands.h"

int main(int argc, char** argv) {
  using namespace foretouch::tools;
  return runProgram(
      {"foretouch", "Continuous collision detection of avatars: what is touched between two poses.",
       "Start with: foretouch demo"},
      addCommands, argc, argv);
}
