#include "bench/trust.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/bench_folder.h"
#include "bench/garbage.h"
#include "bench/hardening.h"
#include "bench/machine.h"
#include "bench/service_process.h"
#include "bench/slow_clients.h"
#include "bench/stream.h"
#include "bench/stream_load.h"
#include "bench/timing.h"
#include "network/stream/bound_stream.h"
#include "network/wire/messages.h"

namespace foretouch::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kTrueHz = 1000.0;
constexpr double kBytesPerMB = 1e6, kSecondsPerHour = 3600.0;
// In a private network, where they are free.
constexpr std::uint16_t kHttpPort = 9464, kViewPort = 9465;

/// The inputs of every table.
struct Stage {
  BenchInputs inputs;
  LoadTrack track;
  double seconds = 0.0;
};

Result<ServiceProcess> serve(const Stage& stage, const std::vector<std::string>& more = {}) {
  auto arguments = serviceArguments(stage.inputs.files, 1, 1, std::string());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return ServiceProcess::start(arguments);
}

std::int64_t countOfReason(const StatusMessage& status, Reject reason) {
  for (const StatusMessage::Count& count : status.counts) {
    if (count.reason == toString(reason)) return count.count;
  }
  return 0;
}

// Floods.

struct FloodKind {
  std::string what;
  double perSecond = 0.0;
  std::vector<Bytes> datagrams;  ///< None: no flood.
};

struct Flooded {
  LoadOutcome truth;
  Flood::Sent flood;
};

/// One sender at 1 kHz; the flood begins a second after it, and ends a second before.
Result<Flooded> runFlooded(const Stage& stage, const FloodKind& kind) {
  LoadRequest load;
  load.senders = {{1, kTrueHz}};
  load.durationS = stage.seconds + 2.0;
  Flooded flooded;
  std::optional<Flood> flood;
  const auto begin = [&] {
    if (flood || kind.datagrams.empty()) return;
    flood.emplace(load.url, kind.datagrams, kind.perSecond, stage.seconds);
  };
  FORETOUCH_TRY(flooded.truth, runLoad(stage.track, load, begin));
  if (flood) flooded.flood = flood->wait();
  return flooded;
}

