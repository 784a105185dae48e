#include "tools/commands/serve_command.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <sys/prctl.h>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "network/service/metrics_server.h"
#include "network/service/metrics_text.h"
#include "network/service/service.h"
#include "network/vmc/vmc_receiver.h"
#include "tools/settings/channel_names.h"
#include "tools/stream/serve_config.h"
#include "tools/stream/served_world.h"
#include "tools/stream/service_manager.h"
#include "tools/stream/serving.h"
#include "tools/stream/stop_signal.h"
#include "tools/view/serve_view.h"

namespace foretouch::tools {
namespace {

using std::chrono::milliseconds;

/// Notices a failure of the service after this long.
constexpr milliseconds kLookEvery{500};

/// A burst that does not fit is lost: better reported at the start than counted later.
void tellReceiveBuffer(std::size_t asked, std::size_t given) {
  if (given == 0 || given >= asked) return;
  printNote(
      fmt::format("the system gives a receive buffer of {} bytes, not {}: bursts of more are "
                  "lost (kernel_drops). To allow it: sysctl net.core.rmem_max={}",
                  given, asked, asked));
}

/// Tests the network before use, and opens it.
Result<Done> openWire(const ServeConfig& config, ServiceParts& parts) {
  FORETOUCH_TRY(const auto url, inFile(parseUdpmUrl(config.url), "--url"));
  FORETOUCH_CHECK(testMulticast(url));
  const std::vector<std::string> channels =
      receivedChannels(config.service.suffix, parts.world.has_value());
  const bool isOwn = config.receiver == ReceiverKind::Own;
  FORETOUCH_TRY(auto receiver, inFile(isOwn ? openUdpmReceiver(url, channels, config.senders)
                                            : openLcmReceiver(config.url, channels),
                                      config.url));
  tellReceiveBuffer(url.receiveBufferBytes, receiver->receiveBufferBytes());
  FORETOUCH_TRY(auto publisher, inFile(openUdpmPublisher(url), config.url));
  parts.receiver = std::move(receiver);
  parts.publisher = std::move(publisher);
  return Done{};
}

/// The avatars that VMC moves are among those that are served.
Result<std::vector<VmcPort>> vmcPorts(const ServeConfig& config, const ServedWorld& world) {
  std::vector<VmcPort> ports;
  if (!config.vmc.empty() && !config.keyPath.empty()) {
    return Error::in(
        "--vmc", ErrorCode::Mismatch,
        "VMC has no signatures, and --key refuses what has none; expected one of them");
  }
  for (const NumberedPort& each : config.vmc) {
    const auto served =
        std::find_if(world.avatars.begin(), world.avatars.end(),
                     [&](const StreamSolver& avatar) { return avatar.id() == each.avatar; });
    if (served == world.avatars.end()) {
      return Error::in("--vmc", ErrorCode::UnknownName,
                       fmt::format("expected an avatar that is served, found {}", each.avatar));
    }
    FORETOUCH_TRY(auto body,
                  inFile(VmcBody::make(each.avatar, served->avatar().skeleton(), config.vmcBones),
                         fmt::format("--vmc: avatar {}", each.avatar)));
    ports.push_back({each.port, std::move(body)});
  }
  return ports;
}

Result<Done> openVmc(const ServeConfig& config, std::vector<VmcPort> ports, ServiceParts& parts) {
  if (ports.empty()) return Done{};
  FORETOUCH_TRY(const auto url, inFile(parseUdpmUrl(config.url), "--url"));
  FORETOUCH_TRY(parts.receiver,
                inFile(openVmcReceiver(std::move(parts.receiver), std::move(ports),
                                       {url, config.senders, config.service.suffix}),
                       "--vmc"));
  return Done{};
}

/// Loads all that is served.
Result<ServedWorld> loadAll(ServeConfig& config) {
  if (config.worldPath.empty()) return loadServedWorld(config);
  FORETOUCH_TRY(auto world,
                loadWorldToServe(config.worldPath, config.worldPolicy, config.solid, config.world));
  config.avatars = std::move(world.avatars);
  FORETOUCH_TRY(auto served, loadServedWorld(config));
  served.world.emplace(std::move(world.solver));
  served.remarks.insert(served.remarks.end(), world.remarks.begin(), world.remarks.end());
  return served;
}

/// In a folder, every run gets its own file: a restarted service overwrites nothing.
std::string logPathIn(const std::string& given) {
  std::error_code none;
  if (!std::filesystem::is_directory(given, none)) return given;
  const std::int64_t utimeUs = systemClock().utimeUs();
  constexpr std::int64_t kUsPerS = 1'000'000, kUsPerMs = 1000;
  const std::time_t seconds = utimeUs / kUsPerS;
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char stamp[32];
  std::strftime(stamp, sizeof stamp, "%Y%m%dT%H%M%S", &utc);
  const std::string name = fmt::format("{}.{:03}Z.lcmlog", stamp, utimeUs % kUsPerS / kUsPerMs);
  return (std::filesystem::path(given) / name).string();
}

Result<Done> openLog(const ServeConfig& config, ServiceParts& parts) {
  if (config.log.empty()) return Done{};
  FORETOUCH_TRY(parts.journal, createLogSink(config.log, config.logLimits,
                                             kSkeletonChannel + config.service.suffix));
  return Done{};
}

Result<std::optional<MetricsServer>> openHttp(const ServeConfig& config, const Service& service) {
  if (config.http.empty()) return std::optional<MetricsServer>();
  FORETOUCH_TRY(const auto address, parseHttpAddress("--http", config.http));
  MetricsServer::Pages pages;
  pages.metrics = [&service] {
    const auto world = service.world();
    return metricsText(service.facts(), service.counts(), service.times(), service.solidCounts(),
                       world ? &*world : nullptr, service.personCounts());
  };
  pages.health = [&service] { return service.health(); };
  FORETOUCH_TRY(
      auto server,
      inFile(MetricsServer::start(address.host, address.port, std::move(pages)), "--http"));
  if (!isLoopback(address.host)) {
    printNote("--http: whoever reaches " + config.http + " can read the metrics");
  }
  return std::optional<MetricsServer>(std::move(server));
}

std::string describe(const ServeConfig& config, const ServedWorld& world) {
  std::string text =
      fmt::format("serving {} ({} triangles) to {} avatar{}", config.world.scenePath,
                  world.numTriangles, world.avatars.size(), world.avatars.size() == 1 ? "" : "s");
  text += fmt::format(" at {} fidelity, {} m, {} worker{}, on {}",
                      toString(config.world.query.fidelity), config.world.query.tolerance,
                      config.service.workers, config.service.workers == 1 ? "" : "s", config.url);
  if (!config.world.policies.empty()) text += ", some links by policy";
  if (config.person.isAsked()) {
    text += fmt::format(", persons within {} ({})", config.person.boundsPath,
                        toString(config.person.model));
  }
  if (!config.service.suffix.empty()) text += ", suffix " + config.service.suffix;
  if (!config.worldPath.empty()) text += ", a moving world " + config.worldPath;
  for (const NumberedPort& each : config.vmc) {
    text += fmt::format(", VMC for avatar {} on port {}", each.avatar, each.port);
  }
  if (!config.log.empty()) text += ", log " + config.log;
  if (!config.http.empty()) text += ", metrics on " + config.http;
  if (!config.view.empty()) text += ", to be watched at http://" + config.view + "/";
  return text;
}

/// Reports once when the log begins to miss events.
class JournalWatch {
 public:
  explicit JournalWatch(std::string log) : log_(std::move(log)) {}
  void look(const Service& service) {
    const std::uint64_t failures = service.counts().journalFailures;
    if (failures == 0 || hasTold_) return;
    hasTold_ = true;
    printNote(log_ + ": events are not recorded: " + service.journalFailure());
  }

