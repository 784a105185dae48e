#include "assets/import/process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include <climits>

#include "assets/system_files.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

using Clock = std::chrono::steady_clock;

// An importer needs its own file, a side file and three streams; assimp keeps few open at once.
constexpr rlim_t kMaxOpenFiles = 64;
constexpr std::size_t kReadBytes = std::size_t{64} << 10;  // a pipe's capacity by default
constexpr std::size_t kErrorOutputBytes = 4096;
// How long a process may live after its output ended, so that we learn how it ends.
constexpr std::chrono::milliseconds kGrace{2000};
// How often we check a silent process: a process that it left behind may hold its output open.
constexpr std::chrono::milliseconds kCheckInterval{100};
constexpr int kExecFailed = 127;

/// A host may have closed its standard streams; then the next descriptors get their numbers, and
/// the child will overwrite those. So this moves every descriptor for the child above them.
FileDescriptor aboveStandardStreams(int fd) {
  FileDescriptor original(fd);
  if (fd < 0 || fd > STDERR_FILENO) return original;
  return FileDescriptor(fcntl(fd, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
}

struct Pipe {
  FileDescriptor readEnd, writeEnd;

  /// False with errno set.
  bool open() {
    std::array<int, 2> fds{};
    if (pipe2(fds.data(), O_CLOEXEC) != 0) return false;
    readEnd = aboveStandardStreams(fds[0]);
    writeEnd = aboveStandardStreams(fds[1]);
    return readEnd.isOpen() && writeEnd.isOpen();
  }
};

/// Pipes to the child. `exec` carries the errno of a failed start, or closes on success.
struct Channels {
  Pipe output, errors, exec;
  FileDescriptor nullInput;

  /// False with errno set.
  bool open() {
    nullInput = aboveStandardStreams(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    return nullInput.isOpen() && output.open() && errors.open() && exec.open();
  }
  void closeChildsEnds() {
    output.writeEnd.close();
    errors.writeEnd.close();
    exec.writeEnd.close();
  }
};

/// Everything the child needs, made before fork: after it only async-signal-safe calls are allowed,
/// because another thread may hold the allocator's lock for ever.
struct ChildPlan {
  const char* program;
  char* const* arguments;
  char* const* environment;
  rlim_t addressSpaceBytes, cpuSeconds;
  Cage* cage;
  int nullInput, output, errors, exec;
  pid_t parent;
};

bool limitTo(decltype(RLIMIT_CPU) resource, rlim_t soft, rlim_t hard) {
  rlimit current{};
  if (getrlimit(resource, &current) != 0) return false;
  const rlimit wanted{std::min(soft, current.rlim_max), std::min(hard, current.rlim_max)};
  return setrlimit(resource, &wanted) == 0;
}

bool setLimits(const ChildPlan& plan) {
  return limitTo(RLIMIT_CORE, 0, 0) && (kUnderSanitizer || limitTo(RLIMIT_FSIZE, 0, 0)) &&
         (kUnderSanitizer || limitTo(RLIMIT_NPROC, 0, 0)) &&
         limitTo(RLIMIT_NOFILE, kMaxOpenFiles, kMaxOpenFiles) &&
         // SIGXCPU at the soft limit distinguishes a timeout from other deaths; a second later,
         // SIGKILL.
         limitTo(RLIMIT_CPU, plan.cpuSeconds, plan.cpuSeconds + 1) &&
         // Last: from here on, as a copy of a large parent, we may get no more pages.
         (kUnderSanitizer || limitTo(RLIMIT_AS, plan.addressSpaceBytes, plan.addressSpaceBytes));
}

/// Where memory ends, this process shall die and not its parent. A system without /proc has another
/// way or none.
void volunteerForTheKernel() {
  // The file of a process that may not be dumped belongs to root; execve() makes it dumpable
  // anyway.
  prctl(PR_SET_DUMPABLE, 1, 0, 0, 0);
  const int fd = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (fd < 0) return;
  constexpr std::string_view kFirst = "1000";
  static_cast<void>(!write(fd, kFirst.data(), kFirst.size()));
  close(fd);
}

/// Files before limits, as more may be open than those allow; calls last, as they end the setting.
bool enterCage(const ChildPlan& plan) {
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && plan.cage->closeFiles() &&
         setLimits(plan) && plan.cage->closeCalls();
}

/// The host's handlers must not run in the child, and signals that it ignores or blocks must work
/// there.
void resetSignals() {
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  for (int signal = 1; signal < NSIG; ++signal) sigaction(signal, &standard, nullptr);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

[[noreturn]] void reportAndExit(int exec) {
  const int error = errno;
  // If even this fails, the parent sees only the status.
  const ssize_t written = write(exec, &error, sizeof error);
  _exit(written == sizeof error ? kExecFailed : kExecFailed - 1);
}

[[noreturn]] void becomeImporter(const ChildPlan& plan) {
  resetSignals();
  setpgid(0, 0);  // so that its children can be killed with it
  prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
  if (getppid() != plan.parent) _exit(kExecFailed);  // the parent died before the line above
  const bool ready = dup2(plan.nullInput, STDIN_FILENO) >= 0 &&
                     dup2(plan.output, STDOUT_FILENO) >= 0 && dup2(plan.errors, STDERR_FILENO) >= 0;
  // Otherwise a model file's exploit could use descriptors that the host forgot to mark. Old
  // kernels lack the call; then the host's marks must do.
  close_range(STDERR_FILENO + 1, UINT_MAX, CLOSE_RANGE_CLOEXEC);
  volunteerForTheKernel();
  if (!ready || !enterCage(plan)) reportAndExit(plan.exec);
  execve(plan.program, plan.arguments, plan.environment);
  reportAndExit(plan.exec);
}

/// A child, killed and collected at the latest by the destructor.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { kill(); }

  /// Collects the child if it ended by itself before `deadline`; sleeps in short naps, because
  /// waiting for one child with a timeout needs SIGCHLD, which belongs to the host.
  bool endsBefore(Clock::time_point deadline) {
    while (!collect(WNOHANG)) {
      if (Clock::now() >= deadline) return false;
      const timespec nap{0, 1'000'000};
      nanosleep(&nap, nullptr);
    }
    return true;
  }

  /// Kills it and the processes it started, and collects it.
  void kill() {
    if (collected_) return;
    if (look(WNOHANG).ours) {  // else the number may belong to another process by now
      ::kill(-pid_, SIGKILL);
      ::kill(pid_, SIGKILL);  // it may not have its group yet
    }
    collect(0);
  }

  [[nodiscard]] bool hasEnded() const { return collected_ || look(WNOHANG).ended; }

  [[nodiscard]] bool statusKnown() const { return statusKnown_; }
  [[nodiscard]] int status() const { return status_; }

 private:
  struct Look {
    bool ours, ended;
  };

  /// Looks without collecting: while the child is a zombie, its group's number is its own, so we
  /// can kill processes it left behind without hitting others.
  [[nodiscard]] Look look(int options) const {
    siginfo_t info{};
    int result = 0;
    do {
      result = waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT | options);
    } while (result != 0 && errno == EINTR);
    return {result == 0, result != 0 || info.si_pid != 0};
  }

  bool collect(int options) {
    if (collected_) return true;
    const Look seen = look(options);
    if (!seen.ended) return false;
    if (seen.ours) ::kill(-pid_, SIGKILL);
    pid_t collected = 0;
    do {
      collected = waitpid(pid_, &status_, 0);
    } while (collected < 0 && errno == EINTR);
    statusKnown_ = collected == pid_;
    collected_ = true;
    return true;
  }

  pid_t pid_;
  bool collected_ = false, statusKnown_ = false;
  int status_ = 0;
};

/// Nothing of the host's but where libraries are, without which a program may not start: tokens and
/// passwords are often kept there.
std::vector<std::string> childsEnvironment() {
  const char* const libraries = std::getenv("LD_LIBRARY_PATH");
  if (libraries == nullptr) return {};
  return {std::string("LD_LIBRARY_PATH=") + libraries};
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Forks with every signal blocked, so that no handler of the host runs in the child. -1 with errno
/// set if that fails.
pid_t start(const std::string& program, std::vector<std::string> arguments, ProcessLimits limits,
            const Channels& channels) {
  arguments.insert(arguments.begin(), program);  // copies: execve() wants them writable
  std::vector<std::string> environment = childsEnvironment();
  const std::vector<char*> argv = pointersTo(arguments), envp = pointersTo(environment);
  const ChildPlan plan{program.c_str(),
                       argv.data(),
                       kUnderSanitizer ? environ : envp.data(),
                       static_cast<rlim_t>(limits.addressSpaceBytes),
                       static_cast<rlim_t>(std::max(1.0, std::ceil(limits.seconds))),
                       &limits.cage,
                       channels.nullInput.get(),
                       channels.output.writeEnd.get(),
                       channels.errors.writeEnd.get(),
                       channels.exec.writeEnd.get(),
                       getpid()};
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t pid = fork();
  if (pid == 0) becomeImporter(plan);
  const int error = errno;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return pid;
}

int millisecondsUntil(Clock::time_point deadline, std::chrono::milliseconds atMost) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
  return static_cast<int>(std::clamp(left, std::chrono::milliseconds(0), atMost).count());
}

/// The errno of a failed start; 0 if the program runs. The pipe closes at exec, but only if no
/// other fork of the host has a copy of it: hence the deadline and the check of the child.
int startError(const FileDescriptor& exec, const Child& child, Clock::time_point deadline) {
  for (;;) {
    pollfd fd{exec.get(), POLLIN, 0};
    const int waitMs = millisecondsUntil(deadline, kCheckInterval);
    if (poll(&fd, 1, waitMs) > 0) break;
    if (Clock::now() >= deadline || child.hasEnded()) return 0;
  }
  int error = 0;
  ssize_t count = 0;
  do {
    count = read(exec.get(), &error, sizeof error);
  } while (count < 0 && errno == EINTR);
  return count == sizeof error ? error : 0;
}

void keepTail(std::string& tail, std::string_view bytes) {
  tail += bytes;
  if (tail.size() > kErrorOutputBytes) tail.erase(0, tail.size() - kErrorOutputBytes);
}

enum class ReadEnd : std::uint8_t { Closed, Enough, Deadline };

/// Moves both streams until standard output ends.
class Streams {
 public:
  Streams(FileDescriptor output, FileDescriptor errors, std::string& errorTail)
      : output_(std::move(output)),
        errors_(std::move(errors)),
        errorTail_(errorTail),
        buffer_(kReadBytes, '\0') {
    // poll() may wake us for bytes that are gone when we read.
    fcntl(output_.get(), F_SETFL, O_NONBLOCK);
    fcntl(errors_.get(), F_SETFL, O_NONBLOCK);
  }

  ReadEnd run(const Child& child, Clock::time_point deadline,
              const std::function<bool(std::string_view)>& take) {
    while (Clock::now() < deadline) {
      // A closed stream is -1, which poll() ignores.
      std::array<pollfd, 2> fds{{{output_.get(), POLLIN, 0}, {errors_.get(), POLLIN, 0}}};
      const bool ended = child.hasEnded();  // first: its output is in the pipe by then
      const int ready = poll(fds.data(), fds.size(), millisecondsUntil(deadline, kCheckInterval));
      if (ready == 0 && ended) return ReadEnd::Closed;
      if (ready <= 0) continue;  // a timeout, or EINTR
      if (fds[1].revents != 0) readErrors();
      if (fds[0].revents == 0) continue;
      const std::string_view bytes = readSome(output_);
      if (!bytes.empty() && !take(bytes)) return ReadEnd::Enough;
      if (!output_.isOpen()) return ReadEnd::Closed;
    }
    return ReadEnd::Deadline;
  }

  /// Reads the ended process's last output, at most the pipe's capacity.
  void drainErrors() {
    for (std::size_t drained = 0; errors_.isOpen() && drained < 16 * kReadBytes;) {
      const std::size_t count = readErrors();
      if (count == 0) break;
      drained += count;
    }
  }

 private:
  std::size_t readErrors() {
    const std::string_view bytes = readSome(errors_);
    keepTail(errorTail_, bytes);
    return bytes.size();
  }

  /// Reads the available bytes, possibly none; closes the stream at its end.
  std::string_view readSome(FileDescriptor& stream) {
    const ssize_t count = read(stream.get(), buffer_.data(), buffer_.size());
    if (count > 0) return {buffer_.data(), countOf(count)};
    if (count == 0 || (errno != EINTR && errno != EAGAIN)) stream.close();
    return {};
  }

  FileDescriptor output_, errors_;
  std::string& errorTail_;
  std::string buffer_;
};

void describeEnd(const Child& child, ReadEnd read, bool byItself, ProcessEnd& end) {
  using Kind = ProcessEnd::Kind;
  end.kind = read == ReadEnd::Deadline ? Kind::TimedOut : Kind::Stopped;
  if (!byItself) return;
  if (!child.statusKnown()) {
    end.kind = Kind::Lost;
  } else if (WIFEXITED(child.status())) {
    end.kind = Kind::Exited;
    end.code = WEXITSTATUS(child.status());
  } else {
    end.code = WTERMSIG(child.status());
    end.kind = end.code == SIGXCPU ? Kind::TimedOut : Kind::Signalled;
  }
}

}  // namespace

ProcessEnd runLimited(const std::string& program, const std::vector<std::string>& arguments,
                      const ProcessLimits& limits,
                      const std::function<bool(std::string_view)>& take) {
  const auto allowed = std::chrono::duration<double>(limits.seconds);
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(allowed);
  ProcessEnd end;
  Channels channels;
  const pid_t pid = channels.open() ? start(program, arguments, limits, channels) : -1;
  if (pid < 0) {
    end.code = errno;
    return end;
  }
  Child child(pid);
  channels.closeChildsEnds();
  end.code = startError(channels.exec.readEnd, child, deadline);
  if (end.code != 0) return end;

  Streams streams(std::move(channels.output.readEnd), std::move(channels.errors.readEnd),
                  end.errorOutput);
  const ReadEnd read = streams.run(child, deadline, take);
  const bool byItself =
      read == ReadEnd::Closed && child.endsBefore(std::min(deadline, Clock::now() + kGrace));
  child.kill();
  streams.drainErrors();
  describeEnd(child, read, byItself, end);
  return end;
}

}  // namespace foretouch::internal
