// bench/main.cpp: the `foretouch-bench` program.
#include "bench/commands.h"
#include "tools/program.h"

int main(int argc, char** argv) {
  using namespace foretouch::tools;
  return runProgram({"foretouch-bench", "Measures Foretouch: speed, accuracy, memory, peers.",
                     "Start with: foretouch-bench latency"},
                    addBenchCommands, argc, argv);
}