Result<BenchTable> floodTable(const Stage& stage, std::int64_t& lost) {
  const auto pose = [&] {
    PoseMessage message = stage.track.poses.front();
    message.avatar = 1;
    return message;
  }();
  const std::vector<FloodKind> kinds = {
      {"nothing", 0.0, {}},
      {"noise", 200'000.0, noiseDatagrams(1)},
      {"poses of the same avatar, of a skeleton nobody said", 150'000.0, strangersPoses(pose, 2)}};
  BenchTable table{"floods",
                   "One true sender at 1 kHz beside a flood",
                   {{"flood", "beside", 0},
                    {"per_second", "datagrams/s", 0},
                    {"poses", "true poses", 0},
                    {"lost", "lost", 0},
                    {"dropped", "datagrams that the system dropped", 0},
                    {"overrun", "overrun", 0},
                    {"sender_us", "the flood's processor time per datagram (us)", 2},
                    {"service_us", "the service's (us)", 2},
                    {"query_p50_us", "query p50 (us)", 1},
                    {"added_p50_us", "added p50 (us)", 0}},
                   {}};
  double usual = 0.0;  // processor seconds that the true poses cost
  for (const FloodKind& kind : kinds) {
    FORETOUCH_TRY(auto service, serve(stage));
    const double before = service.processorSeconds();
    FORETOUCH_TRY(const auto flooded, runFlooded(stage, kind));
    const double ran = service.processorSeconds() - before;
    service.stop();
    if (kind.datagrams.empty()) usual = ran;
    const auto strange = static_cast<double>(flooded.flood.datagrams);
    const double serviceUs = strange > 0.0 ? 1e6 * std::max(0.0, ran - usual) / strange : 0.0;
    const StatusMessage& status = flooded.truth.status;
    const std::int64_t missed = flooded.truth.sent - status.answered;
    lost += missed;
    std::vector<double> queries, added;
    for (const LoadAnswer& answer : flooded.truth.answers) {
      queries.push_back(answer.queryUs);
      added.push_back(std::max(0.0F, answer.serviceUs - answer.queryUs));
    }
    table.rows.push_back(
        {kind.what, flooded.flood.perSecond, flooded.truth.sent, missed, status.kernelDrops,
         countOfReason(status, Reject::Overrun), flooded.flood.processorUs, serviceUs,
         percentilesOf(std::move(queries)).p50, percentilesOf(std::move(added)).p50});
  }
  return table;
}

// Slow clients.

Result<BenchTable> httpTable(const Stage& stage) {
  FORETOUCH_TRY(auto service, serve(stage, {"--http", fmt::format("127.0.0.1:{}", kHttpPort),
                                            fmt::format("--view=127.0.0.1:{}", kViewPort)}));
  struct Trial {
    std::string what, path;
    SlowClients::Kind kind;
    int clients;
    std::uint16_t port;
  };
  using Kind = SlowClients::Kind;
  const std::vector<Trial> trials = {
      {"one byte each, again and again", "/healthz", Kind::OneByte, 0, kHttpPort},
      {"one byte each, again and again", "/healthz", Kind::OneByte, 24, kHttpPort},
      {"ask for /view.json and do not read", "/", Kind::NoRead, 0, kViewPort},
      {"ask for /view.json and do not read", "/", Kind::NoRead, 8, kViewPort}};
  BenchTable table{"http",
                   "How long others wait beside slow clients",
                   {{"clients", "slow clients", 0},
                    {"they", "which", 0},
                    {"path", "asked for", 0},
                    {"asked", "times", 0},
                    {"p50_s", "median (s)", 4},
                    {"max_s", "longest (s)", 4},
                    {"failed", "failed", 0}},
                   {}};
  for (const Trial& trial : trials) {
    const SlowClients clients(trial.kind, trial.clients, trial.port);
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // until they sit
    std::vector<double> waits;
    std::int64_t failed = 0;
    const auto until =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(stage.seconds);
    while (std::chrono::steady_clock::now() < until) {
      const double wait = secondsToGet(trial.path, trial.port);
      failed += wait < 0.0 ? 1 : 0;
      waits.push_back(wait);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    const auto asked = static_cast<std::int64_t>(waits.size());
    const Percentiles ranks = percentilesOf(std::move(waits));
    table.rows.push_back({static_cast<std::int64_t>(trial.clients), trial.what, trial.path, asked,
                          ranks.p50, ranks.max, failed});
  }
  service.stop();
  return table;
}

// The log.

std::uintmax_t bytesIn(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator(folder, gone)) bytes += entry.file_size(gone);
  return bytes;
}

Result<BenchTable> logTable(const Stage& stage) {
  PoseMessage pose = stage.track.poses.front();
  pose.avatar = 1;
  constexpr double kFlood = 20'000.0;
  constexpr int kFiles = 3;
  constexpr std::int64_t kLogBytes = 2'000'000;
  struct Trial {
    FloodKind flood;
    std::int64_t logBytes;
  };
  const FloodKind none{"nothing", 0.0, {}};
  const FloodKind refused{"refused poses", kFlood, strangersPoses(pose, 3)};
  BenchTable table{"log",
                   "The log of one sender at 1 kHz beside refused poses",
                   {{"flood", "beside", 0},
                    {"per_second", "datagrams/s", 0},
                    {"log_bytes", "--log-bytes", 0},
                    {"log_files", "--log-files", 0},
                    {"mb", "MB on the disk at the end", 2},
                    {"mb_per_hour", "MB/h", 0}},
                   {}};
  for (const Trial& trial : {Trial{none, 0}, Trial{refused, 0}, Trial{refused, kLogBytes}}) {
    const BenchFolder folder;
    FORETOUCH_TRY(auto service, serve(stage, {"--log", folder.path(), "--log-bytes",
                                              std::to_string(trial.logBytes), "--log-files",
                                              std::to_string(kFiles)}));
    FORETOUCH_TRY(const auto flooded, runFlooded(stage, trial.flood));
    service.stop();
    const double mb = static_cast<double>(bytesIn(folder.path())) / kBytesPerMB;
    const bool isBounded = trial.logBytes > 0;
    table.rows.push_back({trial.flood.what, flooded.flood.perSecond, trial.logBytes,
                          static_cast<std::int64_t>(isBounded ? kFiles : 0), mb,
                          isBounded ? 0.0 : mb * kSecondsPerHour / (stage.seconds + 2.0)});
  }
  return table;
}

// The speaker.

/// Records nothing, as a service without a log.
class NoRecord final : public StreamRecord {
 public:
  void speaker(const SpeakerMessage&) override {}
  void skeleton(ByteView, std::int64_t) override {}
  void pose(ByteView, std::int64_t) override {}
  void leftOut() override {}
};

/// The track's poses as one sender says them, without a network.
class SaidPoses {
 public:
  explicit SaidPoses(const LoadTrack& track) : track_(track) {}
  [[nodiscard]] SkeletonMessage skeleton() const {
    SkeletonMessage message = track_.skeleton;
    message.avatar = 1;
    message.session = kSession;
    return message;
  }
  const PoseMessage& next() {
    const auto last = static_cast<std::int64_t>(track_.poses.size()) - 1;
    const std::int64_t place = sequence_ % (2 * last);
    pose_ = track_.poses[static_cast<std::size_t>(place <= last ? place : 2 * last - place)];
    pose_.avatar = 1;
    pose_.session = kSession;
    pose_.sequence = sequence_;
    pose_.utimeUs = kSession + sequence_ * 1000;
    pose_.skeletonHash = track_.skeleton.hash;
    ++sequence_;
    return pose_;
  }

 private:
  static constexpr std::int64_t kSession = 1'700'000'000'000'000;
  const LoadTrack& track_;
  PoseMessage pose_;
  std::int64_t sequence_ = 0;
};

double microsecondsOf(std::chrono::steady_clock::duration taken) {
  return std::chrono::duration<double, std::micro>(taken).count();
}

/// Both answer the same poses, one after the other and in changing order, in this process.
Result<BenchTable> speakerTable(const Stage& stage) {
  const auto make = [&] {
    return StreamSolver::make(1, stage.inputs.avatar, stage.inputs.scene, QueryOptions{},
                              StreamPolicy{});
  };
  FORETOUCH_TRY(auto free, make());
  FORETOUCH_TRY(auto solver, make());
  BoundStream bound(std::move(solver), SpeakerPolicy{});
  SaidPoses said(stage.track);
  NoRecord record;
  const UdpmSender sender{0x0100007f, 4711};
  const SkeletonMessage skeleton = said.skeleton();
  Bytes payload;
  encode(skeleton, payload);
  static_cast<void>(free.take(skeleton));
  static_cast<void>(bound.take({sender, skeleton.session, payload}, skeleton, record));
  ContactsMessage answer;
  std::vector<double> without, with, ratios;
  const auto until =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(stage.seconds);
  for (bool isFirst = true; std::chrono::steady_clock::now() < until; isFirst = !isFirst) {
    const PoseMessage& pose = said.next();
    const Heard heard{sender, pose.utimeUs, payload};
    double us[2] = {};
    for (const bool isBound : {isFirst, !isFirst}) {
      const auto begin = std::chrono::steady_clock::now();
      const bool may = !isBound || bound.mayPass(sender, pose.utimeUs);
      const Reject reject = !isBound ? free.take(pose, answer)
                            : may    ? bound.take(heard, pose, answer, record)
                                     : Reject::OtherSender;
      us[isBound ? 1 : 0] = microsecondsOf(std::chrono::steady_clock::now() - begin);
      if (reject == Reject::None) continue;
      return Error::in("foretouch-bench trust", ErrorCode::Mismatch,
                       std::string("a true pose was refused: ") + toString(reject));
    }
    without.push_back(us[0]);
    with.push_back(us[1]);
    ratios.push_back(us[1] / us[0]);
  }
  const auto poses = static_cast<std::int64_t>(ratios.size());
  return BenchTable{
      "speaker",
      "An answer with and without knowing who speaks, pose by pose",
      {{"poses", "poses", 0},
       {"free_p50_us", "without, p50 (us)", 2},
       {"bound_p50_us", "with, p50 (us)", 2},
       {"ratio", "median of the ratios", 4}},
      {{poses, percentilesOf(without).p50, percentilesOf(with).p50, percentilesOf(ratios).p50}}};
}

}  // namespace

Result<TrustBench> measureTrust(const TrustRequest& request) {
  FORETOUCH_TRY(auto inputs, loadBenchInputs(request.files));
  FORETOUCH_TRY(auto track, loadTrack(inputs, request.place));
  const Stage stage{std::move(inputs), std::move(track), request.seconds};
  TrustBench bench;
  BenchReport& report = bench.report;
  report.kind = "trust";
  report.title = "What strangers can do to a service";
  report.command = request.command;
  report.date = dateNow();
  report.machine = machineFacts();
  report.workload = streamFacts(stage.inputs, 1);
  FORETOUCH_TRY(auto speaker, speakerTable(stage));
  FORETOUCH_TRY(auto floods, floodTable(stage, bench.lost));
  FORETOUCH_TRY(auto http, httpTable(stage));
  FORETOUCH_TRY(auto log, logTable(stage));
  report.tables = {std::move(floods), std::move(http), std::move(log), std::move(speaker)};
  if (!request.hardened.empty()) {
    const HardeningRequest hardening{request.hardened, request.seconds};
    FORETOUCH_TRY(auto queries, hardenedQueries(hardening, stage.inputs, request.place));
    report.tables.push_back(std::move(queries));
    FORETOUCH_TRY(auto services, hardenedServices(hardening, stage.inputs, stage.track));
    report.tables.push_back(std::move(services));
  }
  report.notes = {
      "Service, true sender and strangers share this machine's cores; the flood comes from a port "
      "of its own. Lost: true poses less answers that the service counts. Processor times are of "
      "the "
      "flood's thread, which also delivers what it sends, and of the service beyond what it takes "
      "for the true poses: how many a core of each bears.",
      "Added: from the system's stamp on the pose's datagram to the answer's hand-over, less the "
      "query."};
  return bench;
}

}  // namespace foretouch::tools
