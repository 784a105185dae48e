// runLimited() through importScene(): stand-in importers that misbehave, and the limits they run
// under. They are scripts that need no other process, as the cage lets them start none.
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <sys/time.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "assets/import/process.h"
#include "assets/import/scene_import.h"
#include "assets/import/usable_memory.h"
#include "tests/assets/import_files.h"

namespace foretouch::test {
namespace {

class ImporterProcess : public testing::Test {
 protected:
  void SetUp() override {
    model_ = folder_.write("t.obj", kTriangleObj);
    descriptors_ = openDescriptors();
  }
  void TearDown() override {
    EXPECT_EQ(openDescriptors(), descriptors_);
    EXPECT_FALSE(hasChildren());
  }

  /// What becomes of an import by a script.
  Error failureWith(const std::string& body, double timeLimitS = 60.0) {
    SceneImportOptions options;
    options.importer = folder_.script("importer", body);
    options.timeLimitS = timeLimitS;
    const auto result = importScene(model_, options);
    if (result.ok()) {
      ADD_FAILURE() << "imported by: " << body;
      return {};
    }
    EXPECT_EQ(result.error().file, model_);
    return result.error();
  }
  /// A file with what the importer says of the model.
  std::string recordedAnswer() {
    const std::string path = folder_ / "answer";
    const std::string command =
        std::string(FORETOUCH_TEST_IMPORTER) + " '" + model_ + "' > '" + path + "'";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return path;
  }
  static bool contains(const Error& error, const std::string& text) {
    return error.message.find(text) != std::string::npos;
  }

