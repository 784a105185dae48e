// LCM's own programs and our logs. They play and record from file to file: nothing is sent.
#include <cstdlib>

#include "tests/network/log/log_samples.h"

namespace foretouch::test {
namespace {

bool isInstalled(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// As it is told of by channel and payload alone: number and stamp are given anew.
bool isSameMessage(const LogEvent& a, const LogEvent& b) {
  return a.channel == b.channel && a.payload == b.payload;
}

TEST(EventLogTools, LogplayerPlaysOurs) {
  if (!isInstalled("lcm-logplayer")) GTEST_SKIP() << "lcm-logplayer is not installed";
  const TempFolder folder;
  const std::vector<LogEvent> events = numberedEvents(300, 500);
  const std::string own = writeBytes(folder, "own.lcmlog", ownLog(events));
  const std::string played = folder / "played.lcmlog";
  const std::string command = "lcm-logplayer --speed=100 --lcm-url='file://" + played +
                              "?mode=w' " + own + " >/dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  // Its block events are copies now, and so the log is one without check sums.
  const ReadLog log = readBytes(bytesOf(played));
  ASSERT_EQ(log.events.size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_TRUE(isSameMessage(log.events[i], events[i])) << i;
  }
  EXPECT_EQ(log.counts.uncheckedEvents, events.size());
  EXPECT_TRUE(log.findings.empty());
}

TEST(EventLogTools, LoggerRecordsOurs) {
  if (!isInstalled("lcm-logger")) GTEST_SKIP() << "lcm-logger is not installed";
  const TempFolder folder;
  const std::vector<LogEvent> events = numberedEvents(50, 500);
  const std::string own = writeBytes(folder, "own.lcmlog", ownLog(events));
  const std::string recorded = folder / "recorded.lcmlog";
  const std::string command = "timeout 20 lcm-logger --quiet --lcm-url='file://" + own +
                              "?speed=1' " + recorded + " >/dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  // It keeps a queue of 30 and drops what does not fit.
  const ReadLog log = readBytes(bytesOf(recorded));
  ASSERT_GT(log.events.size(), 5u);
  auto from = events.begin();
  for (const LogEvent& event : log.events) {
    from = std::find_if(from, events.end(),
                        [&](const LogEvent& written) { return isSameMessage(written, event); });
    ASSERT_NE(from, events.end());
    ++from;
  }
  EXPECT_TRUE(log.findings.empty());
}

}  // namespace
}  // namespace foretouch::test
