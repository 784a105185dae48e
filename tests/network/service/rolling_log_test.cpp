#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/stat.h>
#include <vector>

#include <gtest/gtest.h>

#include "network/log/event_log.h"
#include "network/service/journal.h"
#include "tests/network/service/service_stage.h"
#include "tests/support/temp_folder.h"

namespace foretouch {
namespace {

namespace fs = std::filesystem;

/// Channels of a log's events, in order.
std::vector<std::string> channelsIn(const std::string& path) {
  auto reader = EventLogReader::open(path);
  EXPECT_TRUE(reader.ok()) << path;
  std::vector<std::string> channels;
  if (!reader.ok()) return channels;
  for (LogEvent event; reader.value().next(event).value();) channels.push_back(event.channel);
  EXPECT_TRUE(reader.value().counts().isClosed) << path;
  return channels;
}

TEST(RollingLog, IsBoundedAndLosesOnlyItsOldestFiles) {
  const test::TempFolder folder;
  LogLimits limits;
  limits.bytes = 20'000;
  limits.files = 3;
  auto sink = createLogSink(folder / "a.lcmlog", limits, test::kSkeletons);
  ASSERT_TRUE(sink.ok());
  const Bytes skeleton = test::skeletonOf(0), pose = test::poseOf(0, 1);
  ASSERT_TRUE(sink.value()->write(1, test::kSkeletons, skeleton).ok());
  const std::size_t poses = 10 * limits.bytes / pose.size();
  for (std::size_t i = 0; i < poses; ++i) {
    ASSERT_TRUE(sink.value()->write(1, test::kPoses, pose).ok());
  }
  ASSERT_TRUE(sink.value()->close().ok());
  std::size_t kept = 0, files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(folder / "a").parent_path())) {
    ++files;
    const std::vector<std::string> channels = channelsIn(entry.path().string());
    ASSERT_FALSE(channels.empty());
    EXPECT_EQ(channels.front(), test::kSkeletons) << entry.path();
    kept += channels.size() - 1;
    EXPECT_LE(entry.file_size(), limits.bytes + 2000);  // the check sums of its blocks
  }
  EXPECT_EQ(files, 3U);
  EXPECT_FALSE(fs::exists(folder / "a.lcmlog"));
  EXPECT_GT(kept, 2 * limits.bytes / (pose.size() + 100));
}

TEST(RollingLog, PassesOverFilesThatAreThere) {
  const test::TempFolder folder;
  folder.write("a.2.lcmlog", "something else");
  fs::create_symlink("nowhere", folder / "a.3.lcmlog");
  LogLimits limits;
  limits.bytes = 2000;
  limits.files = 2;
  auto sink = createLogSink(folder / "a.lcmlog", limits, test::kSkeletons);
  ASSERT_TRUE(sink.ok());
  const Bytes pose = test::poseOf(0, 1);
  const std::size_t poses = 5 * limits.bytes / pose.size();
  for (std::size_t i = 0; i < poses; ++i) {
    ASSERT_TRUE(sink.value()->write(1, test::kPoses, pose).ok());
  }
  ASSERT_TRUE(sink.value()->close().ok());
  std::ifstream other(folder / "a.2.lcmlog");
  EXPECT_EQ(std::string((std::istreambuf_iterator<char>(other)), {}), "something else");
  EXPECT_TRUE(fs::is_symlink(folder / "a.3.lcmlog"));
  EXPECT_FALSE(fs::exists(folder / "nowhere"));
  int logs = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(folder / "a").parent_path())) {
    const std::string name = entry.path().filename().string();
    if (name == "a.2.lcmlog" || name == "a.3.lcmlog") continue;
    ++logs;
    EXPECT_FALSE(channelsIn(entry.path().string()).empty());
  }
  EXPECT_EQ(logs, 2);
}

TEST(RollingLog, GoesOnOnceThereIsAPlace) {
  const test::TempFolder folder;
  fs::create_directory(folder / "logs");
  LogLimits limits;
  limits.bytes = 2000;
  auto sink = createLogSink(folder / "logs/a.lcmlog", limits, test::kSkeletons);
  ASSERT_TRUE(sink.ok());
  fs::rename(folder / "logs", folder / "elsewhere");
  const Bytes pose = test::poseOf(0, 1);
  bool isRefused = false;
  for (int i = 0; i < 20; ++i) {
    isRefused = isRefused || !sink.value()->write(1, test::kPoses, pose).ok();
  }
  EXPECT_TRUE(isRefused);
  fs::create_directory(folder / "logs");
  EXPECT_TRUE(sink.value()->write(1, test::kPoses, pose).ok());
  EXPECT_TRUE(sink.value()->close().ok());
  EXPECT_EQ(channelsIn(folder / "logs/a.2.lcmlog").size(), 1U);
}

TEST(EventLog, IsItsOwnersAlone) {
  const test::TempFolder folder;
  auto writer = EventLogWriter::create(folder / "a.lcmlog");
  ASSERT_TRUE(writer.ok());
  struct stat facts {};
  ASSERT_EQ(::stat((folder / "a.lcmlog").c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777, 0600U);
}

}  // namespace
}  // namespace foretouch
