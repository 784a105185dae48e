// Logs as they are written and read back, ours and those of others.
#include <lcm/lcm-cpp.hpp>
#include <limits>

#include "tests/network/log/log_samples.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

std::vector<LogEvent> randomEvents(std::mt19937_64& random, int count) {
  std::vector<LogEvent> events;
  std::int64_t utimeUs = 1'600'000'000'000'000;
  for (int i = 0; i < count; ++i) {
    LogEvent event;
    event.number = i;
    utimeUs += static_cast<std::int64_t>(random() % 60'000);
    if (random() % 20 == 0) utimeUs -= 30'000;
    event.utimeUs = utimeUs;
    event.channel = std::string(1 + random() % 63, static_cast<char>('A' + random() % 26));
    const std::size_t largest = random() % 10 == 0 ? 200'000 : 2'000;
    event.payload.resize(random() % 4 == 0 ? 0 : random() % largest);
    for (std::uint8_t& byte : event.payload) byte = static_cast<std::uint8_t>(random());
    events.push_back(std::move(event));
  }
  return events;
}

TEST(EventLog, ReadsBackWhatWasWritten) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const std::vector<LogEvent> events = randomEvents(random, static_cast<int>(random() % 120));
    LogWriteOptions options;
    options.blockBytes = 1 + random() % (128u << 10);
    options.blockUs = static_cast<std::int64_t>(random() % 200'000);
    const ReadLog log = readBytes(ownLog(events, options));
    ASSERT_TRUE(log.isOpen);
    EXPECT_TRUE(log.events == events);
    EXPECT_TRUE(log.findings.empty());
    EXPECT_EQ(log.counts.events, events.size());
    EXPECT_EQ(log.counts.uncheckedEvents + log.counts.skippedBytes + log.counts.badBlocks, 0u);
    EXPECT_TRUE(log.counts.hasCheckSums);
    EXPECT_TRUE(log.counts.isClosed);
    EXPECT_EQ(log.counts.blocks > 0, !events.empty());
  }
}

TEST(EventLog, ExtremeStampsAndSizesAreLegal) {
  std::vector<LogEvent> events = numberedEvents(4, 10);
  events[0].utimeUs = std::numeric_limits<std::int64_t>::min();
  events[1].utimeUs = std::numeric_limits<std::int64_t>::max();
  events[2].utimeUs = 0;
  events[2].payload.assign(kMaxLogPayloadBytes, 0xED);
  events[2].channel = std::string(kMaxLogChannelBytes, 'c');
  const ReadLog log = readBytes(ownLog(events));
  EXPECT_TRUE(log.events == events);
  EXPECT_TRUE(log.findings.empty());
}

TEST(EventLog, WriterRefusesWhatNoReaderTakes) {
  const TempFolder folder;
  auto writer = EventLogWriter::create(folder / "a.lcmlog");
  ASSERT_TRUE(writer.ok());
  const Bytes large(kMaxLogPayloadBytes + 1);
  for (const std::string& channel :
       {std::string(), std::string("a\nb"), std::string(kMaxLogChannelBytes + 1, 'c'),
        std::string(kLogBlockChannel), std::string("a\0b", 3)}) {
    const auto written = writer.value().write(1, channel, Bytes{1});
    ASSERT_FALSE(written.ok());
    EXPECT_EQ(written.error().file, folder / "a.lcmlog");
  }
  EXPECT_FALSE(writer.value().write(1, "A", large).ok());
  EXPECT_TRUE(writer.value().write(1, "A", Bytes{}).ok());
  EXPECT_TRUE(writer.value().close().ok());
  EXPECT_TRUE(writer.value().close().ok());
  EXPECT_FALSE(writer.value().write(1, "A", Bytes{}).ok());
  const auto again = EventLogWriter::create(folder / "a.lcmlog");
  ASSERT_FALSE(again.ok());
  EXPECT_NE(again.error().message.find("exists already"), std::string::npos);
  LogWriteOptions options;
  options.blockBytes = 0;
  EXPECT_FALSE(EventLogWriter::create(folder / "b.lcmlog", options).ok());
}

TEST(EventLog, FlushedEventsCanBeReadWhileTheWriterGoesOn) {
  const TempFolder folder;
  const std::vector<LogEvent> events = numberedEvents(3, 100);
  auto writer = EventLogWriter::create(folder / "a.lcmlog");
  ASSERT_TRUE(writer.ok());
  const auto write = [&](const LogEvent& event) {
    ASSERT_TRUE(writer.value().write(event.utimeUs, event.channel, event.payload).ok());
  };
  write(events[0]);
  write(events[1]);
  ASSERT_TRUE(writer.value().flush().ok());
  write(events[2]);
  ReadLog log = readBytes(bytesOf(folder / "a.lcmlog"));
  EXPECT_TRUE(log.events == std::vector<LogEvent>(events.begin(), events.begin() + 2));
  EXPECT_FALSE(log.counts.isClosed);
  EXPECT_TRUE(log.findings.empty());
  { const EventLogWriter gone = std::move(writer).value(); }
  EXPECT_TRUE(readBytes(bytesOf(folder / "a.lcmlog")).events == events);
}

