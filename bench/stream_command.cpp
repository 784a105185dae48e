#include "bench/stream_command.h"

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/machine.h"
#include "bench/private_network.h"
#include "bench/stream.h"
#include "lss/sanitizer.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

constexpr int kMaxAvatars = 1000, kMaxWorkers = 64, kMaxProps = 1000;
constexpr double kMaxRateHz = 100'000.0;
/// Allowed growth of a service. Below the second one, growth is single pages and a few steps of the
/// heap, of 128 KiB each, which give a steep slope over minutes; a sanitizer's own books take more.
constexpr double kMostMbPerHour = 1.0, kNoGrowthMb = internal::kUnderSanitizer ? 4.0 : 0.5;

struct StreamTexts {
  std::string crowds, seconds = "10", workers = "1", place = "0,0,0,0", json, csv;
  std::string minutes = "2", garbage = "0.01", disk, props = "0", propsRate = "60";
  bool isCalm = false, isFurnished = false;
};

ExitCode runStream(const StreamTexts& texts) {
  StreamRequest request;
  Settling settle;
  settle.into(request.crowds, parseCrowds("--crowds", texts.crowds));
  settle.into(request.durationS, parsePositive("--seconds", texts.seconds));
  settle.into(request.workers, parseCount("--workers", texts.workers, kMaxWorkers));
  settle.into(request.place, parsePlacement("--place", texts.place));
  if (settle.error()) return failed(*settle.error());
  request.command = ownCommandLine();
  FORETOUCH_CHECK_OR(failed, enterPrivateNetwork());
  FORETOUCH_TRY_OR(failed, const auto bench, measureStream(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, texts.json, report.tables.front(), texts.csv));
  printOut(reportText(report));
  return ExitCode::Done;
}

ExitCode runSoak(const StreamTexts& texts) {
  SoakRequest request;
  Settling settle;
  settle.into(request.crowds, parseCrowds("--crowds", texts.crowds));
  settle.into(request.minutes, parsePositive("--minutes", texts.minutes));
  if (texts.garbage == "0") {
    request.garbageShare = 0.0;
  } else {
    settle.into(request.garbageShare, parsePositive("--garbage", texts.garbage));
  }
  settle.into(request.workers, parseCount("--workers", texts.workers, kMaxWorkers));
  settle.into(request.place, parsePlacement("--place", texts.place));
  if (texts.props != "0") {
    settle.into(request.moving.props, parseCount("--props", texts.props, kMaxProps));
    settle.into(request.moving.rateHz, parsePositive("--props-rate", texts.propsRate));
  }
  if (settle.error()) return failed(*settle.error());
  request.isCalm = texts.isCalm;
  request.moving.isFurnished = texts.isFurnished;
  if (request.moving.props > 0 && !request.isCalm) {
    return failed(Error::in("--props", ErrorCode::OutOfRange,
                            "expected --calm beside it: the senders of trouble know no world"));
  }
  request.diskPath = texts.disk;
  request.command = ownCommandLine();
  FORETOUCH_CHECK_OR(failed, enterPrivateNetwork());
  FORETOUCH_TRY_OR(failed, const auto soak, soakStream(request));
  const BenchReport& report = soak.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, texts.json, report.tables.front(), texts.csv));
  printOut(reportText(report));
  const bool isSound = soak.lost == 0 && !soak.filesGrown &&
                       (soak.slopeMbPerHour < kMostMbPerHour || soak.grownMb < kNoGrowthMb) &&
                       soak.exitCode == 0;
  if (isSound) return ExitCode::Done;
  printError("the service lost poses, grew, or did not end well: see the table");
  return ExitCode::CheckSaysNo;
}

}  // namespace

Result<std::vector<StreamCrowd>> parseCrowds(const std::string& option, const std::string& text) {
  std::vector<StreamCrowd> crowds;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::string word = text.substr(start, end - start);
    const std::size_t cross = word.find('x');
    if (cross == std::string::npos) {
      return Error::in(option, ErrorCode::Syntax,
                       "expected AVATARSxHZ,... as in 10x90,1x1000, found '" + word + "'");
    }
    FORETOUCH_TRY(const auto avatars, parseCount(option, word.substr(0, cross), kMaxAvatars));
    FORETOUCH_TRY(const auto rate, parsePositive(option, word.substr(cross + 1)));
    if (rate > kMaxRateHz) {
      return Error::in(option, ErrorCode::OutOfRange,
                       fmt::format("expected at most {} poses per second", kMaxRateHz));
    }
    crowds.push_back({avatars, rate});
    start = end + 1;
  }
  return crowds;
}

void addBenchStreamCommands(CLI::App& bench, ExitCode& exit) {
  const auto stream = std::make_shared<StreamTexts>();
  stream->crowds = "1x30,1x90,1x1000,1x10000,10x90,10x1000,50x90";
  const auto soak = std::make_shared<StreamTexts>();
  soak->crowds = "4x90,1x1000";
  const auto addShared = [](CLI::App& command, StreamTexts& texts) {
    const auto option = [&](const char* name, std::string& text, const char* type,
                            const char* help) {
      command.add_option(name, text, help)->type_name(type)->capture_default_str();
    };
    option("--crowds", texts.crowds, "NxHZ,...",
           "How many avatars, and how many poses per second each sends");
    option("--workers", texts.workers, "N", "Threads of the service that answer");
    option("--place", texts.place, "X,Y,Z[,YAW]", "Where the bundled dancer stands in the room");
    option("--json", texts.json, "FILE", "Also write the figures to a file");
    option("--csv", texts.csv, "FILE", "Also write the table to a file");
  };
  CLI::App* const streamCommand = bench.add_subcommand(
      "stream", "Pose sent to verdict received: senders and service in a private network");
  addShared(*streamCommand, *stream);
  streamCommand->add_option("--seconds", stream->seconds, "Of each crowd")
      ->type_name("S")
      ->capture_default_str();
  streamCommand->footer(
      "Example:\n  foretouch-bench stream --crowds 1x90,50x90 --json stream.json");
  streamCommand->callback([stream, &exit] { exit = runStream(*stream); });

  CLI::App* const soakCommand = bench.add_subcommand(
      "soak", "One service under load and garbage; exit code 1 where it loses, grows or leaks");
  addShared(*soakCommand, *soak);
  soakCommand->add_option("--minutes", soak->minutes, "How long")
      ->type_name("M")
      ->capture_default_str();
  soakCommand->add_option("--garbage", soak->garbage, "Datagrams of garbage per pose")
      ->type_name("SHARE")
      ->capture_default_str();
  soakCommand->add_flag("--calm", soak->isCalm,
                        "No viewers, no floods, no sender that is restarted, no log");
  soakCommand
      ->add_option("--disk", soak->disk,
                   "Folder on a small disk of its own (a tmpfs) for the service's log: the bench "
                   "fills it and empties it")
      ->type_name("FOLDER");
  soakCommand
      ->add_option("--props", soak->props,
                   "Balls that move among the avatars, in a moving world; wants --calm")
      ->type_name("N")
      ->capture_default_str();
  soakCommand->add_option("--props-rate", soak->propsRate, "Poses of all balls per second")
      ->type_name("HZ")
      ->capture_default_str();
  soakCommand->add_flag("--furniture", soak->isFurnished,
                        "With --props: in the bundled room, deep in its furniture, instead of an "
                        "empty hall");
  soakCommand->footer("Example:\n  foretouch-bench soak --minutes 150 --disk /mnt/small");
  soakCommand->callback([soak, &exit] { exit = runSoak(*soak); });
}

}  // namespace foretouch::tools