 private:
  std::string log_;
  bool hasTold_ = false;
};

/// Names each body whose poses are all refused, once until one is accepted.
class RefusedWatch {
 public:
  void look(const Service& service) {
    const auto world = service.world();
    if (!world) return;
    std::set<BodyNumber> named;
    for (const RefusedBody& body : world->counts.refusedLongest) {
      named.insert(body.body);
      if (named_.count(body.body) == 0) printNote(foretouch::describe(body));
    }
    named_ = std::move(named);
  }

 private:
  std::set<BodyNumber> named_;
};

/// Waits until a signal comes or the service cannot continue.
void waitForEnd(const Service& service, const ServiceManager& manager, StopSignal& stop,
                JournalWatch& journal) {
  RefusedWatch refused;
  const milliseconds every = std::min(kLookEvery, manager.aliveEvery().value_or(kLookEvery));
  while (!stop.wait(every) && !service.failure()) {
    journal.look(service);
    refused.look(service);
    if (manager.aliveEvery() && service.health().isAlive) manager.alive();
  }
}

std::string summaryOf(const ServiceCounts& counts) {
  return fmt::format(
      "{} poses: {} answered, {} refused, {} lost on the way; {} messages not sent, "
      "{} events not recorded\n",
      counts.received, counts.answered, counts.rejected(), counts.lost, counts.publishFailures,
      counts.journalFailures);
}

/// A log at its size limit, or a reader of our output that went away, fails a write but must not
/// end the service.
void surviveFailedWrites() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

/// No other process of the same user reads keys and poses out of this one's memory, or attaches to
/// it; nor does a core dump keep them.
void keepMemoryToItself() {
  ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
}

ExitCode run(const Settings& settings, ServeConfig& config) {
  surviveFailedWrites();
  keepMemoryToItself();
  // A given URL takes precedence over the environment.
  const bool isOpen = !settings.isGiven("--url") && config.url == kDefaultUrl;
  config.url = urlOrDefault(isOpen ? std::string() : config.url);
  const bool hasOwn = !config.world.scenePath.empty() || !config.avatars.empty();
  if (!config.worldPath.empty() && hasOwn) {
    return failed({ErrorCode::Mismatch, "--world", -1, -1,
                   "the world file has the scene and the avatars; expected no --scene and no "
                   "--avatar beside it"});
  }
  if (config.worldPath.empty() && !config.solid.worldBodies.empty()) {
    return failed(Error::in("--world-solid", ErrorCode::Mismatch,
                            "is of the bodies of a world; expected --world as well"));
  }
  if (!config.worldPath.empty()) {
    const auto served = serve(config);
    return served.ok() ? ExitCode::Done : failed(served.error());
  }
  if (config.world.scenePath.empty()) {
    return failed({ErrorCode::Empty, "--scene", -1, -1, "expected a scene, here or by --config"});
  }
  if (config.avatars.empty()) {
    return failed({ErrorCode::Empty, "--avatar", -1, -1,
                   "expected at least one avatar, here or by --config"});
  }
  if (config.receiver == ReceiverKind::Liblcm && !config.senders.empty()) {
    return failed({ErrorCode::Mismatch, "--senders", -1, -1,
                   "liblcm does not say who sent a message; expected --receiver own"});
  }
  const auto served = serve(config);
  return served.ok() ? ExitCode::Done : failed(served.error());
}

/// Comes first: options override the file.
void addConfigSetting(Settings& settings, ServeConfig& config) {
  settings
      .parsed(
          "--config", "FILE",
          [&config](const std::string& path) -> Result<Done> {
            FORETOUCH_TRY(
                config, path.empty() ? Result<ServeConfig>(ServeConfig()) : readServeConfig(path));
            return Done{};
          },
          [] { return std::string(); },
          "TOML file that says all of this; options below replace what it says")
      .in(kInputGroup)
      .files("toml");
}

constexpr char kServeExamples[] = R"(Examples:
  foretouch serve --scene room.obj --avatar dancer.avatar.json
  foretouch serve --scene kitchen.ply --scene-up z --avatar 1=anna.json --avatar 2=ben.json \
      --workers 2 --log today.lcmlog --http 127.0.0.1:9464
  foretouch serve --scene room.obj --avatar dancer.avatar.json --view
  foretouch serve --scene room.obj --avatar vtuber.avatar.json --vmc 39539 --view
  foretouch serve --world stage.toml --view
  foretouch serve --world stage.toml --solid --world-solid ben
  foretouch serve --config service.toml --workers 4

Prints "ready" once it takes poses. SIGINT, SIGTERM and SIGHUP end it in order: what waits is
answered first. docs/streaming.md has the whole story.)";

}  // namespace

