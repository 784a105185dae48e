#include "tools/stream/publish_command.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "assets/text_file.h"
#include "network/log/event_log.h"
#include "network/service/clock.h"
#include "network/wire/wire.h"
#include "tools/arguments.h"
#include "tools/inputs/clip_options.h"
#include "tools/inputs/numbered_avatars.h"
#include "tools/inputs/played_clip.h"
#include "tools/settling.h"
#include "tools/stream/stop_signal.h"

namespace foretouch::tools {
namespace {

/// Values as typed in.
struct PublishTexts {
  std::string motion, avatar, id = "1", speed = "1", url, suffix, output, start;
  ClipTexts clip;
  bool loop = false;
};

struct PublishJob {
  PublishRequest request;
  PublishOptions options;
  std::string url, outputPath;
};

/// 0 is a speed of its own: without waiting.
Result<double> parseSpeed(const std::string& text) {
  if (text == "0") return 0.0;
  return parsePositive("--speed", text);
}

/// What belongs to live sending makes no sense with a log, and the other way round.
Result<Done> checkTogether(const PublishTexts& texts) {
  const auto refuse = [](const char* option, const char* why) {
    return Error{ErrorCode::Mismatch, option, -1, -1, why};
  };
  constexpr char kNotWithLog[] = "is about sending to a network; expected none with --output";
  if (texts.output.empty()) {
    if (texts.start.empty()) return Done{};
    return refuse("--start", "is about a log; expected --output as well");
  }
  if (texts.loop) return refuse("--loop", kNotWithLog);
  if (texts.speed != "1") return refuse("--speed", kNotWithLog);
  if (!texts.url.empty()) return refuse("--url", kNotWithLog);
  return Done{};
}

Result<PublishJob> settled(const PublishTexts& texts) {
  PublishJob job;
  PublishRequest& request = job.request;
  request.avatarPath = texts.avatar;
  request.motionPath = texts.motion;
  job.outputPath = texts.output;
  job.url = urlOrDefault(texts.url);
  job.options.loop = texts.loop;

  Settling settle;
  settle.require(checkTogether(texts));
  settleClip(texts.clip, settle, request);
  settle.into(job.options.speed, parseSpeed(texts.speed));
  settle.into(job.options.channels, channelNames(texts.suffix));
  settle.into(job.options.sender.avatar, parseAvatarId("--id", texts.id));
  job.options.sender.startUtimeUs = utimeNow();
  if (!texts.start.empty()) {
    settle.into(job.options.sender.startUtimeUs, parseUtime("--start", texts.start));
  }
  job.options.sender.source =
      "foretouch publish " + std::filesystem::path(texts.motion).filename().string();
  job.options.sender.source.resize(std::min(job.options.sender.source.size(), kMaxTextBytes / 2));
  if (settle.error()) return *settle.error();
  return job;
}

PlacedClip placedIn(const PlayedClip& played, const PublishRequest& request) {
  return {played.avatar,     played.clip,      played.match,
          request.placement, played.isUpright, request.motionPath};
}

Result<PlayedClip> loadWithRemarks(const PublishRequest& request) {
  auto played = loadPlayedClip(request);
  if (!played.ok()) return played;
  for (const std::string& remark :
       remarksOnClip(played.value().avatar, played.value().clip, played.value().match,
                     request.avatarPath, request.motionPath)) {
    printNote(remark);
  }
  return played;
}

Result<PublishReport> publishLive(const PublishJob& job) {
  const auto played = loadWithRemarks(job.request);
  if (!played.ok()) return played.error();
  const auto url = parseUdpmUrl(job.url);
  if (!url.ok()) return inFile(url.error(), "--url");
  const auto route = testMulticast(url.value());
  if (!route.ok()) return inFile(route.error(), "--url");
  const auto publisher = openUdpmPublisher(url.value());
  if (!publisher.ok()) return inFile(publisher.error(), "--url");
  StopSignal stop;
  LivePace pace([&stop] { return stop.wait(std::chrono::milliseconds(0)); });
  PublishOptions options = job.options;
  options.sender.startUtimeUs = pace.utimeUs();
  auto sent = publishClip(placedIn(played.value(), job.request), played.value().steps, options,
                          pace, [&](const std::string& channel, ByteView payload, std::int64_t) {
                            return Result<bool>(publisher.value()->publish(channel, payload));
                          });
  if (sent.ok() && sent.value().late > 0) {
    printNote(fmt::format("{} of {} poses were sent more than {} ms late, the latest by {:.1f} ms",
                          sent.value().late, sent.value().poses, PublishReport::kLateUs / 1000,
                          static_cast<double>(sent.value().mostLateUs) / 1000.0));
  }
  if (sent.ok() && sent.value().failures > 0) {
    printNote(fmt::format("{} messages were not taken by the system", sent.value().failures));
  }
  return sent;
}

ExitCode runTexts(const PublishTexts& texts) {
  const auto job = settled(texts);
  if (!job.ok()) return failed(job.error());
  const bool isLog = !job.value().outputPath.empty();
  const auto report =
      isLog ? publishToLog(job.value().request, job.value().options, job.value().outputPath)
            : publishLive(job.value());
  if (!report.ok()) return failed(report.error());
  printOut(fmt::format("{}: {} poses and {} skeletons of avatar {}, session {}\n",
                       isLog ? job.value().outputPath : job.value().url, report.value().poses,
                       report.value().skeletons, job.value().options.sender.avatar,
                       report.value().session));
  return ExitCode::Done;
}

constexpr char kPublishExamples[] = R"(Examples:
  foretouch publish dancer.bvh --avatar dancer.avatar.json --rate 30 --loop
  foretouch publish walk.bvh --avatar a.avatar.json --scale 0.01 --place 1.5,0,-2,90 --id 2
  foretouch publish dancer.bvh --avatar dancer.avatar.json --output dancer.lcmlog

A service (foretouch serve) that knows the avatar answers as foretouch replay does.)";

}  // namespace

