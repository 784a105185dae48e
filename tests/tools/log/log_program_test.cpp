// `foretouch log`: what it says of sound, damaged and foreign logs, and what it mends.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <sys/resource.h>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "network/log/event_log.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

using Json = nlohmann::json;

/// 20 events of 100 bytes, 10 ms apart, two of three on channel B; three to a block.
std::string writeLog(const TempFolder& folder, const std::string& name = "own.lcmlog") {
  const std::string path = folder / name;
  LogWriteOptions options;
  options.blockBytes = 400;
  auto writer = EventLogWriter::create(path, options);
  EXPECT_TRUE(writer.ok());
  for (int i = 0; i < 20; ++i) {
    const Bytes payload(100, static_cast<std::uint8_t>(i));
    EXPECT_TRUE(writer.value().write(1'000'000 + 10'000 * i, i % 3 == 0 ? "A" : "B", payload).ok());
  }
  EXPECT_TRUE(writer.value().close().ok());
  return path;
}

std::vector<int> eventsOf(const std::string& path) {
  std::vector<int> found;
  auto reader = EventLogReader::open(path);
  if (!reader.ok()) return found;
  for (LogEvent event; reader.value().next(event).value();) found.push_back(event.payload.at(0));
  return found;
}

/// One byte of the tenth event's payload is changed.
std::string damagedLog(const TempFolder& folder) {
  std::string log = contentOf(writeLog(folder));
  log[log.find(std::string(100, '\x0A')) + 50] = 'x';
  return folder.write("damaged.lcmlog", log);
}

TEST(LogProgram, InfoListsChannels) {
  const TempFolder folder;
  const Ended ended = runForetouch({"log", "info", writeLog(folder)});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  for (const char* part : {"with check sums", "blocks are right", "1000000 to 1190000 us, 0.190 s",
                           "A                                 7 events",
                           "B                                13 events"}) {
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  }
}

TEST(LogProgram, InfoAsJsonIsComplete) {
  const TempFolder folder;
  const Ended ended = runForetouch({"log", "info", "--json", writeLog(folder)});
  EXPECT_EQ(ended.exitCode, 0);
  const Json told = Json::parse(ended.out);
  EXPECT_EQ(told["state"], "sound");
  EXPECT_EQ(told["counts"]["events"], 20);
  EXPECT_EQ(told["counts"]["check_sums"], true);
  EXPECT_EQ(told["counts"]["closed"], true);
  ASSERT_EQ(told["channels"].size(), 2u);
  EXPECT_EQ(told["channels"][0]["channel"], "A");
  EXPECT_EQ(told["channels"][0]["events"], 7);
  EXPECT_EQ(told["channels"][0]["payload_bytes"], 700);
  // 7 events, 30 ms apart.
  EXPECT_DOUBLE_EQ(told["channels"][0]["rate_hz"].get<double>(), 6 / 0.18);
  EXPECT_EQ(told["channels"][1]["events"], 13);
}

TEST(LogProgram, CheckSaysWhatIsDamagedAndWhere) {
  const TempFolder folder;
  const std::string damaged = damagedLog(folder);
  const std::string sound = writeLog(folder, "sound.lcmlog");
  EXPECT_EQ(runForetouch({"log", "check", sound}).exitCode, 0);
  Ended ended = runForetouch({"log", "check", sound, damaged});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_NE(ended.err.find("bad block"), std::string::npos) << ended.err;
  EXPECT_NE(ended.out.find("sound.lcmlog: sound, 20 events"), std::string::npos) << ended.out;
  ended = runForetouch({"log", "check", "--json", damaged});
  EXPECT_EQ(ended.exitCode, 1);
  const Json told = Json::parse(ended.out);
  ASSERT_EQ(told["findings"].size(), 1u);
  EXPECT_EQ(told["findings"][0]["damage"], "bad block");
  const auto offset = told["findings"][0]["offset"].get<std::size_t>();
  const auto bytes = told["findings"][0]["bytes"].get<std::size_t>();
  const std::size_t changed = contentOf(damaged).find(std::string(50, '\x0A') + 'x') + 50;
  EXPECT_LE(offset, changed);
  EXPECT_GT(offset + bytes, changed);
  EXPECT_EQ(told["counts"]["bad_blocks"], 1);
}

TEST(LogProgram, CheckNamesWhatIsNoLog) {
  const TempFolder folder;
  for (const std::string& path : {folder / "absent", folder.write("text", "hello"),
                                  folder.write("empty", ""), folder.path()}) {
    const Ended ended = runForetouch({"log", "check", path});
    EXPECT_EQ(ended.exitCode, 2) << path;
    EXPECT_EQ(ended.err.rfind("foretouch: " + path, 0), 0u) << ended.err;
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_EQ(runForetouch({"log", "info", path}).exitCode, 2);
  }
  const Ended ended = runForetouch({"log", "check", "--json", folder / "absent"});
  EXPECT_EQ(Json::parse(ended.out)["state"], "unreadable");
}

TEST(LogProgram, RecoverWritesWhatCanBeTrusted) {
  const TempFolder folder;
  const std::string damaged = damagedLog(folder), output = folder / "whole.lcmlog";
  const std::vector<int> trusted = eventsOf(damaged);
  ASSERT_GE(trusted.size(), 17u);
  ASSERT_LT(trusted.size(), 20u);
  Ended ended = runForetouch({"log", "recover", damaged, "-o", output});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("bad blocks"), std::string::npos) << ended.out;
  EXPECT_EQ(eventsOf(output), trusted);
  EXPECT_EQ(runForetouch({"log", "check", output}).exitCode, 0);
  // Never over anything.
  ended = runForetouch({"log", "recover", damaged, "-o", output});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("exists already"), std::string::npos);
  EXPECT_EQ(runForetouch({"log", "recover", damaged, "-o", damaged}).exitCode, 2);
}

