#include <memory>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/crowds.h"
#include "bench/options.h"
#include "bench/private_network.h"
#include "bench/stream.h"
#include "lss/sanitizer.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

/// Allowed growth of a service. Below the second one in the last half, growth is single pages and a
/// few steps of the heap, of 128 KiB each (a world's heap takes its pages in the first half
/// minute), which give a steep slope over minutes. A sanitizer's own books take more, and more of a
/// world, as it keeps what is freed apart by size.
constexpr double kMostMbPerHour = 1.0, kNoGrowthMb = internal::kUnderSanitizer ? 4.0 : 0.5,
                 kNoGrowthOfWorldMb = internal::kUnderSanitizer ? 16.0 : 0.5;

template <typename Request>
struct Asked {
  Request request;
  FigureFiles figures;
};
using AskedStream = Asked<StreamRequest>;
using AskedSoak = Asked<SoakRequest>;

ExitCode run(AskedStream& asked) {
  FORETOUCH_CHECK_OR(failed, enterPrivateNetwork());
  FORETOUCH_TRY_OR(failed, const auto report, measureStream(asked.request));
  return finished(report, report.tables.front(), asked.figures);
}

ExitCode run(AskedSoak& asked) {
  SoakRequest& request = asked.request;
  if (request.moving.props > 0 && !request.isCalm) {
    return failed(Error::in("--props", ErrorCode::OutOfRange,
                            "expected --calm beside it: the senders of trouble know no world"));
  }
  FORETOUCH_CHECK_OR(failed, enterPrivateNetwork());
  FORETOUCH_TRY_OR(failed, const auto soak, soakStream(request));
  const double noGrowthMb = request.moving.props > 0 ? kNoGrowthOfWorldMb : kNoGrowthMb;
  const bool isSound = soak.lost == 0 && !soak.filesGrown &&
                       (soak.slopeMbPerHour < kMostMbPerHour || soak.grownMb < noGrowthMb) &&
                       soak.exitCode == 0;
  return finished(
      soak.report, soak.report.tables.front(), asked.figures,
      isSound ? "" : "the service lost poses, grew, or did not end well: see the table");
}

/// Adds the settings of both.
template <typename Asked>
void addShared(Settings& settings, Asked& asked) {
  addCrowds(settings, "--crowds", "NxHZ,...", asked.request.crowds,
            "How many avatars, and how many poses per second each sends");
  addWorkers(settings, asked.request.workers);
  addDancerPlace(settings, asked.request.place);
  addFigures(settings, asked.figures, "Also write the table to a file");
}

void addProps(Settings& settings, MovingRequest& moving) {
  constexpr int kMaxProps = 1000;
  settings.whole("--props", "N", moving.props, 0, kMaxProps,
                 "Balls that move among the avatars, in a moving world; wants --calm");
  settings.number("--props-rate", "HZ", moving.rateHz, kAboveZero, "Poses of all balls per second");
  settings.flag("--furniture", moving.isFurnished,
                "With --props: in the bundled room, deep in its furniture, instead of an empty "
                "hall");
}

}  // namespace

Command streamCommand() {
  const auto asked = std::make_shared<AskedStream>();
  asked->request.crowds = {{1, 30}, {1, 90}, {1, 1000}, {1, 10000}, {10, 90}, {10, 1000}, {50, 90}};
  Settings settings;
  addShared(settings, *asked);
  settings.number("--seconds", "S", asked->request.durationS, kAboveZero, "Of each crowd");
  Command command{"stream",
                  "Pose sent to verdict received: senders and service in a private network",
                  "Example:\n  foretouch-bench stream --crowds 1x90,50x90 --json stream.json",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

Command soakCommand() {
  constexpr NumberRange kShare{0.0, 1e6, "", "", true};
  const auto asked = std::make_shared<AskedSoak>();
  SoakRequest& request = asked->request;
  request.crowds = {{4, 90}, {1, 1000}};
  Settings settings;
  addShared(settings, *asked);
  settings.number("--minutes", "M", request.minutes, kAboveZero, "How long");
  settings.number("--garbage", "SHARE", request.garbageShare, kShare,
                  "Datagrams of garbage per pose");
  settings.flag("--calm", request.isCalm,
                "No viewers, no floods, no sender that is restarted, no log");
  settings.path("--disk", "FOLDER", request.diskPath,
                "Folder on a small disk of its own (a tmpfs) for the service's log: the bench "
                "fills it and empties it");
  addProps(settings, request.moving);
  Command command{
      "soak", "One service under load and garbage; exit code 1 where it loses, grows or leaks",
      "Example:\n  foretouch-bench soak --minutes 150 --disk /mnt/small", std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
