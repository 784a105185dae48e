#include "bench/service_process.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace foretouch::tools {
namespace {

constexpr char kReady[] = "ready";

Error failure(const std::string& what) {
  return Error::in("foretouch serve", ErrorCode::DeviceFailed, what);
}

/// Reads the child's output up to its "ready" line.
bool waitUntilReady(int output) {
  std::string line;
  char c = 0;
  for (;;) {
    const ssize_t got = ::read(output, &c, 1);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    if (c != '\n') {
      line += c;
      continue;
    }
    if (line == kReady) return true;
    line.clear();
  }
}

}  // namespace

Result<ServiceProcess> ServiceProcess::start(const std::vector<std::string>& arguments) {
  std::error_code unknown;
  const std::string program =
      std::filesystem::read_symlink("/proc/self/exe", unknown).replace_filename("foretouch");
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return failure(std::strerror(errno));
  std::vector<std::string> words = {"foretouch", "serve"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  pid_t child = -1;
  const int failed =
      ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (failed != 0) {
    ::close(ends[0]);
    return failure(std::string("could not be started: ") + std::strerror(failed));
  }
  ServiceProcess service(child, ends[0]);
  if (!waitUntilReady(ends[0])) return failure("ended before it was ready");
  return service;
}

ServiceProcess::ServiceProcess(ServiceProcess&& other) noexcept
    : child_(other.child_), output_(other.output_) {
  other.child_ = -1;
  other.output_ = -1;
}

ServiceProcess::~ServiceProcess() {
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  if (output_ >= 0) ::close(output_);
}

std::int64_t ServiceProcess::residentBytes() const {
  std::ifstream file("/proc/" + std::to_string(child_) + "/statm");
  std::int64_t total = 0, resident = 0;
  if (!(file >> total >> resident)) return -1;
  return resident * ::sysconf(_SC_PAGESIZE);
}

std::int64_t ServiceProcess::openFiles() const {
  std::error_code error;
  const std::filesystem::directory_iterator entries("/proc/" + std::to_string(child_) + "/fd",
                                                    error);
  if (error) return -1;
  std::int64_t count = 0;
  for (const auto& entry : entries) {
    (void)entry;
    ++count;
  }
  return count;
}

int ServiceProcess::stop() {
  ::kill(child_, SIGTERM);
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace foretouch::tools