TEST(LogProgram, RecoverKeepsATailIfAsked) {
  const TempFolder folder;
  const std::string log = contentOf(writeLog(folder));
  // Cut within the eighth event or the one behind it, in the middle of a block.
  const std::size_t tail = log.find(std::string(100, '\x07'));
  const std::string torn = folder.write("torn.lcmlog", log.substr(0, tail + 150));
  const std::size_t trusted = eventsOf(torn).size();
  EXPECT_EQ(runForetouch({"log", "check", torn}).exitCode, 1);
  EXPECT_EQ(runForetouch({"log", "recover", torn, "-o", folder / "a"}).exitCode, 0);
  EXPECT_EQ(eventsOf(folder / "a").size(), trusted);
  EXPECT_EQ(runForetouch({"log", "recover", torn, "-o", folder / "b", "--keep-tail"}).exitCode, 0);
  EXPECT_GT(eventsOf(folder / "b").size(), trusted);
}

/// As LCM's own tools write logs: `change` edits the list of (number, stamp, channel, payload).
template <typename Change>
std::string rewritten(const std::string& log, const Change& change) {
  std::vector<LogEvent> events;
  for (std::size_t at = 0; at + 28 <= log.size();) {
    const auto whole = [&](std::size_t from, int bytes) {
      std::int64_t value = 0;
      for (int i = 0; i < bytes; ++i) {
        value = value << 8 | static_cast<unsigned char>(log[from + static_cast<std::size_t>(i)]);
      }
      return value;
    };
    LogEvent event;
    event.number = whole(at + 4, 8);
    event.utimeUs = whole(at + 12, 8);
    const auto channel = static_cast<std::size_t>(whole(at + 20, 4));
    const auto payload = static_cast<std::size_t>(whole(at + 24, 4));
    event.channel = log.substr(at + 28, channel);
    const std::string bytes = log.substr(at + 28 + channel, payload);
    event.payload.assign(bytes.begin(), bytes.end());
    events.push_back(event);
    at += 28 + channel + payload;
  }
  change(events);
  std::string text;
  const auto add = [&](std::int64_t value, int bytes) {
    for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xFF);
  };
  for (const LogEvent& event : events) {
    text += "\xED\xA1\xDA\x01";
    add(event.number, 8);
    add(event.utimeUs, 8);
    add(static_cast<std::int64_t>(event.channel.size()), 4);
    add(static_cast<std::int64_t>(event.payload.size()), 4);
    text += event.channel + std::string(event.payload.begin(), event.payload.end());
  }
  return text;
}

