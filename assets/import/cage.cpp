#include "assets/import/cage.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <filesystem>
#include <linux/audit.h>
#include <linux/seccomp.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace foretouch::internal {
namespace {

// Landlock, by number: headers may be older than the kernel. Its calls have the same numbers on
// every architecture.
constexpr long kCreateRuleset = 444, kAddRule = 445, kRestrictSelf = 446;
constexpr std::uint32_t kAskVersion = 1;  // LANDLOCK_CREATE_RULESET_VERSION
constexpr int kPathBeneath = 1;           // LANDLOCK_RULE_PATH_BENEATH
constexpr std::uint64_t kExecute = 1, kReadFile = 1 << 2, kReadFolder = 1 << 3;

/// A kernel takes a longer structure than it knows if the rest is zero.
struct LandlockRules {
  std::uint64_t files, network, scopes;
};
struct __attribute__((packed)) LandlockDoor {
  std::uint64_t allowed;
  std::int32_t parent;
};

/// Every right that the version knows, so that what no door allows is forbidden.
LandlockRules everyRightOf(int version) {
  LandlockRules rules{(std::uint64_t{1} << 13) - 1, 0, 0};
  if (version >= 2) rules.files |= std::uint64_t{1} << 13;  // moving between folders
  if (version >= 3) rules.files |= std::uint64_t{1} << 14;  // truncating
  if (version >= 5) rules.files |= std::uint64_t{1} << 15;  // ioctl() of devices
  if (version >= 4) rules.network = 3;                      // TCP: bind, connect
  if (version >= 6) rules.scopes = 3;                       // abstract sockets, signals
  return rules;
}

int askedVersion() {
  const long version = syscall(kCreateRuleset, nullptr, 0, kAskVersion);
  return version > 0 ? static_cast<int>(version) : 0;
}

/// A service may run under a filter of its own that kills the process for a call that the filter's
/// author did not know (systemd's SystemCallFilter=): there, a child asks.
int versionOfLandlock() {
  if (prctl(PR_GET_SECCOMP) != SECCOMP_MODE_FILTER) return askedVersion();
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_DUMPABLE, 0);  // no core, if it is killed
    _exit(askedVersion());
  }
  int status = 0;
  pid_t collected = 0;
  do {
    collected = child < 0 ? -1 : waitpid(child, &status, 0);
  } while (collected < 0 && child > 0 && errno == EINTR);
  return collected == child && child > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : 0;
}

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#elif defined(__riscv) && __riscv_xlen == 64
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_RISCV64;
#else
constexpr std::uint32_t kArchitecture = 0;  // then there is no filter: see weaknessOf()
#endif

/// Filters are known where one at address 0 is a bad address, not a bad request.
bool hasSeccomp() {
  return kArchitecture != 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, nullptr) != 0 &&
         errno == EFAULT;
}

/// What a reader calls: it reads, allocates, asks for the time and itself, and ends. The loader of
/// shared libraries and a shell's own words need no more. Architectures lack some of the old ones.
constexpr int kReadersCalls[] = {
    SYS_read,
    SYS_readv,
    SYS_pread64,
    SYS_write,
    SYS_writev,
    SYS_lseek,
    SYS_close,
    SYS_fstat,
    SYS_statx,
    SYS_faccessat,
    SYS_readlinkat,
    SYS_getcwd,
    SYS_getdents64,
    SYS_dup,
    SYS_dup3,
    SYS_munmap,
    SYS_mmap,
    SYS_mprotect,
    SYS_mremap,
    SYS_madvise,
    SYS_brk,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_rt_sigreturn,
    SYS_sigaltstack,
    SYS_nanosleep,
    SYS_clock_nanosleep,
    SYS_clock_gettime,
    SYS_clock_getres,
    SYS_gettimeofday,
    SYS_times,
    SYS_getrusage,
    SYS_getpid,
    SYS_getppid,
    SYS_gettid,
    SYS_getpgid,
    SYS_getuid,
    SYS_geteuid,
    SYS_getgid,
    SYS_getegid,
    SYS_getgroups,
    SYS_futex,
    SYS_set_robust_list,
    SYS_set_tid_address,
    SYS_sched_yield,
    SYS_sched_getaffinity,
    SYS_uname,
    SYS_sysinfo,
    SYS_getrandom,
    SYS_exit,
    SYS_exit_group,
    SYS_restart_syscall,
    SYS_wait4,
    SYS_pipe2,
    SYS_ppoll,
    SYS_pselect6,
    SYS_umask,
    SYS_fadvise64,
    SYS_execve,
#ifdef SYS_newfstatat
    SYS_newfstatat,
#endif
#ifdef SYS_faccessat2
    SYS_faccessat2,
#endif
#ifdef SYS_rseq
    SYS_rseq,
#endif
#ifdef SYS_arch_prctl
    SYS_arch_prctl,
#endif
#ifdef SYS_stat
    SYS_stat,
    SYS_lstat,
    SYS_access,
    SYS_readlink,
    SYS_getdents,
    SYS_dup2,
    SYS_pipe,
    SYS_poll,
    SYS_select,
    SYS_time,
    SYS_getpgrp,
#endif
#ifdef SYS_getrlimit
    SYS_getrlimit,
#endif
};

