#include "tests/tools/program_run.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace foretouch::test {
namespace {

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

ProgramRun::ProgramRun(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& environment, const std::string& out,
                       const std::string& program)
    : out_(out.empty() ? folder_ / "out" : out) {
  const std::string started = program.empty() ? FORETOUCH_PROGRAM : program;
  std::vector<std::string> words{started};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> settings = environment;
  for (char** entry = environ; *entry != nullptr; ++entry) settings.emplace_back(*entry);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, out_.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&files, 2, (folder_ / "err").c_str(), O_WRONLY | O_CREAT, 0600);
  const int failure = posix_spawnp(&child_, started.c_str(), &files, nullptr,
                                   pointersTo(words).data(), pointersTo(settings).data());
  posix_spawn_file_actions_destroy(&files);
  if (failure != 0) ADD_FAILURE() << started << " cannot be run: " << failure;
}

ProgramRun::~ProgramRun() {
  if (child_ <= 0) return;
  ::kill(child_, SIGKILL);
  ::waitpid(child_, nullptr, 0);
}

void ProgramRun::send(int signal) const {
  if (child_ > 0) ::kill(child_, signal);
}

Ended ProgramRun::ended() {
  Ended ended;
  int status = 0;
  if (child_ <= 0 || ::waitpid(child_, &status, 0) != child_) return ended;
  child_ = -1;
  if (WIFEXITED(status)) ended.exitCode = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
  if (out_ == folder_ / "out") ended.out = contentOf(out_);
  ended.err = contentOf(folder_ / "err");
  return ended;
}

Ended runForetouch(const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment) {
  return ProgramRun(arguments, environment).ended();
}

Ended runBench(const std::vector<std::string>& arguments) {
  return ProgramRun(arguments, {}, "", std::string(FORETOUCH_PROGRAM) + "-bench").ended();
}

Ended runVerify(const std::vector<std::string>& arguments) {
  return ProgramRun(arguments, {}, "", std::string(FORETOUCH_PROGRAM) + "-verify").ended();
}

}  // namespace foretouch::test