std::int64_t utimeNow() {
  return systemClock().utimeUs();
}

Result<PublishReport> publishToLog(const PublishRequest& request, const PublishOptions& options,
                                   const std::string& logPath) {
  const auto played = loadWithRemarks(request);
  if (!played.ok()) return played.error();
  auto log = EventLogWriter::create(logPath);
  if (!log.ok()) return inFile(log.error(), logPath);
  RecordedPace pace(options.sender.startUtimeUs);
  auto sent = publishClip(
      placedIn(played.value(), request), played.value().steps, options, pace,
      [&](const std::string& channel, ByteView payload, std::int64_t utimeUs) -> Result<bool> {
        const auto written = log.value().write(utimeUs, channel, payload);
        if (!written.ok()) return inFile(written.error(), logPath);
        return true;
      });
  const auto closed = log.value().close();
  if (sent.ok() && !closed.ok()) return inFile(closed.error(), logPath);
  return sent;
}

void addPublishCommand(CLI::App& program, ExitCode& exit) {
  const auto texts = std::make_shared<PublishTexts>();
  CLI::App* const command =
      program.add_subcommand("publish", "Send a recorded clip as a live stream of poses");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    return command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("CLIP", texts->motion, "",
         "BVH clip, animated model (glb, gltf, fbx, dae, x) or joint positions (csv)")
      ->required();
  option("--avatar", texts->avatar, "FILE", "Avatar file (see foretouch avatar)")->required();
  option("--id", texts->id, "N", "What the service calls the avatar");
  option("--rate", texts->clip.rate, "HZ",
         "Poses a second to use of the clip; animations: 30 if all");
  option("--speed", texts->speed, "S",
         "Times the clip's own; 0: as fast as the system takes them, which may lose some");
  command->add_flag("--loop", texts->loop, "Over and over, each time as a new session");
  option("--url", texts->url, "URL", "Where to; LCM_DEFAULT_URL, else this machine, if not given");
  option("--suffix", texts->suffix, "TEXT", "Ending of the channels' names");
  option("--output", texts->output, "LOG", "Write a new event log instead of sending");
  option("--start", texts->start, "US",
         "Time of the log's first pose, microseconds since 1970; now if not given");
  addClipOptions(*command, texts->clip);
  command->footer(kPublishExamples);
  command->callback([texts, &exit] { exit = runTexts(*texts); });
}

}  // namespace foretouch::tools