  TempFolder folder_;
  std::string model_;
  std::size_t descriptors_ = 0;
};

TEST_F(ImporterProcess, IsStoppedWhenItsTimeIsOver) {
  for (const char* body :
       {"exec sleep 1000", "while :; do :; done", "trap '' TERM INT; exec sleep 1000",
        "while :; do echo noise >&2; done"}) {
    const Error error = failureWith(body, 0.3);
    EXPECT_EQ(error.code, ErrorCode::ImportCrashed) << body;
    EXPECT_TRUE(contains(error, "time limit of 0.3 seconds")) << error.message;
  }
}

TEST_F(ImporterProcess, IsReportedWithTheSignalThatKilledIt) {
  const Error error = failureWith("echo 'assertion failed' >&2; kill -SEGV $$");
  EXPECT_EQ(error.code, ErrorCode::ImportCrashed);
  EXPECT_TRUE(contains(error, "signal 11 (SIGSEGV)")) << error.message;
  EXPECT_TRUE(contains(error, "assertion failed")) << error.message;
  EXPECT_TRUE(contains(failureWith("kill -ABRT $$"), "signal 6 (SIGABRT)"));
  EXPECT_TRUE(contains(failureWith("kill -KILL $$"), "signal 9 (SIGKILL)"));
}

TEST_F(ImporterProcess, HasSpentItsTimeWhenItsCpuLimitKillsIt) {
  EXPECT_TRUE(contains(failureWith("kill -XCPU $$"), "time limit"));
}

TEST_F(ImporterProcess, MustSpeakTheProtocol) {
  EXPECT_EQ(failureWith("echo garbage").code, ErrorCode::Mismatch);
  EXPECT_EQ(failureWith("exec yes").code, ErrorCode::Mismatch);
  EXPECT_EQ(failureWith("printf 'FTIMPORT\\004\\000\\000\\000'").code, ErrorCode::Mismatch);
  EXPECT_EQ(failureWith("printf 'FTIMPORT\\003\\000\\000\\000\\004\\003\\002\\001'; exec yes").code,
            ErrorCode::ImportFailed);
}

TEST_F(ImporterProcess, MustFinishItsAnswer) {
  const Error silent = failureWith("exit 0");
  EXPECT_EQ(silent.code, ErrorCode::ImportCrashed);
  EXPECT_TRUE(contains(silent, "status 0")) << silent.message;
  EXPECT_TRUE(contains(failureWith("exit 7"), "status 7"));
  EXPECT_EQ(failureWith("printf FTIMP").code, ErrorCode::ImportCrashed);
  EXPECT_EQ(failureWith("exec head -c 100 '" + recordedAnswer() + "'").code,
            ErrorCode::ImportCrashed);
  const Error closed = failureWith("exec >&-; exec sleep 1000");
  EXPECT_EQ(closed.code, ErrorCode::ImportCrashed);
  EXPECT_TRUE(contains(closed, "ended before it was complete")) << closed.message;
}

TEST_F(ImporterProcess, IsNotWaitedForOnceItsAnswerIsComplete) {
  // Behind the answer, a pipe that this test holds open and never writes.
  const std::string pipe = folder_ / "silence";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int held = ::open(pipe.c_str(), O_RDWR | O_CLOEXEC);
  SceneImportOptions options;
  options.importer =
      folder_.script("importer", "exec cat '" + recordedAnswer() + "' '" + pipe + "'");
  EXPECT_TRUE(importScene(model_, options).ok());
  close(held);
}

TEST_F(ImporterProcess, StartsNoOther) {
  if (internal::kUnderSanitizer) GTEST_SKIP() << "no cage under sanitizers";
  const Error error = failureWith("sleep 1000 & exit 5");
  EXPECT_TRUE(contains(error, "fork")) << error.message;
}

/// Where nothing keeps it from starting others.
TEST_F(ImporterProcess, TakesWhatItStartedAlong) {
  if (!internal::kUnderSanitizer && geteuid() != 0) GTEST_SKIP() << "its user may start none";
  const std::string script = folder_.script("parent", "sleep 1000 & echo $!; exit 5");
  std::string orphan;
  const auto end =
      internal::runLimited(script, {}, {std::size_t{1} << 30, 20.0}, [&](std::string_view bytes) {
        orphan += bytes;
        return true;
      });
  ASSERT_EQ(end.kind, internal::ProcessEnd::Kind::Exited);
  EXPECT_EQ(end.code, 5);
  const std::string stat = "/proc/" + std::to_string(std::stoi(orphan));
  // Killed; who inherits it may take a moment to collect it.
  for (int i = 0; i < 2000 && std::filesystem::exists(stat); ++i) {
    std::ifstream stream(stat + "/stat");
    std::string number, name, state;
    stream >> number >> name >> state;
    if (state == "Z" || state == "X") return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_FALSE(std::filesystem::exists(stat));
}

TEST_F(ImporterProcess, RunsUnderItsLimits) {
  SceneImportOptions options;
  options.memoryLimitBytes = std::size_t{777} << 20;
  options.timeLimitS = 41.5;
  const auto limit = [&](const std::string& letter) {
    options.importer = folder_.script("importer", "ulimit -" + letter + " >&2; exit 3");
    const auto result = importScene(model_, options);
    const std::string said = result.ok() ? "" : result.error().message;
    const std::size_t at = said.find("last words: ");
    return at == std::string::npos ? said : said.substr(at + 12, said.size() - at - 13);
  };
  EXPECT_EQ(limit("t"), "42");
  EXPECT_EQ(limit("c"), "0");
  EXPECT_EQ(limit("n"), "64");
  if (internal::kUnderSanitizer) return;
  EXPECT_EQ(limit("f"), "0");
  EXPECT_EQ(limit("p"), "0");
  EXPECT_EQ(limit("v"), std::to_string(777 << 10));
  // Half of what there is, whatever is allowed.
  options.memoryLimitBytes = std::size_t{1} << 60;
  ASSERT_TRUE(internal::usableMemory().has_value());
  EXPECT_EQ(limit("v"), std::to_string(*internal::usableMemory() / 2 >> 10));
}

TEST_F(ImporterProcess, CannotWriteFiles) {
  if (internal::kUnderSanitizer) GTEST_SKIP() << "no cage under sanitizers";
  failureWith("echo x > \"$1.written\"; exit 3");
  EXPECT_FALSE(std::filesystem::exists(model_ + ".written"));
}

TEST_F(ImporterProcess, CannotGainPrivileges) {
  std::string status;
  const auto end = internal::runLimited("/usr/bin/grep", {"NoNewPrivs", "/proc/self/status"},
                                        {std::size_t{1} << 30, 20.0}, [&](std::string_view bytes) {
                                          status += bytes;
                                          return true;
                                        });
  EXPECT_EQ(end.kind, internal::ProcessEnd::Kind::Exited);
  EXPECT_EQ(status, "NoNewPrivs:\t1\n");
}

TEST_F(ImporterProcess, InheritsNoDescriptorsNorSignalSettings) {
  const int open = ::open("/dev/null", O_RDONLY);  // without O_CLOEXEC, as careless hosts do
  const int inherited = fcntl(open, F_DUPFD, 40);
  signal(SIGUSR1, SIG_IGN);
  const Error error = failureWith("[ -e /proc/$$/fd/" + std::to_string(inherited) +
                                  " ] && echo leaked >&2; kill -USR1 $$; exit 3");
  signal(SIGUSR1, SIG_DFL);
  close(open);
  close(inherited);
  EXPECT_FALSE(contains(error, "leaked")) << error.message;
  EXPECT_TRUE(contains(error, "SIGUSR1")) << error.message;  // not ignored any more
}

TEST_F(ImporterProcess, ReadsNothingFromTheHostsInput) {
  EXPECT_TRUE(contains(failureWith("read line || echo 'no input' >&2; exit 3"), "no input"));
}

TEST_F(ImporterProcess, CannotDriveTheTerminalThroughItsLastWords) {
  const Error error = failureWith("printf 'a\\033[2Jb\\n\\n' >&2; exit 3");
  EXPECT_TRUE(contains(error, "a [2Jb")) << error.message;
  const Error endless = failureWith("printf '%01000000d' 0 >&2; exit 3");
  EXPECT_LT(endless.message.size(), 1000U);
}

TEST_F(ImporterProcess, WorksInAHostThatIgnoresItsChildren) {
  signal(SIGCHLD, SIG_IGN);
  SceneImportOptions options = withImporter();
  const auto good = importScene(model_, options);
  const Error bad = failureWith("exit 3");
  signal(SIGCHLD, SIG_DFL);
  EXPECT_TRUE(good.ok());
  EXPECT_EQ(bad.code, ErrorCode::ImportCrashed);
}

TEST_F(ImporterProcess, WorksInAHostWithoutStandardStreams) {
  SceneImportOptions telling;
  telling.importer = folder_.script(
      "telling", "for i in 0 1 2; do [ -e /proc/$$/fd/$i ] || echo \"no $i\" >&2; done; exit 3");
  std::array<int, 3> kept{};
  for (int i = 0; i < 3; ++i) kept[i] = fcntl(i, F_DUPFD_CLOEXEC, 3);
  for (int i = 0; i < 3; ++i) close(i);
  const auto result = importScene(model_, withImporter());
  const auto told = importScene(model_, telling);
  for (int i = 0; i < 3; ++i) {
    dup2(kept[i], i);
    close(kept[i]);
  }
  EXPECT_TRUE(result.ok());
  ASSERT_FALSE(told.ok());
  EXPECT_TRUE(contains(told.error(), "status 3")) << told.error().message;
  EXPECT_FALSE(contains(told.error(), "no ")) << told.error().message;
}

std::atomic<int> alarms{0};

TEST_F(ImporterProcess, WorksInAHostThatSignalsInterrupt) {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<int, 3>> faces;
  for (int i = 0; i < 100'000; ++i) {
    vertices.emplace_back(static_cast<float>(i), 1.0F, 2.0F);
    faces.push_back({i, 0, 1});
  }
  const std::string path = folder_.write("many.ply", binaryPly(vertices, faces));
  struct sigaction count {};
  count.sa_handler = [](int) { ++alarms; };  // no SA_RESTART: every call may end in EINTR
  struct sigaction before {};
  sigaction(SIGALRM, &count, &before);
  const itimerval often{{0, 500}, {0, 500}}, never{};
  setitimer(ITIMER_REAL, &often, nullptr);
  const auto result = importScene(path, withImporter());
  setitimer(ITIMER_REAL, &never, nullptr);
  sigaction(SIGALRM, &before, nullptr);
  ASSERT_TRUE(result.ok()) << describe(result.error());
  EXPECT_EQ(result.value().scene.triangles.size(), 100'000U);
  EXPECT_GT(alarms, 10);
}

TEST_F(ImporterProcess, ServesSeveralThreadsAtOnce) {
  std::atomic<int> good{0}, bad{0};
  SceneImportOptions crashing;
  crashing.importer = folder_.script("crashing", "kill -SEGV $$");
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      for (int k = 0; k < 10; ++k) {
        const auto result = importScene(model_, i % 2 == 0 ? withImporter() : crashing);
        if (result.ok()) {
          good += result.value().scene.triangles.size() == 1;
        } else {
          bad += result.error().code == ErrorCode::ImportCrashed;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good, 20);
  EXPECT_EQ(bad, 20);
}

}  // namespace
}  // namespace foretouch::test
