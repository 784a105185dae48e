#include "tools/stream/publish_command.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "network/log/event_log.h"
#include "network/service/clock.h"
#include "network/wire/message_key.h"
#include "network/wire/wire.h"
#include "tools/inputs/file_roles.h"
#include "tools/inputs/played_clip.h"
#include "tools/settings/numbered_avatars.h"
#include "tools/settings/stream_settings.h"
#include "tools/settings/world_settings.h"
#include "tools/stream/stop_signal.h"
#include "tools/stream/world_publisher.h"
#include "tools/world/load_world.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct PublishJob {
  ClipRequest request;
  std::vector<std::string> files;
  PublishOptions options;
  std::string worldPath;  ///< A world whose bodies are sent in place of a clip.
  std::string url, suffix, outputPath, keyPath;
  std::optional<std::int64_t> startUtimeUs;  ///< The time of a log's first pose.
};

/// Options of live sending make no sense with a log, and vice versa.
Result<Done> checkTogether(const Settings& settings, const PublishJob& job) {
  const auto refuse = [](const char* option, const char* why) {
    return Error::in(option, ErrorCode::Mismatch, why);
  };
  if (!job.worldPath.empty()) {
    for (const char* option : {"--motion", "--avatar", "--id", "--rate"}) {
      if (settings.isGiven(option)) {
        return refuse(option, "is of a clip; --world sends the bodies of its file");
      }
    }
    if (job.options.speed <= 0.0) return refuse("--speed", "expected above 0 for a world");
  }
  constexpr char kNotWithLog[] = "applies to sending over a network, not to --output";
  if (job.outputPath.empty()) {
    if (!job.startUtimeUs) return Done{};
    return refuse("--start", "applies to a log only; add --output");
  }
  if (job.options.loop) return refuse("--loop", kNotWithLog);
  if (job.options.speed != PublishOptions().speed) return refuse("--speed", kNotWithLog);
  if (!job.url.empty()) return refuse("--url", kNotWithLog);
  if (!job.keyPath.empty()) return refuse("--key", kNotWithLog);
  return Done{};
}

/// Derives the rest of the job from the options.
Result<Done> settle(PublishJob& job) {
  FORETOUCH_TRY(job.options.channels, channelNames(job.suffix));
  job.url = urlOrDefault(job.url);
  job.options.sender.startUtimeUs = job.startUtimeUs.value_or(utimeNow());
  std::string& source = job.options.sender.source;
  const std::string& path = job.worldPath.empty() ? job.request.motionPath : job.worldPath;
  source = "foretouch publish " + std::filesystem::path(path).filename().string();
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
  const auto rate = remarkOnRate(played.value().steps, played.value().clip, request.rateHz);
  if (rate) printNote(*rate);
  return played;
}

/// Sends everything.
using Sending =
    std::function<Result<PublishReport>(const PublishOptions&, Pace&, const MessageSink&)>;

Result<PublishReport> sendLive(const PublishJob& job, const Sending& sendAll) {
  const auto url = parseUdpmUrl(job.url);
  if (!url.ok()) return inFile(url.error(), "--url");
  FORETOUCH_CHECK(testMulticast(url.value()));
  FORETOUCH_TRY(const auto publisher, inFile(openUdpmPublisher(url.value()), "--url"));
  std::optional<MessageKey> key;
  if (!job.keyPath.empty()) {
    FORETOUCH_TRY(key, inFile(MessageKey::read(job.keyPath), "--key"));
  }
  Bytes sealed;
  std::int64_t lastSignedUs = 0;
  const auto send = [&](const std::string& channel, ByteView payload, std::int64_t) {
    if (!key) return Result<bool>(publisher->publish(channel, payload));
    sealed.assign(payload.data, payload.data + payload.size);
    lastSignedUs = std::max(utimeNow(), lastSignedUs + 1);
    key->sign(channel, lastSignedUs, sealed);
    return Result<bool>(publisher->publish(channel, sealed));
  };
  StopSignal stop;
  LivePace pace([&stop] { return stop.wait(std::chrono::milliseconds(0)); });
  PublishOptions options = job.options;
  options.sender.startUtimeUs = pace.utimeUs();
  auto sent = sendAll(options, pace, send);
  if (sent.ok() && sent.value().late > 0) {
    printNote(fmt::format("{} of {} poses were sent more than {} ms late, the latest by {:.1f} ms",
                          sent.value().late, sent.value().poses, PublishReport::kLateUs / 1000,
                          static_cast<double>(sent.value().mostLateUs) / 1000.0));
  }
  if (sent.ok() && sent.value().failures > 0) {
    printNote(fmt::format("the system refused to send {} messages", sent.value().failures));
  }
  return sent;
}

Result<PublishReport> sendToLog(const PublishOptions& options, const std::string& logPath,
                                const Sending& sendAll) {
  FORETOUCH_TRY(auto log, EventLogWriter::create(logPath));
  RecordedPace pace(options.sender.startUtimeUs);
  auto sent = sendAll(
      options, pace,
      [&](const std::string& channel, ByteView payload, std::int64_t utimeUs) -> Result<bool> {
        FORETOUCH_CHECK(log.write(utimeUs, channel, payload));
        return true;
      });
  const auto closed = log.close();
  if (sent.ok() && !closed.ok()) return inFile(closed.error(), logPath);
  return sent;
}

