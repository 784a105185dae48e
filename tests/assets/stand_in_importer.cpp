// A stand-in for foretouch-import that tries what code in a compromised importer might, and tells
// on standard error which of it succeeded: "done: delete ptrace". It acts on the test's own files
// and on the test's own process alone. What to act on is in the file SECRETS beside the model: the
// folder of the test's secrets, then the port that the test listens on.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <netinet/in.h>
#include <string>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

std::string secrets;
int port = 0;

std::string in(const char* name) {
  return secrets + "/" + name;
}

bool readsTheEnvironment() {
  return std::getenv("FORETOUCH_TEST_TOKEN") != nullptr;
}

bool readsAFileOfTheUser() {
  std::ifstream file(in("key"));
  return file.get() != std::char_traits<char>::eof();
}

bool connects() {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return fd >= 0 && connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
}

bool makesAFile() {
  return open(in("made").c_str(), O_WRONLY | O_CREAT, 0600) >= 0;
}

bool truncates() {
  return truncate(in("long").c_str(), 0) == 0;
}

bool deletes() {
  return unlink(in("old").c_str()) == 0;
}

bool links() {
  return link(in("key").c_str(), in("linked").c_str()) == 0 ||
         rename(in("named").c_str(), in("renamed").c_str()) == 0;
}

bool writesToItsParent() {
  const std::string memory = "/proc/" + std::to_string(getppid()) + "/mem";
  return open(memory.c_str(), O_RDWR) >= 0;
}

bool tracesItsParent() {
  if (ptrace(PTRACE_SEIZE, getppid(), nullptr, nullptr) != 0) return false;
  ptrace(PTRACE_DETACH, getppid(), nullptr, nullptr);
  return true;
}

/// In a session of its own, where the kill of its group does not find it.
bool leavesAProcessBehind() {
  const pid_t child = fork();
  if (child == 0) {
    setsid();
    sleep(2);
    _exit(0);
  }
  return child > 0;
}

struct Attempt {
  const char* name;
  bool (*succeeds)();
};

constexpr Attempt kAttempts[] = {{"environment", readsTheEnvironment},
                                 {"read", readsAFileOfTheUser},
                                 {"connect", connects},
                                 {"make", makesAFile},
                                 {"truncate", truncates},
                                 {"delete", deletes},
                                 {"link", links},
                                 {"memory", writesToItsParent},
                                 {"ptrace", tracesItsParent},
                                 {"process", leavesAProcessBehind}};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const std::string model = argv[argc - 1];
  std::ifstream told(model.substr(0, model.rfind('/') + 1) + "SECRETS");
  if (!(told >> secrets >> port)) return 2;
  std::string done = "done:";
  int tried = 0;
  for (const Attempt& attempt : kAttempts) {
    if (attempt.succeeds()) done += std::string(" ") + attempt.name;
    ++tried;
  }
  std::fprintf(stderr, "tried %d, %s\n", tried, done.c_str());
  return 3;
}