TEST(EventLog, BlocksAreClosedByTime) {
  const TempFolder folder;
  LogWriteOptions options;
  options.blockUs = 10'000;
  auto writer = EventLogWriter::create(folder / "a.lcmlog", options);
  ASSERT_TRUE(writer.ok());
  for (std::int64_t utimeUs = 0; utimeUs <= 20'000; utimeUs += 5'000) {
    ASSERT_TRUE(writer.value().write(utimeUs, "A", Bytes{1, 2}).ok());
  }
  // 0 and 5,000; 10,000 and 15,000; 20,000 waits.
  EXPECT_EQ(readBytes(bytesOf(folder / "a.lcmlog")).events.size(), 4u);
}

TEST(EventLog, ForeignLogsAreReadAsTheyAreFramed) {
  std::vector<LogEvent> events = numberedEvents(50, 300);
  events[7].payload.clear();
  const ReadLog log = readBytes(foreignLog(events));
  EXPECT_TRUE(log.events == events);
  EXPECT_EQ(log.counts.uncheckedEvents, events.size());
  EXPECT_FALSE(log.counts.hasCheckSums);
  EXPECT_TRUE(log.findings.empty());
}

TEST(EventLog, RecordedLogsOfLcmAreRead) {
  for (const char* name : {"lcm/logs/lcmcore_testlog.lcm", "lcm/logs/lcm_joint_test.lcmlog"}) {
    FORETOUCH_REQUIRE_SHARED(path, name);
    const ReadLog ours = readBytes(bytesOf(*path));
    lcm::LogFile theirs(*path, "r");
    ASSERT_TRUE(theirs.good());
    std::size_t i = 0;
    for (const lcm::LogEvent* event; (event = theirs.readNextEvent()) != nullptr; ++i) {
      ASSERT_LT(i, ours.events.size());
      EXPECT_EQ(ours.events[i].number, event->eventnum);
      EXPECT_EQ(ours.events[i].utimeUs, event->timestamp);
      EXPECT_EQ(ours.events[i].channel, event->channel);
      const auto* const data = static_cast<const std::uint8_t*>(event->data);
      EXPECT_TRUE(ours.events[i].payload == Bytes(data, data + event->datalen));
    }
    EXPECT_EQ(i, ours.events.size());
    EXPECT_GT(i, 3u);
    EXPECT_TRUE(ours.findings.empty());
  }
}

TEST(EventLog, LiblcmReadsOurs) {
  const std::vector<LogEvent> events = numberedEvents(200, 700);
  const TempFolder folder;
  lcm::LogFile theirs(writeBytes(folder, "own.lcmlog", ownLog(events)), "r");
  ASSERT_TRUE(theirs.good());
  std::size_t i = 0, checks = 0;
  for (const lcm::LogEvent* event; (event = theirs.readNextEvent()) != nullptr;) {
    if (event->channel == kLogBlockChannel) {
      ++checks;
      continue;
    }
    ASSERT_LT(i, events.size());
    EXPECT_EQ(events[i].number, event->eventnum);
    EXPECT_EQ(events[i].utimeUs, event->timestamp);
    EXPECT_EQ(events[i].channel, event->channel);
    const auto* const data = static_cast<const std::uint8_t*>(event->data);
    EXPECT_TRUE(events[i].payload == Bytes(data, data + event->datalen));
    ++i;
  }
  EXPECT_EQ(i, events.size());
  EXPECT_GE(checks, 3u);
}

TEST(EventLog, LiblcmWritesWhatWeRead) {
  const std::vector<LogEvent> events = numberedEvents(30, 100);
  const TempFolder folder;
  const std::string path = folder / "theirs.lcmlog";
  {
    lcm::LogFile theirs(path, "w");
    for (const LogEvent& event : events) {
      lcm::LogEvent written{};
      written.timestamp = event.utimeUs;
      written.channel = event.channel;
      written.datalen = static_cast<std::int32_t>(event.payload.size());
      written.data = const_cast<std::uint8_t*>(event.payload.data());
      ASSERT_EQ(theirs.writeEvent(&written), 0);
    }
  }
  EXPECT_TRUE(readBytes(bytesOf(path)).events == events);
}

}  // namespace
}  // namespace foretouch::test
