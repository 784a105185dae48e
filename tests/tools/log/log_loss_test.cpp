#include "tools/log/log_loss.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/network/log/log_samples.h"

namespace foretouch::tools {
namespace {

using test::numberedEvents;

/// What is said of a log of these bytes, a line each, and how much of it was read.
struct Account {
  LogLoss loss;
  std::size_t events = 0;
  std::string text;
};

Account accountOf(const Bytes& log) {
  const test::TempFolder folder;
  const std::string path = test::writeBytes(folder, "a.lcmlog", log);
  Account account;
  const auto read =
      readEvents(path, account.loss, [&](const LogEvent&, const EventLogReader&) -> Result<bool> {
        ++account.events;
        return true;
      });
  EXPECT_TRUE(read.ok()) << describe(read.error());
  for (const std::string& line : account.loss.lines()) account.text += line + "\n";
  return account;
}

/// Three events per block.
Bytes ownLogOf(int events) {
  LogWriteOptions options;
  options.blockBytes = 400;
  return test::ownLog(numberedEvents(events, 90), options);
}

TEST(LogLoss, IsNoneForASoundLog) {
  for (const Bytes& log : {ownLogOf(20), test::foreignLog(numberedEvents(20, 90))}) {
    const Account account = accountOf(log);
    EXPECT_EQ(account.events, 20u);
    EXPECT_FALSE(account.loss.any());
    EXPECT_EQ(account.text, "");
  }
}

TEST(LogLoss, SaysWhichEventsAndBytesAreMissing) {
  Bytes log = ownLogOf(20);
  const Bytes payload = test::numberedEvent(10, 90).payload;
  const auto at = std::search(log.begin(), log.end(), payload.begin(), payload.end());
  ASSERT_NE(at, log.end());
  *at ^= 1;
  const Account account = accountOf(log);
  EXPECT_TRUE(account.loss.any());
  EXPECT_NE(account.text.find(": bad block\n"), std::string::npos) << account.text;
  EXPECT_NE(account.text.find("events 9 to 11 are missing: between stamps 1700000000008000 and "
                              "1700000000012000 us\n"),
            std::string::npos)
      << account.text;
  // Three events of 28 bytes, the channel and 90 bytes: 14 characters each of event 9, 13 else.
  EXPECT_NE(account.text.find("damaged: 17 events were read; lost: 1 bad block, 3 events, 394 "
                              "bytes\n"),
            std::string::npos)
      << account.text;
}

TEST(LogLoss, SaysWhereACutLogEnds) {
  Bytes log = ownLogOf(20);
  const Bytes payload = test::numberedEvent(13, 90).payload;
  log.erase(std::search(log.begin(), log.end(), payload.begin(), payload.end()) + 50, log.end());
  const Account account = accountOf(log);
  EXPECT_EQ(account.events, 12u);
  for (const char* part : {"unchecked tail of 1 events", ": truncated\n",
                           "nothing is read after event 11, stamp 1700000000011000 us\n",
                           "damaged: 12 events were read; lost: 1 event, "}) {
    EXPECT_NE(account.text.find(part), std::string::npos) << part << "\n" << account.text;
  }
}

TEST(LogLoss, BelievesNumbersWithoutCheckSumsIfTheyFitIntoTheBytes) {
  const std::vector<LogEvent> events = numberedEvents(20, 90);
  Bytes log;
  for (const LogEvent& event : events) {
    Bytes bytes = test::foreignEvent(event);
    if (event.number == 7) bytes[0] ^= 0xFF;
    test::append(log, bytes);
  }
  EXPECT_NE(accountOf(log).text.find("event 7 is missing: between stamps"), std::string::npos)
      << accountOf(log).text;

  log.clear();
  for (LogEvent event : events) {
    if (event.number > 7) event.number += 1'000'000'000;
    Bytes bytes = test::foreignEvent(event);
    if (event.number == 7) bytes[0] ^= 0xFF;
    test::append(log, bytes);
  }
  const Account account = accountOf(log);
  EXPECT_TRUE(account.loss.any());
  EXPECT_EQ(account.text.find("missing"), std::string::npos) << account.text;
}

TEST(LogLoss, IsSilentAboutNoEventThatACutTookAway) {
  const Bytes log = ownLogOf(12);
  int silent = 0;
  for (std::size_t size = 200; size < log.size(); ++size) {
    const Account account = accountOf(Bytes(log.begin(), log.begin() + size));
    if (account.loss.any()) continue;
    // A cut behind a block's check sum is like a writer that was stopped there: not closed.
    EXPECT_FALSE(account.loss.counts().isClosed) << size;
    EXPECT_EQ(account.events % 3, 0u) << size;
    ++silent;
  }
  EXPECT_LE(silent, 4);
}

TEST(LogLoss, TellsFewLinesOfManyDamages) {
  const std::vector<LogEvent> events = numberedEvents(400, 90);
  Bytes log;
  for (const LogEvent& event : events) {
    Bytes bytes = test::foreignEvent(event);
    if (event.number % 4 == 1) bytes[0] ^= 0xFF;
    test::append(log, bytes);
  }
  const Account account = accountOf(log);
  EXPECT_EQ(account.events, 300u);
  EXPECT_EQ(account.loss.lines().size(), LogLoss::kMaxTold + 2);
  EXPECT_NE(account.text.find("and 190 more: foretouch log check lists them"), std::string::npos)
      << account.text;
  EXPECT_NE(account.text.find("300 events were read; lost: 100 events, "), std::string::npos)
      << account.text;
}

}  // namespace
}  // namespace foretouch::tools
