#include "tools/stream/publish_command.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "assets/text_file.h"
#include "network/log/event_log.h"
#include "network/service/clock.h"
#include "network/wire/wire.h"
#include "tools/inputs/played_clip.h"
#include "tools/settings/numbered_avatars.h"
#include "tools/settings/stream_settings.h"
#include "tools/settings/world_settings.h"
#include "tools/stream/stop_signal.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct PublishJob {
  ClipRequest request;
  PublishOptions options;
  std::string url, suffix, outputPath;
  std::optional<std::int64_t> startUtimeUs;  ///< Of a log's first pose.
};

/// Options of live sending make no sense with a log, and vice versa.
Result<Done> checkTogether(const PublishJob& job) {
  const auto refuse = [](const char* option, const char* why) {
    return Error{ErrorCode::Mismatch, option, -1, -1, why};
  };
  constexpr char kNotWithLog[] = "is about sending to a network; expected none with --output";
  if (job.outputPath.empty()) {
    if (!job.startUtimeUs) return Done{};
    return refuse("--start", "is about a log; expected --output as well");
  }
  if (job.options.loop) return refuse("--loop", kNotWithLog);
  if (job.options.speed != PublishOptions().speed) return refuse("--speed", kNotWithLog);
  if (!job.url.empty()) return refuse("--url", kNotWithLog);
  return Done{};
}

/// Derives the rest of the job from the options.
Result<Done> settle(PublishJob& job) {
  const auto channels = channelNames(job.suffix);
  if (!channels.ok()) return channels.error();
  job.options.channels = channels.value();
  job.url = urlOrDefault(job.url);
  job.options.sender.startUtimeUs = job.startUtimeUs.value_or(utimeNow());
  std::string& source = job.options.sender.source;
  source = "foretouch publish " + std::filesystem::path(job.request.motionPath).filename().string();
  source.resize(std::min(source.size(), kMaxTextBytes / 2));
  return Done{};
}

PlacedClip placedIn(const PlayedClip& played, const ClipRequest& request) {
  return {played.avatar,     played.clip,      played.match,
          request.placement, played.isUpright, request.motionPath};
}

Result<PlayedClip> loadWithRemarks(const ClipRequest& request) {
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

ExitCode run(PublishJob job) {
  const auto together = checkTogether(job);
  if (!together.ok()) return failed(together.error());
  const auto settled = settle(job);
  if (!settled.ok()) return failed(settled.error());
  const bool isLog = !job.outputPath.empty();
  const auto report =
      isLog ? publishToLog(job.request, job.options, job.outputPath) : publishLive(job);
  if (!report.ok()) return failed(report.error());
  printOut(fmt::format("{}: {} poses and {} skeletons of avatar {}, session {}\n",
                       isLog ? job.outputPath : job.url, report.value().poses,
                       report.value().skeletons, job.options.sender.avatar,
                       report.value().session));
  return ExitCode::Done;
}

constexpr char kPublishExamples[] = R"(Examples:
  foretouch publish dancer.bvh --avatar dancer.avatar.json --rate 30 --loop
  foretouch publish walk.bvh --avatar a.avatar.json --scale 0.01 --place 1.5,0,-2,90 --id 2
  foretouch publish dancer.bvh --avatar dancer.avatar.json --output dancer.lcmlog

A service (foretouch serve) that knows the avatar answers as foretouch replay does.)";

void addSendingSettings(Settings& settings, PublishJob& job) {
  settings.whole("--id", "N", job.options.sender.avatar, 0,
                 std::numeric_limits<std::int32_t>::max(), "What the service calls the avatar");
  addRateSetting(settings, job.request);
  settings.number("--speed", "S", job.options.speed, kZeroOrAbove,
                  "Times the clip's own; 0: as fast as the system takes them, which may lose some");
  settings.flag("--loop", job.options.loop, "Over and over, each time as a new session");
  settings.text("--url", "URL", job.url,
                "Where to; LCM_DEFAULT_URL, else this machine, if not given");
  addSuffixSetting(settings, job.suffix);
  settings.path("--output", "LOG", job.outputPath, "Write a new event log instead of sending");
  settings.parsed(
      "--start", "US",
      [&job](const std::string& text) -> Result<Done> {
        const auto utimeUs = parseUtime("--start", text);
        if (!utimeUs.ok()) return utimeUs.error();
        job.startUtimeUs = utimeUs.value();
        return Done{};
      },
      [] { return std::string(); },
      "Time of the log's first pose, microseconds since 1970; now if not given");
}

}  // namespace

std::int64_t utimeNow() {
  return systemClock().utimeUs();
}

Result<PublishReport> publishToLog(const ClipRequest& request, const PublishOptions& options,
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

Command publishCommand() {
  const auto job = std::make_shared<PublishJob>();
  Settings settings;
  addMotionSetting(settings, job->request, "CLIP", "").required();
  addAvatarSetting(settings, job->request).required();
  addSendingSettings(settings, *job);
  addClipSettings(settings, job->request);
  Command command{"publish", "Send a recorded clip as a live stream of poses", kPublishExamples,
                  std::move(settings)};
  command.run = [job](const Settings&) { return run(*job); };
  return command;
}

}  // namespace foretouch::tools
