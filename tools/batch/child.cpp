#include "tools/batch/child.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostOut = std::size_t{16} << 20, kMostErr = 4096;
constexpr int kBetweenLooksMs = 100;
constexpr int kExecFailed = 127;

/// Both ends of a pipe, closed at the end.
class ChildPipe {
 public:
  ChildPipe() : isOpen_(::pipe2(ends_.data(), O_CLOEXEC) == 0) {}
  ChildPipe(const ChildPipe&) = delete;
  ChildPipe& operator=(const ChildPipe&) = delete;
  ~ChildPipe() {
    for (std::size_t end : {0, 1}) close(end);
  }
  [[nodiscard]] bool isOpen() const { return isOpen_; }
  [[nodiscard]] int reading() const { return ends_[0]; }
  [[nodiscard]] int writing() const { return ends_[1]; }
  void close(std::size_t end) {
    if (ends_[end] >= 0) ::close(std::exchange(ends_[end], -1));
  }

 private:
  std::array<int, 2> ends_{-1, -1};
  bool isOpen_;
};

/// Made before vfork(): after it come only calls of the system, as the memory is shared until exec.
struct Prepared {
  const char* program;
  char* const* words;
  const char* folder;
  int out, err, started;
  pid_t parent;
};

[[noreturn]] void becomeChild(const Prepared& plan) {
  // A group of its own: an interrupt at the terminal is for the batch, which ends it then.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != plan.parent) ::_exit(kExecFailed);  // it died before we asked for that
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) sigaction(signal, &standard, nullptr);
  const int input = ::open("/dev/null", O_RDONLY);
  const bool isReady = input >= 0 && ::dup2(input, STDIN_FILENO) >= 0 &&
                       ::dup2(plan.out, STDOUT_FILENO) >= 0 &&
                       ::dup2(plan.err, STDERR_FILENO) >= 0 && ::chdir(plan.folder) == 0;
  if (isReady) ::execv(plan.program, plan.words);
  const int why = errno;
  static_cast<void>(!::write(plan.started, &why, sizeof why));
  ::_exit(kExecFailed);
}

/// Not fork(): a copy of the page tables would cost a job as much as all else that we do for it. In
/// a function of its own: nothing that the caller keeps in registers is shared with the child.
[[gnu::noinline]] pid_t startChild(const Prepared& plan) {
  const pid_t child = ::vfork();
  if (child == 0) becomeChild(plan);
  return child;
}

void keepEnd(std::string& text, std::string_view more, std::size_t most) {
  text += more;
  if (text.size() > most) text.erase(0, text.size() - most);
}

/// True while the stream is open.
bool readSome(int stream, std::string& text, std::size_t most) {
  std::array<char, 1 << 12> piece;
  const ssize_t got = ::read(stream, piece.data(), piece.size());
  if (got < 0) return errno == EINTR || errno == EAGAIN;
  keepEnd(text, {piece.data(), countOf(got)}, most);
  return got > 0;
}

/// Reads both streams to their ends; kills the child where it has to end before.
void watch(pid_t child, ChildPipe& out, ChildPipe& err, const ChildPlan& plan,
           const std::function<bool()>& stop, ChildEnd& end) {
  const Clock::time_point start = Clock::now();
  while (out.reading() >= 0 || err.reading() >= 0) {
    std::array<pollfd, 2> streams{{{out.reading(), POLLIN, 0}, {err.reading(), POLLIN, 0}}};
    const int ready = ::poll(streams.data(), streams.size(), kBetweenLooksMs);
    const double elapsedS = std::chrono::duration<double>(Clock::now() - start).count();
    if (!end.isLate && plan.seconds > 0.0 && elapsedS > plan.seconds) {
      end.isLate = true;
      ::kill(-child, SIGKILL);
    }
    if (!end.isStopped && stop()) {
      end.isStopped = true;
      ::kill(-child, SIGKILL);
    }
    if (ready <= 0) continue;
    if (streams[0].revents != 0 && !readSome(out.reading(), end.out, kMostOut)) out.close(0);
    if (streams[1].revents != 0 && !readSome(err.reading(), end.err, kMostErr)) err.close(0);
  }
}

}  // namespace

ChildEnd runChild(const ChildPlan& plan, const std::function<bool()>& stop) {
  ChildEnd end;
  ChildPipe out, err, started;
  std::vector<char*> words{const_cast<char*>(plan.program.c_str())};
  for (const std::string& word : plan.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const bool areOpen = out.isOpen() && err.isOpen() && started.isOpen();
  const Prepared prepared{
      plan.program.c_str(), words.data(),      plan.folder.c_str(), out.writing(),
      err.writing(),        started.writing(), ::getpid()};
  const pid_t child = areOpen ? startChild(prepared) : -1;
  if (child < 0) {
    end.failure = std::string("no process could be started: ") + std::strerror(errno);
    return end;
  }
  for (ChildPipe* const pipe : {&out, &err, &started}) pipe->close(1);
  int why = 0;
  if (::read(started.reading(), &why, sizeof why) == sizeof why) {
    end.failure = plan.program + " cannot be started: " + std::strerror(why);
  }
  watch(child, out, err, plan, stop, end);
  int status = 0;
  pid_t ended = 0;
  do ended = ::waitpid(child, &status, 0);
  while (ended < 0 && errno == EINTR);
  if (ended == child && WIFEXITED(status)) end.code = WEXITSTATUS(status);
  if (ended == child && WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

std::string whyFailed(const ChildEnd& end, double seconds) {
  if (!end.failure.empty()) return end.failure;
  if (end.isLate) return fmt::format("took longer than {:g} s", seconds);
  if (end.signal != 0) return fmt::format("was ended by signal {}", end.signal);
  constexpr std::string_view kLead = "foretouch: ";
  std::string said = end.err;
  while (!said.empty() && said.back() == '\n') said.pop_back();
  said = said.substr(said.rfind('\n') + 1);  // the last line of all
  if (said.rfind(kLead, 0) == 0) said.erase(0, kLead.size());
  return said.empty() ? fmt::format("ended with exit code {}", end.code) : said;
}

}  // namespace foretouch::tools
