// Damaged and hostile logs: no event that was not written is given out, and nothing runs away.
#include <sys/stat.h>
#include <unistd.h>

#include "lss/sanitizer.h"
#include "network/log/event_log_format.h"
#include "tests/network/log/log_samples.h"

namespace foretouch::test {
namespace {

LogWriteOptions smallBlocks() {
  LogWriteOptions options;
  options.blockBytes = 200;
  options.blockUs = 1'000'000'000;
  return options;
}

std::vector<std::size_t> blockEventsIn(const Bytes& log) {
  std::vector<std::size_t> offsets;
  BlockEvent event;
  for (std::size_t i = 0; i + kBlockEventBytes <= log.size(); ++i) {
    if (parseBlockEvent(log.data() + i, event) == BlockEventState::Intact) offsets.push_back(i);
  }
  return offsets;
}

Bytes without(const Bytes& log, std::size_t from, std::size_t to) {
  Bytes rest(log.begin(), log.begin() + static_cast<std::ptrdiff_t>(from));
  rest.insert(rest.end(), log.begin() + static_cast<std::ptrdiff_t>(to), log.end());
  return rest;
}

Bytes with(const Bytes& log, std::size_t at, const Bytes& more) {
  Bytes whole(log.begin(), log.begin() + static_cast<std::ptrdiff_t>(at));
  append(whole, more);
  whole.insert(whole.end(), log.begin() + static_cast<std::ptrdiff_t>(at), log.end());
  return whole;
}

TEST(EventLogDamage, NoFlippedBitChangesAnEvent) {
  const std::vector<LogEvent> events = numberedEvents(8, 30);
  const Bytes log = ownLog(events, smallBlocks());
  const std::size_t perBlock = readBytes(log).events.size() / readBytes(log).counts.blocks;
  ASSERT_GE(perBlock, 2u);
  std::size_t lost = 0, noticed = 0;
  for (std::size_t bit = 0; bit < 8 * log.size(); ++bit) {
    Bytes damaged = log;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
    const ReadLog read = readBytes(damaged);
    ASSERT_TRUE(read.isOpen) << bit;
    ASSERT_TRUE(isSubsequence(read.events, events)) << bit;
    ASSERT_LE(events.size() - read.events.size(), perBlock + 1) << bit;  // at most one block
    ASSERT_TRUE(read.counts.hasCheckSums) << bit;
    lost += read.events.size() < events.size() ? 1 : 0;
    noticed += !read.findings.empty() ? 1 : 0;
  }
  EXPECT_EQ(noticed, 8 * log.size());
  EXPECT_LT(lost, 8 * log.size());  // a flip in what opens the log costs nothing
}

TEST(EventLogDamage, EveryPrefixOpensOrSaysWhyNot) {
  const std::vector<LogEvent> events = numberedEvents(8, 30);
  const Bytes log = ownLog(events, smallBlocks());
  std::size_t before = 0;
  for (std::size_t size = 0; size <= log.size(); ++size) {
    const Bytes prefix(log.begin(), log.begin() + static_cast<std::ptrdiff_t>(size));
    for (const bool keepTail : {false, true}) {
      const ReadLog read = readBytes(prefix, keepTail);
      ASSERT_EQ(read.isOpen, size >= kBlockEventBytes) << size;
      if (!read.isOpen) {
        ASSERT_EQ(read.error.code, ErrorCode::Empty);
        continue;
      }
      ASSERT_TRUE(read.events == std::vector<LogEvent>(events.begin(),
                                                       events.begin() + static_cast<std::ptrdiff_t>(
                                                                            read.events.size())));
      ASSERT_EQ(read.counts.badBlocks, 0u) << size;
      if (keepTail) {
        ASSERT_GE(read.events.size(), before);
        before = read.events.size();
      }
    }
  }
  EXPECT_EQ(before, events.size());
}

TEST(EventLogDamage, EveryPrefixOfAForeignLogGivesWholeEvents) {
  const std::vector<LogEvent> events = numberedEvents(4, 40);
  const Bytes log = foreignLog(events);
  const std::size_t firstBytes = foreignEvent(events[0]).size();
  for (std::size_t size = 0; size <= log.size(); ++size) {
    const ReadLog read =
        readBytes(Bytes(log.begin(), log.begin() + static_cast<std::ptrdiff_t>(size)));
    ASSERT_EQ(read.isOpen, size >= firstBytes) << size;
    ASSERT_TRUE(isSubsequence(read.events, events));
    std::size_t whole = 0, end = 0;
    while (whole < events.size() && (end += foreignEvent(events[whole]).size()) <= size) ++whole;
    ASSERT_EQ(read.events.size(), whole);
  }
}

TEST(EventLogDamage, ImpossibleLengthsAreOneBadEventEach) {
  for (const std::uint32_t length : {0x7FFFFFFFu, 0xFFFFFFFFu, 0x80000000u, 0x01000001u}) {
    for (const std::size_t field : {20u, 24u}) {
      const std::vector<LogEvent> events = numberedEvents(3, 50);
      Bytes log = foreignLog(events);
      const std::size_t second = foreignEvent(events[0]).size();
      for (std::size_t i = 0; i < 4; ++i) {
        log[second + field + i] = static_cast<std::uint8_t>(length >> (24 - 8 * i));
      }
      const ReadLog read = readBytes(log);
      EXPECT_TRUE(read.events == (std::vector<LogEvent>{events[0], events[2]}));
      EXPECT_EQ(read.counts.badEvents, 1u);
      EXPECT_EQ(read.counts.skippedBytes, foreignEvent(events[1]).size());
      EXPECT_FALSE(read.counts.isTruncated);
    }
  }
}

TEST(EventLogDamage, AWrongLengthInAForeignLogCostsThatEvent) {
  const std::vector<LogEvent> events = numberedEvents(6, 50);
  Bytes log = foreignLog(events);
  log[foreignEvent(events[0]).size() + 27] += 20;  // reaches into the event behind it
  EXPECT_TRUE(readBytes(log).events ==
              (std::vector<LogEvent>{events[0], events[2], events[3], events[4], events[5]}));
}

TEST(EventLogDamage, GarbageBetweenEventsIsPassedOver) {
  const std::vector<LogEvent> events = numberedEvents(9, 60);
  Bytes garbage = numberedEvent(77, 1'000).payload;
  append(garbage, Bytes{0xED, 0xA1, 0xDA, 0x01, 0xED, 0xA1});
  Bytes foreign;
  for (const LogEvent& event : events) {
    append(foreign, garbage);
    append(foreign, foreignEvent(event));
  }
  ReadLog read = readBytes(foreign);
  EXPECT_TRUE(read.events == events);
  EXPECT_EQ(read.counts.skippedBytes, events.size() * garbage.size());

  const Bytes own = ownLog(events, smallBlocks());
  const std::vector<std::size_t> blocks = blockEventsIn(own);
  for (const std::size_t at : blocks) {  // before a block event: that block; behind it: none
    read = readBytes(with(own, at, garbage));
    EXPECT_TRUE(isSubsequence(read.events, events));
    EXPECT_GE(read.events.size() + 3, events.size());
    read = readBytes(with(own, at + kBlockEventBytes, garbage));
    EXPECT_TRUE(read.events == events) << at;
    EXPECT_TRUE(read.found(LogDamage::Skipped));
  }
}

TEST(EventLogDamage, AMissingBlockEventCostsItsBlock) {
  const std::vector<LogEvent> events = numberedEvents(12, 60);
  const Bytes own = ownLog(events, smallBlocks());
  const std::vector<std::size_t> blocks = blockEventsIn(own);
  ASSERT_GE(blocks.size(), 5u);
  const ReadLog read = readBytes(without(own, blocks[2], blocks[2] + kBlockEventBytes));
  EXPECT_TRUE(isSubsequence(read.events, events));
  EXPECT_GE(read.events.size(), events.size() - 2);
  EXPECT_LT(read.events.size(), events.size());
  EXPECT_EQ(read.counts.missingBlocks, 1u);
}

TEST(EventLogDamage, MissingAndRepeatedBlocksAreSeen) {
  const std::vector<LogEvent> events = numberedEvents(12, 60);
  const Bytes own = ownLog(events, smallBlocks());
  const std::vector<std::size_t> blocks = blockEventsIn(own);
  const std::size_t from = blocks[1] + kBlockEventBytes, to = blocks[3] + kBlockEventBytes;
  ReadLog read = readBytes(without(own, from, to));
  EXPECT_TRUE(isSubsequence(read.events, events));
  EXPECT_EQ(read.counts.missingBlocks, 2u);
  EXPECT_EQ(read.counts.badBlocks, 0u);
  const auto begin = own.begin();
  read = readBytes(with(
      own, to,
      Bytes(begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(to))));
  EXPECT_TRUE(read.events == events);
  EXPECT_EQ(read.counts.badBlocks, 2u);
  EXPECT_TRUE(read.found(LogDamage::RepeatedBlock));
}

TEST(EventLogDamage, LogsOneAfterTheOtherAreBothRead) {
  const std::vector<LogEvent> first = numberedEvents(9, 60), second = numberedEvents(5, 80);
  std::vector<LogEvent> both = first;
  both.insert(both.end(), second.begin(), second.end());
  Bytes log = ownLog(first, smallBlocks());
  const std::size_t boundary = log.size();
  append(log, ownLog(second, smallBlocks()));
  ReadLog read = readBytes(log);
  EXPECT_TRUE(read.events == both);
  EXPECT_TRUE(read.findings.empty());

  Bytes twice = ownLog(first);  // but no event of the same log is given out twice
  append(twice, Bytes(twice));
  read = readBytes(twice);
  EXPECT_TRUE(read.events == first);
  EXPECT_TRUE(read.found(LogDamage::RepeatedBlock));

  Bytes foreignFirst = foreignLog(first);
  append(foreignFirst, ownLog(second, smallBlocks()));
  read = readBytes(foreignFirst);
  EXPECT_TRUE(read.events == both);
  EXPECT_EQ(read.counts.uncheckedEvents, first.size());
  EXPECT_TRUE(read.counts.hasCheckSums);

  // Behind a torn log nothing tells another log from one inside a payload.
  log.erase(log.begin() + static_cast<std::ptrdiff_t>(boundary) - 20,
            log.begin() + static_cast<std::ptrdiff_t>(boundary));
  read = readBytes(log);
  EXPECT_TRUE(isSubsequence(read.events, first));
  EXPECT_TRUE(read.found(LogDamage::OtherLog));
}

TEST(EventLogDamage, WhatIsAppendedToALogIsATail) {
  const std::vector<LogEvent> events = numberedEvents(9, 60), more = numberedEvents(4, 10);
  Bytes log = ownLog(events, smallBlocks());
  append(log, foreignLog(more));
  ReadLog read = readBytes(log);
  EXPECT_TRUE(read.events == events);
  EXPECT_EQ(read.counts.tailEvents, more.size());
  read = readBytes(log, true);
  EXPECT_EQ(read.events.size(), events.size() + more.size());
  EXPECT_EQ(read.counts.uncheckedEvents, 0u);  // counted as what they are: a tail
}

/// A log whose payloads are logs: what a sender would plant who wants its events believed.
TEST(EventLogDamage, LogsInsidePayloadsAreNeverRead) {
  LogEvent planted = numberedEvent(0, 0);
  planted.channel = "PLANTED";
  Bytes inner = ownLog({planted, planted, planted});
  std::vector<LogEvent> events = numberedEvents(6, 40);
  events[1].payload = inner;
  append(events[1].payload, inner);
  events[4].payload = inner;
  events[5].payload = foreignEvent(planted);
  const Bytes own = ownLog(events, smallBlocks());
  ASSERT_TRUE(readBytes(own).events == events);
  for (std::size_t bit = 0; bit < 8 * own.size(); ++bit) {
    Bytes damaged = own;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
    ASSERT_TRUE(isSubsequence(readBytes(damaged).events, events)) << bit;
  }
  for (std::size_t size = kBlockEventBytes; size < own.size(); ++size) {
    const Bytes prefix(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_TRUE(isSubsequence(readBytes(prefix).events, events)) << size;
    ASSERT_TRUE(isSubsequence(readBytes(prefix, true).events, events)) << size;
  }
  const Bytes foreign = foreignLog(events);
  EXPECT_TRUE(readBytes(foreign).events == events);
  EXPECT_FALSE(readBytes(foreign).counts.hasCheckSums);
}

TEST(EventLogDamage, ARecordingOfAReplayIsAForeignLog) {
  // lcm-logplayer sends block events too, and lcm-logger numbers and stamps them anew.
  const Bytes own = ownLog(numberedEvents(5, 40));
  std::vector<LogEvent> recorded;
  for (const std::size_t at : blockEventsIn(own)) {
    LogEvent event = numberedEvent(1'000 + static_cast<std::int64_t>(recorded.size()), 0);
    event.channel = kLogBlockChannel;
    const auto payload = own.begin() + static_cast<std::ptrdiff_t>(at + kEventHeaderBytes) +
                         static_cast<std::ptrdiff_t>(event.channel.size());
    event.payload.assign(payload, payload + kBlockPayloadBytes);
    recorded.push_back(event);
    recorded.push_back(numberedEvent(2'000 + static_cast<std::int64_t>(recorded.size()), 20));
  }
  const ReadLog read = readBytes(foreignLog(recorded));
  EXPECT_EQ(read.counts.uncheckedEvents, recorded.size() / 2);
  EXPECT_FALSE(read.counts.hasCheckSums);
  EXPECT_TRUE(read.findings.empty());
}

TEST(EventLogDamage, RandomDamageNeverChangesAnEvent) {
  const std::vector<LogEvent> events = numberedEvents(60, 100);
  LogWriteOptions options = smallBlocks();
  options.blockBytes = 700;
  const Bytes own = ownLog(events, options);
  std::size_t given = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 3'000; ++seed) {
    std::mt19937_64 random(seed);
    Bytes log = own;
    for (std::uint64_t i = random() % 5; i > 0; --i) {
      const std::size_t at = random() % log.size();
      const std::size_t end = at + random() % std::min<std::size_t>(300, log.size() - at);
      switch (random() % 4) {
        case 0: log = without(log, at, end); break;
        case 1:
          log = with(log, at, numberedEvent(static_cast<std::int64_t>(seed), end - at).payload);
          break;
        case 2:
          std::fill(log.begin() + static_cast<std::ptrdiff_t>(at),
                    log.begin() + static_cast<std::ptrdiff_t>(end), std::uint8_t{0});
          break;
        default: log[at] ^= static_cast<std::uint8_t>(1 + random() % 255); break;
      }
    }
    const ReadLog read = readBytes(log);
    ASSERT_TRUE(isSubsequence(read.events, events)) << seed;
    ASSERT_EQ(read.findings.empty() && read.isOpen, read.events == events && log == own) << seed;
    given += read.events.size();
    all += events.size();
  }
  EXPECT_GT(given, all / 2);
}

TEST(EventLogDamage, TimestampJumpsAreOnlyStamps) {
  std::vector<LogEvent> events = numberedEvents(6, 10);
  events[2].utimeUs += 1'000'000'000'000'000;
  events[4].utimeUs = -5;
  EXPECT_TRUE(readBytes(ownLog(events)).events == events);
  EXPECT_TRUE(readBytes(foreignLog(events)).events == events);
}

TEST(EventLogDamage, WhatIsNoLogIsRefusedByName) {
  const TempFolder folder;
  const std::string fifo = folder / "fifo", sparse = folder / "sparse";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  folder.write("sparse", "");
  ASSERT_EQ(::truncate(sparse.c_str(), off_t{1} << 40), 0);
  struct Case {
    std::string path;
    ErrorCode code;
  };
  for (const Case& refused :
       {Case{folder.path(), ErrorCode::FileUnreadable},
        Case{folder / "absent", ErrorCode::FileNotFound},
        Case{folder.write("empty", ""), ErrorCode::Empty},
        Case{folder.write("text", "no log\n"), ErrorCode::Empty},
        Case{"/dev/zero", ErrorCode::FileUnreadable}, Case{fifo, ErrorCode::FileUnreadable},
        Case{sparse, ErrorCode::Empty}}) {
    const auto reader = EventLogReader::open(refused.path);
    ASSERT_FALSE(reader.ok()) << refused.path;
    EXPECT_EQ(reader.error().code, refused.code) << refused.path;
    EXPECT_EQ(reader.error().file, refused.path);
    EXPECT_FALSE(reader.error().message.empty());
  }
}

/// As large as a disk, and made as it is read; remembers what was asked for.
class EndlessBytes : public LogBytes {
 public:
  EndlessBytes(std::uint64_t size, Bytes pattern, std::size_t& largest, std::uint64_t& sum)
      : size_(size), pattern_(std::move(pattern)), largest_(largest), sum_(sum) {}
  [[nodiscard]] std::uint64_t size() const override { return size_; }
  Result<Done> read(std::uint64_t offset, std::uint8_t* bytes, std::size_t count) override {
    largest_ = std::max(largest_, count);
    sum_ += count;
    for (std::size_t i = 0; i < count; ++i) bytes[i] = pattern_[(offset + i) % pattern_.size()];
    return Done{};
  }

 private:
  std::uint64_t size_;
  Bytes pattern_;
  std::size_t& largest_;
  std::uint64_t& sum_;
};

TEST(EventLogDamage, EndlessGarbageStaysBounded) {
  LogEvent huge = numberedEvent(0, 0);
  const Bytes head = foreignEvent(huge);
  Bytes claim = head;  // a header that claims 16 MiB, over and over
  claim[24] = 0x01;
  const Bytes own = ownLog(numberedEvents(3, 40), smallBlocks());
  constexpr std::uint64_t kSize = 200u << 20;  // more than the largest block
  for (const Bytes& pattern : {Bytes{0}, Bytes{0xED}, Bytes{0xED, 0xA1, 0xDA, 0x01}, claim, own}) {
    std::size_t largest = 0;
    std::uint64_t sum = 0;
    const auto reader = EventLogReaderAccess::open(
        std::make_unique<EndlessBytes>(kSize, pattern, largest, sum), "endless");
    if (reader.ok()) {
      EventLogReader open = std::move(const_cast<EventLogReader&>(reader.value()));
      for (LogEvent event; open.next(event).value();) {
      }
    }
    EXPECT_LE(largest, kMaxBlockSpan + (1u << 20));
    EXPECT_LE(sum, 6 * kSize);
  }
}

}  // namespace
}  // namespace foretouch::test
