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

#include "articulated/try.h"
#include "assets/json_writer.h"
#include "assets/text_file.h"
#include "network/log/event_log.h"
#include "tools/inputs/file_roles.h"
#include "tools/interrupt.h"
#include "tools/log/log_inspection.h"
#include "tools/log/log_loss.h"
#include "tools/log/log_to_bvh.h"
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
  bool asJson = false;
};

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// What the output holds: in words, and counted.
struct Written {
  std::string text;
  std::vector<std::pair<const char*, std::int64_t>> counts;
};
using Told = Result<Written>;

Told toJsonLines(const Conversion& asked, LogLoss& loss) {
  FORETOUCH_TRY(const auto channels, channelNames(asked.suffix));
  const InterruptGuard guard;
  FORETOUCH_TRY(auto file, PendingFile::create(asked.output));
  ProgressBar progress("convert", 100);
  std::int64_t events = 0;
  const auto write = [&](const LogEvent& event, const EventLogReader& log) -> Result<bool> {
    file.write(eventLine(event, channels));
    ++events;
    if (log.size() > 0) {
      progress.advanceTo(static_cast<std::int64_t>(100 * log.position() / log.size()));
    }
    return !guard.requested();
  };
  FORETOUCH_CHECK(readEvents(asked.input, loss, write));
  if (guard.requested()) return Written();
  FORETOUCH_CHECK(file.commit());
  return Written{fmt::format("{} events", events), {{"events", events}}};
}

Told toBvh(const Conversion& asked, LogLoss& loss) {
  LogToBvhRequest request{asked.input, asked.suffix, 1};
  if (!asked.avatar.empty()) {
    FORETOUCH_TRY(request.avatar, parseAvatarId("--avatar", asked.avatar));
  }
  FORETOUCH_TRY(const auto bvh, logToBvh(request, loss));
  for (const std::string& note : bvh.notes) printNote(asked.input + ": " + note);
  const InterruptGuard guard;
  FORETOUCH_TRY(auto file, PendingFile::create(asked.output));
  file.write(bvh.text);
  FORETOUCH_CHECK(file.commit());
  return Written{fmt::format("{} frames of avatar {}, in metres", bvh.frames, request.avatar),
                 {{"frames", static_cast<std::int64_t>(bvh.frames)}, {"avatar", request.avatar}}};
}

Told toLog(const Conversion& asked) {
  FORETOUCH_TRY(const auto avatars, parseNumberedAvatars("--avatar", {asked.avatar}));
  FORETOUCH_TRY(const auto channels, channelNames(asked.suffix));
  ClipRequest request;
  request.avatarPath = avatars.front().path;
  request.motionPath = asked.input;
  PublishOptions options;
  options.channels = channels;
  options.sender.avatar = avatars.front().id;
  options.sender.source = "foretouch log convert";
  options.sender.startUtimeUs = utimeNow();
  FORETOUCH_TRY(const auto report, publishToLog(request, options, asked.output));
  return Written{fmt::format("{} poses and {} skeletons of avatar {}", report.poses,
                             report.skeletons, options.sender.avatar),
                 {{"poses", static_cast<std::int64_t>(report.poses)},
                  {"skeletons", static_cast<std::int64_t>(report.skeletons)},
                  {"avatar", options.sender.avatar}}};
}

Told convert(const Conversion& asked, LogLoss& loss) {
  const bool isOut = asked.output == kStandardOutput;
  const std::string extension = isOut ? ".jsonl" : extensionOf(asked.output);
  const bool isLog = isEventLog(asked.input);
  FORETOUCH_CHECK(checkIsNoInput(asked.output, {asked.input}));
  if (isLog && extension == ".jsonl" && !asked.avatar.empty()) {
    return Error::in(
        "--avatar", ErrorCode::Mismatch,
        "chooses one avatar, but lines of JSON hold every avatar; expected no such option");
  }
  if (isLog && extension == ".jsonl") return toJsonLines(asked, loss);
  if (isLog && extension == ".bvh") return toBvh(asked, loss);
  if (!isLog && extension == ".lcmlog" && asked.avatar.empty()) {
    return Error::in("--avatar", ErrorCode::Empty, "expected the avatar file that the clip moves");
  }
  if (!isLog && extension == ".lcmlog") return toLog(asked);
  return Error::in(
      "--output", ErrorCode::Mismatch,
      isLog ? "expected a file that ends in .bvh or .jsonl, found " + inQuotes(asked.output)
            : "expected a file that ends in .lcmlog, as " + inQuotes(asked.input) +
                  " is no event log, found " + inQuotes(asked.output));
}

std::string conversionJson(const Conversion& asked, const Written& written) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("input", asked.input);
  out.field("output", asked.output);
  for (const auto& [name, count] : written.counts) out.field(name, count);
  out.endObject();
  return text + "\n";
}

ExitCode run(const Conversion& asked) {
  LogLoss loss;
  const auto told = convert(asked, loss);
  for (const std::string& line : loss.lines()) printError(asked.input + ": " + line);
  if (!loss.any() && loss.counts().hasCheckSums && !loss.counts().isClosed) {
    printNote(asked.input + ": " + formatOf(loss.counts()));
  }
  if (!told.ok()) return failed(told.error());
  const std::string text = asked.asJson ? conversionJson(asked, told.value())
                                        : asked.output + ": " + told.value().text + "\n";
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
      .files("lcmlog bvh glb gltf fbx dae x csv npz")
      .required("an event log or a clip");
  settings
      .output("-o,--output", "FILE", asked->output,
              "Ends in .bvh, .jsonl or .lcmlog; - of a log: JSON lines on standard output")
      .required();
  settings.text("--avatar", "ID|[ID=]FILE", asked->avatar,
                "Of a log: whose poses, 1 if not given. Of a clip: the avatar file that it moves");
  addSuffixSetting(settings, asked->suffix);
  settings.asJson(asked->asJson);
  Command command{"convert", "Turn an event log into BVH or JSON, or a clip into a log",
                  kConvertExamples, std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
