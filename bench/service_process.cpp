#include "bench/service_process.h"

#include <algorithm>
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

namespace fs = std::filesystem;

constexpr char kReady[] = "ready";

Error failure(const std::string& what) {
  return Error::in("foretouch serve", ErrorCode::DeviceFailed, what);
}

/// The kind, without what differs from one to the next: a socket's number, a log's name.
std::string kindOf(const fs::path& leadsTo) {
  const std::string text = leadsTo.string();
  const std::size_t number = text.find(":[");
  if (number != std::string::npos && text.rfind("anon_inode", 0) != 0) {
    return text.substr(0, number);
  }
  return leadsTo.has_extension() ? "*" + leadsTo.extension().string() : text;
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
      fs::read_symlink("/proc/self/exe", unknown).replace_filename("foretouch");
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

std::string ServiceProcess::folder() const {
  return "/proc/" + std::to_string(child_);
}

std::int64_t ServiceProcess::residentBytes() const {
  std::ifstream file(folder() + "/statm");
  std::int64_t total = 0, resident = 0;
  if (!(file >> total >> resident)) return -1;
  return resident * ::sysconf(_SC_PAGESIZE);
}

std::vector<std::string> ServiceProcess::openFiles() const {
  std::vector<std::string> kinds;
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator(folder() + "/fd", gone)) {
    kinds.push_back(kindOf(fs::read_symlink(entry.path(), gone)));
  }
  std::sort(kinds.begin(), kinds.end());
  return kinds;
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