Result<Done> serve(const ServeConfig& given) {
  ServeConfig config = given;
  config.log = logPathIn(given.log);
  FORETOUCH_TRY(auto world, loadAll(config));
  for (const std::string& remark : world.remarks) printNote(remark);
  ServiceParts parts;
  parts.world = std::move(world.world);
  parts.persons = std::move(world.persons);
  FORETOUCH_TRY(auto vmc, vmcPorts(config, world));
  FORETOUCH_CHECK(openWire(config, parts));
  FORETOUCH_CHECK(openVmc(config, std::move(vmc), parts));
  FORETOUCH_CHECK(openLog(config, parts));

  std::optional<ServeView> view = prepareView(config, world);
  ViewFeed feed(world.avatars.size());
  if (view) parts.observer = &feed;

  ServiceOptions options = config.service;
  options.build = "foretouch " FORETOUCH_VERSION " " FORETOUCH_BUILD_TYPE;
  options.scene = config.world.scenePath;
  if (!config.keyPath.empty()) {
    FORETOUCH_TRY(options.key, inFile(MessageKey::read(config.keyPath), "--key"));
  }
  const std::string line = describe(config, world);
  StopSignal stop;
  FORETOUCH_TRY(auto service, Service::start(std::move(world.avatars), std::move(parts), options));
  FORETOUCH_TRY(auto http, openHttp(config, service));
  FORETOUCH_TRY(auto watched, openView(config, std::move(view), service, feed));

  printOut(line + "\nready\n");
  if (!outputArrived()) {
    return Error::in("standard output", ErrorCode::FileUnwritable, "cannot be written");
  }
  const ServiceManager manager;
  manager.ready(line);
  JournalWatch journal(config.log);
  waitForEnd(service, manager, stop, journal);
  manager.stopping();
  service.stop();
  http.reset();
  watched.reset();
  journal.look(service);
  printOut(summaryOf(service.counts()));
  if (const auto failure = service.failure()) return inFile(*failure, config.url);
  return Done{};
}

Command serveCommand() {
  const auto config = std::make_shared<ServeConfig>();
  Settings settings;
  addConfigSetting(settings, *config);
  addServeSettings(settings, *config);
  settings.gone("--self",
                "is not possible yet: messages have no field for contacts of own links. Record a "
                "clip and ask foretouch replay --self");
  settings.gone("--scope",
                "is not possible: of a stream every link is answered. Record a clip and ask "
                "foretouch replay --scope");
  settings.gone("--pass-separating",
                "is not possible: a stream goes from pose to pose and stops nowhere. Record a clip "
                "and ask foretouch replay --pass-separating");
  Command command{"serve", "Answer poses that arrive over LCM, until stopped", kServeExamples,
                  std::move(settings)};
  command.run = [config](const Settings& given) { return run(given, *config); };
  return command;
}

}  // namespace foretouch::tools
