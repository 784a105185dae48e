// Writers that are killed, and disks that are full.
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/network/log/log_kill_trial.h"
#include "tests/network/log/log_samples.h"

namespace foretouch::test {
namespace {

TEST(EventLogFaults, AKilledWriterLosesAtMostItsLastBlock) {
  const TempFolder folder;
  KillTally tally;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(runKillTrial(folder.path(), seed, tally), "") << seed;
  }
  EXPECT_GT(tally.events, 0u);
}

constexpr char kSkipped[] = "skipped: ";

/// Runs `body` in a process of its own; what it returns, or how that process ended.
std::string inProcess(const std::function<std::string()>& body) {
  int ends[2];
  if (::pipe(ends) != 0) return "no pipe";
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    const std::string said = body();
    const bool isSaid = ::write(ends[1], said.data(), said.size()) >= 0;
    ::_exit(isSaid ? 0 : 1);
  }
  ::close(ends[1]);
  std::string said;
  char bytes[512];
  for (ssize_t count; (count = ::read(ends[0], bytes, sizeof bytes)) > 0;) {
    said.append(bytes, static_cast<std::size_t>(count));
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status == 0 ? said : "ended with status " + std::to_string(status);
}

/// Writes until there is no more room, then makes room and goes on.
std::string fillAndGoOn(const std::string& path, const std::string& reason,
                        const std::function<void()>& makeRoom) {
  LogWriteOptions options;
  options.blockBytes = 8u << 10;
  auto writer = EventLogWriter::create(path, options);
  if (!writer.ok()) return describe(writer.error());
  std::vector<LogEvent> taken;
  int refused = 0, wrongTexts = 0;
  constexpr int kRefusals = 30, kEvents = 2'000;
  for (std::int64_t number = 0; number < kEvents; ++number) {
    LogEvent event = numberedEvent(number, 900);
    const auto written = writer.value().write(event.utimeUs, event.channel, event.payload);
    if (written.ok()) {
      event.number = static_cast<std::int64_t>(taken.size());
      taken.push_back(event);
      continue;
    }
    const Error& error = written.error();
    wrongTexts += error.file == path && error.message.find(reason) != std::string::npos ? 0 : 1;
    ++refused;
    const ReadLog log = readBytes(bytesOf(path));
    if (!log.findings.empty()) return "damage after a refusal";
    if (!isSubsequence(log.events, taken)) return "another event after a refusal";
    if (refused == kRefusals) makeRoom();
  }
  if (refused != kRefusals) return "refused " + std::to_string(refused) + " events";
  if (wrongTexts > 0) return "a refusal does not say why";
  if (!writer.value().close().ok()) return "not closed";
  const ReadLog log = readBytes(bytesOf(path));
  if (!log.findings.empty() || !log.counts.isClosed) return "damage in the end";
  return log.events == taken ? "" : "not the events that were taken";
}

TEST(EventLogFaults, AFullFileSystemLosesOnlyWhatWasRefused) {
  const TempFolder folder;
  const std::string said = inProcess([&]() -> std::string {
    if (::unshare(CLONE_NEWNS) != 0 ||
        ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("none", folder.path().c_str(), "tmpfs", 0, "size=1m") != 0) {
      return std::string(kSkipped) + "no mount namespace here";
    }
    const std::string ballast = folder.write("ballast", std::string(600'000, 'b'));
    const std::string failure = fillAndGoOn(folder / "a.lcmlog", "No space left on device", [&] {
      static_cast<void>(::unlink(ballast.c_str()));
      static_cast<void>(::mount("none", folder.path().c_str(), "tmpfs", MS_REMOUNT, "size=8m"));
    });
    static_cast<void>(::umount2(folder.path().c_str(), MNT_DETACH));
    return failure;
  });
  if (said.rfind(kSkipped, 0) == 0) GTEST_SKIP() << said;
  EXPECT_EQ(said, "");
}

TEST(EventLogFaults, AFileSizeLimitLosesOnlyWhatWasRefused) {
  const TempFolder folder;
  EXPECT_EQ(inProcess([&]() -> std::string {
              static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
              rlimit limit{};
              ::getrlimit(RLIMIT_FSIZE, &limit);
              const rlim_t whole = limit.rlim_max;
              limit.rlim_cur = 100'003;
              ::setrlimit(RLIMIT_FSIZE, &limit);
              return fillAndGoOn(folder / "a.lcmlog", "File too large", [&] {
                limit.rlim_cur = whole;
                ::setrlimit(RLIMIT_FSIZE, &limit);
              });
            }),
            "");
}

TEST(EventLogFaults, AFullDiskAtTheStartOrTheEndCanBeTriedAgain) {
  const TempFolder folder;
  EXPECT_EQ(inProcess([&]() -> std::string {
              static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
              rlimit limit{};
              ::getrlimit(RLIMIT_FSIZE, &limit);
              const rlim_t whole = limit.rlim_max;
              const auto allow = [&](rlim_t bytes) {
                limit.rlim_cur = bytes;
                ::setrlimit(RLIMIT_FSIZE, &limit);
              };
              auto writer = EventLogWriter::create(folder / "a.lcmlog");
              if (!writer.ok()) return describe(writer.error());
              allow(10);
              if (writer.value().write(7, "A", Bytes{1}).ok()) return "written to no room";
              if (!bytesOf(folder / "a.lcmlog").empty()) return "remains";
              allow(whole);
              if (!writer.value().write(8, "A", Bytes{2}).ok()) return "not tried again";
              allow(200);
              if (writer.value().flush().ok() || writer.value().close().ok()) return "closed";
              allow(whole);
              if (!writer.value().close().ok()) return "not closed again";
              const ReadLog log = readBytes(bytesOf(folder / "a.lcmlog"));
              const bool isRight = log.events.size() == 1 && log.events[0].utimeUs == 8 &&
                                   log.findings.empty() && log.counts.isClosed;
              return isRight ? "" : "another log";
            }),
            "");
}

TEST(EventLogFaults, AFullDeviceIsNamed) {
  // Always full; and no new file, so refused as one that exists.
  const auto writer = EventLogWriter::create("/dev/full");
  ASSERT_FALSE(writer.ok());
  const TempFolder folder;
  const auto nowhere = EventLogWriter::create(folder / "absent/a.lcmlog");
  ASSERT_FALSE(nowhere.ok());
  EXPECT_EQ(nowhere.error().code, ErrorCode::FileUnwritable);
  EXPECT_NE(nowhere.error().message.find("No such file"), std::string::npos);
}

}  // namespace
}  // namespace foretouch::test