TEST(LogProgram, WhatOtherToolsHaveRewrittenIsRecoveredIfAsked) {
  const TempFolder folder;
  const std::string log = contentOf(writeLog(folder));
  const std::vector<int> all = eventsOf(folder / "own.lcmlog");
  const std::string renumbered = rewritten(log, [](std::vector<LogEvent>& events) {
    for (LogEvent& event : events) event.number = 0;
  });
  const std::string shuffled = rewritten(log, [](std::vector<LogEvent>& events) {
    for (std::size_t i = 1; i + 1 < events.size(); i += 2) std::swap(events[i], events[i + 1]);
  });
  for (const std::string& text : {renumbered, shuffled}) {
    const TempFolder place;
    const std::string other = place.write("other.lcmlog", text);
    Ended ended = runForetouch({"log", "recover", other, "-o", place / "out"});
    EXPECT_EQ(ended.exitCode, 1) << "nothing of it can be trusted";
    EXPECT_NE(ended.err.find("--unchecked"), std::string::npos) << ended.err;
    EXPECT_LE(std::count(ended.err.begin(), ended.err.end(), '\n'), 12) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(place / "out"));
    ended = runForetouch({"log", "recover", other, "-o", place / "out", "--unchecked"});
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_NE(ended.out.find("nothing shows that these are all"), std::string::npos) << ended.out;
    EXPECT_EQ(eventsOf(place / "out"), all);
    EXPECT_EQ(runForetouch({"log", "check", place / "out"}).exitCode, 0);
  }
}

TEST(LogProgram, RecoverLeavesNothingHalfDone) {
  const TempFolder folder;
  const std::string log = writeLog(folder);
  Ended ended = runForetouch({"log", "recover", log, "-o", folder / "absent/out"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("absent/out"), std::string::npos);

  // Both are inherited: no file larger than that, and no signal where one would be.
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit whole = limit;
  limit.rlim_cur = 1'000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  ended = runForetouch({"log", "recover", log, "-o", folder / "out"});
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &whole), 0);
  static_cast<void>(std::signal(SIGXFSZ, before));
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("File too large"), std::string::npos) << ended.err;
  EXPECT_EQ(folder.names(), (std::set<std::string>{"own.lcmlog"}));
}

TEST(LogProgram, ConvertSaysWhatADamagedLogHasLost) {
  const TempFolder folder;
  const std::string out = folder / "events.jsonl";
  const auto linesIn = [&] {
    const std::string text = contentOf(out);
    return std::count(text.begin(), text.end(), '\n');
  };
  Ended ended = runForetouch({"log", "convert", damagedLog(folder), "-o", out});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_EQ(linesIn(), 17);
  for (const char* part :
       {": bad block\n", "events 9 to 11 are missing: between stamps 1080000 and 1120000 us\n",
        "damaged: 17 events were read; lost: 1 bad block, 3 events, 387 bytes\n"}) {
    EXPECT_NE(ended.err.find("damaged.lcmlog: "), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find(part), std::string::npos) << part << "\n" << ended.err;
  }

  const std::string log = contentOf(writeLog(folder, "sound.lcmlog"));
  const std::size_t tail = log.find(std::string(100, '\x07'));
  ended = runForetouch(
      {"log", "convert", folder.write("cut.lcmlog", log.substr(0, tail + 150)), "-o", out});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_EQ(linesIn(), 6);
  EXPECT_NE(ended.err.find("nothing is read after event 5, stamp 1050000 us"), std::string::npos)
      << ended.err;

  // Cut behind a block: as of a writer that was stopped, or is writing still.
  ended = runForetouch(
      {"log", "convert", folder.write("open.lcmlog", log.substr(0, tail - 29 - 129)), "-o", out});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(linesIn(), 6);
  EXPECT_NE(ended.err.find("not closed"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace foretouch::test
