// tools/demo_main.cpp: `foretouch demo` alone. A user who has just fetched the sources sees the
// dancer once what plays a clip is compiled, without servers, logs and all else in the program.
#include <utility>

#include "tools/commands/demo_command.h"
#include "tools/program.h"

int main(int argc, char** argv) {
  using namespace foretouch::tools;
  return runProgram(
      {"foretouch", "The bundled dancer in the bundled room, from sources just built.",
       "Start with: foretouch demo"},
      [](CLI::App& program, ExitCode& exit) { addCommand(program, demoCommand(), exit); }, argc,
      argv);
}