Sending sendingOf(const PlayedClip& played, const ClipRequest& request) {
  return [&](const PublishOptions& options, Pace& pace, const MessageSink& sink) {
    return publishClip(placedIn(played, request), played.steps, options, pace, sink);
  };
}

Sending sendingOf(const LoadedWorld& world) {
  return [&](const PublishOptions& options, Pace& pace, const MessageSink& sink) {
    return publishWorld(world, options, pace, sink);
  };
}

Result<PublishReport> sendClip(const PublishJob& job) {
  if (!job.outputPath.empty()) return publishToLog(job.request, job.options, job.outputPath);
  FORETOUCH_TRY(const auto played, loadWithRemarks(job.request));
  return sendLive(job, sendingOf(played, job.request));
}

Result<PublishReport> sendWorld(const PublishJob& job) {
  FORETOUCH_TRY(auto file, readWorldFile(job.worldPath));
  FORETOUCH_TRY(const auto world, loadWorld(std::move(file)));
  for (const std::string& remark : world.remarks) printNote(remark);
  FORETOUCH_CHECK(checkPublished(world));
  const Sending sending = sendingOf(world);
  return job.outputPath.empty() ? sendLive(job, sending)
                                : sendToLog(job.options, job.outputPath, sending);
}

ExitCode run(const Settings& settings, PublishJob job) {
  FORETOUCH_CHECK_OR(failed, checkTogether(settings, job));
  FORETOUCH_CHECK_OR(failed, settle(job));
  const bool isWorld = !job.worldPath.empty();
  const auto report = isWorld ? sendWorld(job) : sendClip(job);
  if (!report.ok()) return failed(report.error());
  const PublishReport& sent = report.value();
  const std::string where = job.outputPath.empty() ? job.url : job.outputPath;
  printOut(isWorld
               ? fmt::format("{}: {} poses, {} skeletons and {} states of {}, session {}\n", where,
                             sent.poses, sent.skeletons, sent.states, job.worldPath, sent.session)
               : fmt::format("{}: {} poses and {} skeletons of avatar {}, session {}\n", where,
                             sent.poses, sent.skeletons, job.options.sender.avatar, sent.session));
  return ExitCode::Done;
}

constexpr char kPublishExamples[] = R"(Examples:
  foretouch publish dancer.bvh dancer.avatar.json --rate 30 --loop
  foretouch publish walk.bvh --avatar a.avatar.json --clip-scale 0.01 --place 1.5,0,-2,90 --id 2
  foretouch publish dancer.bvh --avatar dancer.avatar.json --output dancer.lcmlog
  foretouch publish --world stage.toml

A service (foretouch serve) that knows the avatar answers as foretouch replay does. With --world the
bodies of a world file are sent: avatars and props, who carries them, and where they are; a service
with the same --world tells what happens between them.)";

void addSendingSettings(Settings& settings, PublishJob& job) {
  settings
      .path("--world", "FILE", job.worldPath,
            "World file whose bodies are sent, in place of a clip (docs/formats.md)")
      .files("toml")
      .standingForRequired();
  settings.whole("--id", "N", job.options.sender.avatar, 0,
                 std::numeric_limits<std::int32_t>::max(), "ID of the avatar in messages");
  addRateSetting(settings, job.request);
  settings.number("--speed", "S", job.options.speed, kZeroOrAbove,
                  "Factor on the clip's own speed; 0: as fast as the system accepts, which may "
                  "lose poses. Of a "
                  "world: it all happens so much faster, stamps as well; above 0");
  settings.flag("--loop", job.options.loop, "Repeat the clip for ever, each time as a new session");
  settings.text("--url", "URL", job.url,
                "Network to send to; by default LCM_DEFAULT_URL, else this machine only");
  addSuffixSetting(settings, job.suffix);
  addKeySetting(settings, job.keyPath, "Key of 32 hexadecimal digits to sign messages with");
  settings.output("-o,--output", "LOG", job.outputPath, "Write a new event log instead of sending");
  settings.parsed(
      "--start", "US",
      [&job](const std::string& text) -> Result<Done> {
        FORETOUCH_TRY(job.startUtimeUs, parseUtime("--start", text));
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
  FORETOUCH_TRY(const auto played, loadWithRemarks(request));
  return sendToLog(options, logPath, sendingOf(played, request));
}

Command publishCommand() {
  const auto job = std::make_shared<PublishJob>();
  Settings settings;
  addMotionSetting(settings, job->request, "--motion", "CLIP").required("a clip to send");
  addAvatarSetting(settings, job->request).required();
  addSendingSettings(settings, *job);
  addClipSettings(settings, job->request);
  addFilesSetting(settings, job->files, "The clip, and the avatar (json) if --avatar is not given");
  Command command{"publish", "Send a recorded clip as a live stream of poses", kPublishExamples,
                  std::move(settings)};
  command.takesProject = true;
  command.run = [job](const Settings& given) { return run(given, *job); };
  return command;
}

}  // namespace foretouch::tools
