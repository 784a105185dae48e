#include "tools/log/log_convert_command.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "assets/text_file.h"
#include "network/log/event_log.h"
#include "tools/arguments.h"
#include "tools/interrupt.h"
#include "tools/log/log_inspection.h"
#include "tools/log/log_loss.h"
#include "tools/log/log_to_bvh.h"
#include "tools/log/replay_log.h"
#include "tools/progress.h"
#include "tools/results_output.h"
#include "tools/settings/channel_names.h"
#include "tools/settings/numbered_avatars.h"
#include "tools/settings/stream_settings.h"
#include "tools/stream/event_line.h"
#include "tools/stream/publish_command.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct Conversion {
  std::string input, output, avatar, suffix;
};

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// A description of the output, for people.
using Told = Result<std::string>;

Told toJsonLines(const Conversion& asked, LogLoss& loss) {
  const auto channels = channelNames(asked.suffix);
  if (!channels.ok()) return channels.error();
  const InterruptGuard guard;
  auto file = PendingFile::create(asked.output);
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
  const auto read = readEvents(asked.input, loss, write);
  if (!read.ok()) return read.error();
  if (guard.requested()) return std::string();
  const auto written = file.value().commit();
  if (!written.ok()) return written.error();
  return fmt::format("{} events", events);
}

Told toBvh(const Conversion& asked, LogLoss& loss) {
  LogToBvhRequest request{asked.input, asked.suffix, 1};
  if (!asked.avatar.empty()) {
    const auto id = parseAvatarId("--avatar", asked.avatar);
    if (!id.ok()) return id.error();
    request.avatar = id.value();
  }
  const auto bvh = logToBvh(request, loss);
  if (!bvh.ok()) return bvh.error();
  for (const std::string& note : bvh.value().notes) printNote(asked.input + ": " + note);
  const InterruptGuard guard;
  auto file = PendingFile::create(asked.output);
  if (!file.ok()) return file.error();
  file.value().write(bvh.value().text);
  const auto written = file.value().commit();
  if (!written.ok()) return written.error();
  return fmt::format("{} frames of avatar {}, in metres", bvh.value().frames, request.avatar);
}

Told toLog(const Conversion& asked) {
  const auto avatars = parseNumberedAvatars("--avatar", {asked.avatar});
  if (!avatars.ok()) return avatars.error();
  const auto channels = channelNames(asked.suffix);
  if (!channels.ok()) return channels.error();
  ClipRequest request;
  request.avatarPath = avatars.value().front().path;
  request.motionPath = asked.input;
  PublishOptions options;
  options.channels = channels.value();
  options.sender.avatar = avatars.value().front().id;
  options.sender.source = "foretouch log convert";
  options.sender.startUtimeUs = utimeNow();
  const auto report = publishToLog(request, options, asked.output);
  if (!report.ok()) return report.error();
  return fmt::format("{} poses and {} skeletons of avatar {}", report.value().poses,
                     report.value().skeletons, options.sender.avatar);
}

Told convert(const Conversion& asked, LogLoss& loss) {
  const std::string extension = extensionOf(asked.output);
  const bool isLog = isEventLog(asked.input);
  const auto separate = checkIsNoInput(asked.output, {asked.input});
  if (!separate.ok()) return separate.error();
  if (isLog && extension == ".jsonl" && !asked.avatar.empty()) {
    return Error{ErrorCode::Mismatch, "--avatar", -1, -1,
                 "makes no sense with lines of JSON, which hold every avatar; expected none"};
  }
  if (isLog && extension == ".jsonl") return toJsonLines(asked, loss);
  if (isLog && extension == ".bvh") return toBvh(asked, loss);
  if (!isLog && extension == ".lcmlog" && asked.avatar.empty()) {
    return Error{ErrorCode::Empty, "--avatar", -1, -1,
                 "expected the avatar file that the clip moves"};
  }
  if (!isLog && extension == ".lcmlog") return toLog(asked);
  return Error{ErrorCode::Mismatch, "--output", -1, -1,
               isLog
                   ? "expected a file that ends in .bvh or .jsonl, found " + inQuotes(asked.output)
                   : "expected a file that ends in .lcmlog, as " + inQuotes(asked.input) +
                         " is no event log, found " + inQuotes(asked.output)};
}

ExitCode run(const Conversion& asked) {
  LogLoss loss;
  const auto told = convert(asked, loss);
  for (const std::string& line : loss.lines()) printError(asked.input + ": " + line);
  if (!loss.any() && loss.counts().hasCheckSums && !loss.counts().isClosed) {
    printNote(asked.input + ": " + formatOf(loss.counts()));
  }
  if (!told.ok()) return failed(told.error());
  const std::string text = asked.output + ": " + told.value() + "\n";
  isStandardOutput(asked.output) ? printAside(text) : printOut(text);
  return loss.any() ? ExitCode::CheckSaysNo : ExitCode::Done;
}

constexpr char kConvertExamples[] = R"(Examples:
  foretouch log convert today.lcmlog --output today.jsonl
  foretouch log convert today.lcmlog --avatar 2 --output ben.bvh
  foretouch log convert dancer.bvh --avatar dancer.avatar.json --output dancer.lcmlog

foretouch publish CLIP --output LOG has the options of a clip that is scaled, turned or placed.)";

}  // namespace

Command logConvertCommand() {
  const auto asked = std::make_shared<Conversion>();
  Settings settings;
  settings.path("INPUT", "", asked->input, "Event log, or a clip as foretouch publish reads it")
      .required();
  settings.path("-o,--output", "FILE", asked->output, "Ends in .bvh, .jsonl or .lcmlog").required();
  settings.text("--avatar", "ID|[ID=]FILE", asked->avatar,
                "Of a log: whose poses, 1 if not given. Of a clip: the avatar file that it moves");
  addSuffixSetting(settings, asked->suffix);
  Command command{"convert", "Turn an event log into BVH or JSON, or a clip into a log",
                  kConvertExamples, std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