/// The low half of argument `index`; the high one is zero or ignored in all that we look at.
constexpr std::uint32_t argumentAt(std::size_t index) {
  constexpr std::size_t kLow = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? 0 : 4;
  return static_cast<std::uint32_t>(offsetof(seccomp_data, args) + 8 * index + kLow);
}

sock_filter statement(std::uint16_t code, std::uint32_t value) {
  return sock_filter{code, 0, 0, value};
}
sock_filter jump(std::uint16_t code, std::uint32_t value, std::uint8_t ifTrue,
                 std::uint8_t ifFalse) {
  return sock_filter{code, ifTrue, ifFalse, value};
}

/// Writes a filter: one call after the other, and at the end what becomes of all others.
class FilterWriter {
 public:
  explicit FilterWriter(std::vector<sock_filter>& out) : out_(out) {
    load(offsetof(seccomp_data, arch));
    out_.push_back(jump(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0));
    answer(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
  }

  void allow(int call) {
    out_.push_back(jump(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
    answer(SECCOMP_RET_ALLOW);
  }
  void forbid(int call) {
    out_.push_back(jump(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
    answer(kForbidden);
  }
  /// Unless the argument has one of the bits.
  void allowWithout(int call, std::size_t argument, std::uint32_t bits) {
    begin(call, 4);
    load(argumentAt(argument));
    out_.push_back(jump(BPF_JMP | BPF_JSET | BPF_K, bits, 1, 0));
    answer(SECCOMP_RET_ALLOW);
    answer(kForbidden);
  }
  /// If the argument is one of the values.
  void allowOnly(int call, std::size_t argument, std::initializer_list<std::uint32_t> values) {
    begin(call, static_cast<std::uint8_t>(2 + 2 * values.size()));
    load(argumentAt(argument));
    for (const std::uint32_t value : values) {
      out_.push_back(jump(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1));
      answer(SECCOMP_RET_ALLOW);
    }
    answer(kForbidden);
  }
  /// All others: with the error of a kernel that lacks them, for which callers have other ways.
  void forbidTheRest() { answer(SECCOMP_RET_ERRNO | ENOSYS); }
  void allowTheRest() { answer(SECCOMP_RET_ALLOW); }

 private:
  static constexpr std::uint32_t kForbidden = SECCOMP_RET_ERRNO | EPERM;

  void begin(int call, std::uint8_t length) {
    out_.push_back(jump(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, length));
  }
  void load(std::uint32_t offset) { out_.push_back(statement(BPF_LD | BPF_W | BPF_ABS, offset)); }
  void answer(std::uint32_t with) { out_.push_back(statement(BPF_RET | BPF_K, with)); }

  std::vector<sock_filter>& out_;
};

constexpr std::uint32_t kWritingFlags =
    O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND | (O_TMPFILE & ~O_DIRECTORY);

/// `ownIds`: where the process's own id is to be put.
void writeReadersFilter(std::vector<sock_filter>& filter, std::vector<std::size_t>& ownIds) {
  FilterWriter out(filter);
  for (const int call : kReadersCalls) out.allow(call);
  out.allowWithout(SYS_openat, 2, kWritingFlags);
#ifdef SYS_open
  out.allowWithout(SYS_open, 1, kWritingFlags);
#endif
  // The others could make the kernel send signals to any process of the user.
  out.allowOnly(SYS_fcntl, 1, {F_DUPFD, F_DUPFD_CLOEXEC, F_GETFD, F_SETFD, F_GETFL});
  out.allowOnly(SYS_ioctl, 1, {TCGETS, TIOCGWINSZ, FIONREAD});
  constexpr std::uint32_t kNameOfMemory = 0x53564d41;  // PR_SET_VMA
  out.allowOnly(SYS_prctl, 0, {PR_SET_SECCOMP, PR_GET_SECCOMP, PR_SET_NAME, kNameOfMemory});
  out.allowOnly(SYS_prlimit64, 0, {0});
#ifdef SYS_setrlimit
  out.allow(SYS_setrlimit);
#endif
  // abort() and a shell's kill send signals to the process itself.
  for (const int call : {SYS_kill, SYS_tgkill}) {
    ownIds.push_back(filter.size() + 2);
    out.allowOnly(call, 0, {0});
  }
  out.forbidTheRest();
}

bool install(sock_filter* filter, std::size_t length) {
  const sock_fprog program{static_cast<unsigned short>(length), filter};
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

/// A folder or file that is not there needs no door.
bool openDoor(int ruleset, const char* path, bool runs) {
  const int fd = open(path, O_PATH | O_CLOEXEC);
  if (fd < 0) return true;
  struct stat status {};
  bool done = fstat(fd, &status) == 0;
  LandlockDoor door{kReadFile | (runs ? kExecute : 0), fd};
  if (S_ISDIR(status.st_mode)) door.allowed |= kReadFolder;
  done = done && syscall(kAddRule, ruleset, kPathBeneath, &door, 0) == 0;
  const int error = errno;
  close(fd);
  errno = error;
  return done;
}

}  // namespace

CageParts partsOfThisKernel() {
  static const CageParts parts{versionOfLandlock(), hasSeccomp()};
  return parts;
}

std::string weaknessOf(const CageParts& parts) {
  std::string text;
  if (parts.landlock == 0) {
    text =
        "this kernel has no Landlock (Linux 5.13 and later have it): code that a model file makes "
        "the importer run could read every file that you can read";
  }
  if (!parts.seccomp) {
    text += text.empty() ? "this kernel" : "; it";
    text += " has no seccomp filters: such code could call whatever you can";
  }
  return text;
}

Cage::Cage(const std::string& program, const std::vector<std::string>& readable,
           const std::string& libraryPath)
    : parts_(partsOfThisKernel()) {
  for (const char* const system :
       {"/usr", "/lib", "/lib32", "/lib64", "/bin", "/nix/store", "/gnu/store"}) {
    doors_.push_back({system, true});
  }
  doors_.push_back({"/etc/ld.so.cache", false});
  const std::string libraries = std::string(FORETOUCH_IMPORTER_LIBRARIES) + ":" + libraryPath;
  for (std::size_t begin = 0; begin < libraries.size();) {
    const std::size_t end = std::min(libraries.find(':', begin), libraries.size());
    if (end > begin) doors_.push_back({libraries.substr(begin, end - begin), false});
    begin = end + 1;
  }
  // What a relocatable installation brings along: PREFIX/lib/foretouch, beside PREFIX/libexec.
  const auto prefix = std::filesystem::path(program).parent_path().parent_path().parent_path();
  if (!prefix.empty()) doors_.push_back({(prefix / "lib/foretouch").string(), false});
  doors_.push_back({program, true});
  for (const std::string& path : readable) doors_.push_back({path, false});
  if (parts_.seccomp) writeReadersFilter(filter_, ownIds_);
}

bool Cage::closeFiles() const {
  if (parts_.landlock == 0 || doors_.empty()) return true;
  const LandlockRules rules = everyRightOf(parts_.landlock);
  const auto ruleset = static_cast<int>(syscall(kCreateRuleset, &rules, sizeof rules, 0));
  if (ruleset < 0) return false;
  bool done = true;
  for (const Door& door : doors_) done = done && openDoor(ruleset, door.path.c_str(), door.runs);
  done = done && syscall(kRestrictSelf, ruleset, 0) == 0;
  const int error = errno;
  close(ruleset);
  errno = error;
  return done;
}

bool Cage::closeCalls() {
  if (filter_.empty()) return true;
  const auto self = static_cast<std::uint32_t>(getpid());
  for (const std::size_t at : ownIds_) filter_[at].k = self;
  return install(filter_.data(), filter_.size());
}

void closeCageBehindUs() {
  if (kArchitecture == 0 || prctl(PR_GET_SECCOMP) != SECCOMP_MODE_FILTER) return;
  std::vector<sock_filter> filter;
  FilterWriter out(filter);
  out.forbid(SYS_execve);
  out.allowWithout(SYS_mmap, 2, PROT_EXEC);
  out.allowWithout(SYS_mprotect, 2, PROT_EXEC);
  out.allowTheRest();
  // What the parent set stands without it, so that a failure here does not fail the import.
  static_cast<void>(install(filter.data(), filter.size()));
}

}  // namespace foretouch::internal
