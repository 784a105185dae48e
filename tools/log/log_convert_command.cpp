#include "tools/log/log_convert_command.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "assets/text_file.h"
#include "network/log/event_log.h"
#include "tools/arguments.h"
#include "tools/inputs/numbered_avatars.h"
#include "tools/interrupt.h"
#include "tools/log/log_inspection.h"
#include "tools/log/log_loss.h"
#include "tools/log/log_to_bvh.h"
#include "tools/log/replay_log.h"
#include "tools/progress.h"
#include "tools/results_output.h"
#include "tools/stream/channel_names.h"
#include "tools/stream/event_line.h"
#include "tools/stream/publish_command.h"

namespace foretouch::tools {
namespace {

/// Values as typed in.
struct ConvertTexts {
  std::string input, output, avatar, suffix;
};

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// What was written, for a person.
using Told = Result<std::string>;

Told toJsonLines(const ConvertTexts& texts, LogLoss& loss) {
  const auto channels = channelNames(texts.suffix);
  if (!channels.ok()) return channels.error();
  const InterruptGuard guard;
  auto file = PendingFile::create(texts.output);
  if (!file.ok()) return file.error();
  ProgressBar progress("convert", 100);
  std::int64_t events = 0;
  const auto write = [&](const LogEvent& event, const EventLogReader& log) -> Result<bool> {
    file.value().write(eventLine(event, channels.value()));
    ++events;
    if (log.size() > 0) {
      progress.advanceTo(static_cast<std::int64_t>(100 * log.position() / log.size()));
    }
    return !guard.requested();
  };
  const auto read = readEvents(texts.input, loss, write);
  if (!read.ok()) return read.error();
  if (guard.requested()) return std::string();
  const auto written = file.value().commit();
  if (!written.ok()) return written.error();
  return fmt::format("{} events", events);
}

Told toBvh(const ConvertTexts& texts, LogLoss& loss) {
  LogToBvhRequest request{texts.input, texts.suffix, 1};
  if (!texts.avatar.empty()) {
    const auto id = parseAvatarId("--avatar", texts.avatar);
    if (!id.ok()) return id.error();
    request.avatar = id.value();
  }
  const auto bvh = logToBvh(request, loss);
  if (!bvh.ok()) return bvh.error();
  for (const std::string& note : bvh.value().notes) printNote(texts.input + ": " + note);
  const InterruptGuard guard;
  auto file = PendingFile::create(texts.output);
  if (!file.ok()) return file.error();
  file.value().write(bvh.value().text);
  const auto written = file.value().commit();
  if (!written.ok()) return written.error();
  return fmt::format("{} frames of avatar {}, in metres", bvh.value().frames, request.avatar);
}

Told toLog(const ConvertTexts& texts) {
  const auto avatars = parseNumberedAvatars("--avatar", {texts.avatar});
  if (!avatars.ok()) return avatars.error();
  const auto channels = channelNames(texts.suffix);
  if (!channels.ok()) return channels.error();
  PublishRequest request;
  request.avatarPath = avatars.value().front().path;
  request.motionPath = texts.input;
  PublishOptions options;
  options.channels = channels.value();
  options.sender.avatar = avatars.value().front().id;
  options.sender.source = "foretouch log convert";
  options.sender.startUtimeUs = utimeNow();
  const auto report = publishToLog(request, options, texts.output);
  if (!report.ok()) return report.error();
  return fmt::format("{} poses and {} skeletons of avatar {}", report.value().poses,
                     report.value().skeletons, options.sender.avatar);
}

Told convert(const ConvertTexts& texts, LogLoss& loss) {
  const std::string extension = extensionOf(texts.output);
  const bool isLog = isEventLog(texts.input);
  const auto separate = checkIsNoInput(texts.output, {texts.input});
  if (!separate.ok()) return separate.error();
  if (isLog && extension == ".jsonl" && !texts.avatar.empty()) {
    return Error{ErrorCode::Mismatch, "--avatar", -1, -1,
                 "makes no sense with lines of JSON, which hold every avatar; expected none"};
  }
  if (isLog && extension == ".jsonl") return toJsonLines(texts, loss);
  if (isLog && extension == ".bvh") return toBvh(texts, loss);
  if (!isLog && extension == ".lcmlog" && texts.avatar.empty()) {
    return Error{ErrorCode::Empty, "--avatar", -1, -1,
                 "expected the avatar file that the clip moves"};
  }
  if (!isLog && extension == ".lcmlog") return toLog(texts);
  return Error{ErrorCode::Mismatch, "--output", -1, -1,
               isLog
                   ? "expected a file that ends in .bvh or .jsonl, found " + inQuotes(texts.output)
                   : "expected a file that ends in .lcmlog, as " + inQuotes(texts.input) +
                         " is no event log, found " + inQuotes(texts.output)};
}

ExitCode runTexts(const ConvertTexts& texts) {
  LogLoss loss;
  const auto told = convert(texts, loss);
  for (const std::string& line : loss.lines()) printError(texts.input + ": " + line);
  if (!loss.any() && loss.counts().hasCheckSums && !loss.counts().isClosed) {
    printNote(texts.input + ": " + formatOf(loss.counts()));
  }
  if (!told.ok()) return failed(told.error());
  const std::string text = texts.output + ": " + told.value() + "\n";
  isStandardOutput(texts.output) ? printAside(text) : printOut(text);
  return loss.any() ? ExitCode::CheckSaysNo : ExitCode::Done;
}

constexpr char kConvertExamples[] = R"(Examples:
  foretouch log convert today.lcmlog --output today.jsonl
  foretouch log convert today.lcmlog --avatar 2 --output ben.bvh
  foretouch log convert dancer.bvh --avatar dancer.avatar.json --output dancer.lcmlog

foretouch publish CLIP --output LOG has the options of a clip that is scaled, turned or placed.)";

}  // namespace

void addLogConvertCommand(CLI::App& log, ExitCode& exit) {
  const auto texts = std::make_shared<ConvertTexts>();
  CLI::App* const command =
      log.add_subcommand("convert", "Turn an event log into BVH or JSON, or a clip into a log");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    return command->add_option(name, text, help)->type_name(type);
  };
  option("INPUT", texts->input, "", "Event log, or a clip as foretouch publish reads it")
      ->required();
  option("-o,--output", texts->output, "FILE", "Ends in .bvh, .jsonl or .lcmlog")->required();
  option("--avatar", texts->avatar, "ID|[ID=]FILE",
         "Of a log: whose poses, 1 if not given. Of a clip: the avatar file that it moves");
  option("--suffix", texts->suffix, "TEXT", "Ending of the channels' names");
  command->footer(kConvertExamples);
  command->callback([texts, &exit] { exit = runTexts(*texts); });
}

}  // namespace foretouch::tools
