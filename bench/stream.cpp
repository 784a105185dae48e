#include "bench/stream.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/bench_folder.h"
#include "bench/machine.h"
#include "bench/service_process.h"
#include "bench/soak_trouble.h"
#include "bench/timing.h"
#include "lss/index.h"
#include "network/wire/messages.h"
#include "tools/report/document_parts.h"
#include "tools/stream/clip_sender.h"

namespace foretouch::tools {
namespace {

constexpr double kBytesPerMb = 1024.0 * 1024.0;
constexpr double kSecondsPerHour = 3600.0;

template <typename Of>
std::vector<double> sorted(const std::vector<LoadAnswer>& answers, Of of) {
  std::vector<double> values;
  values.reserve(answers.size());
  for (const LoadAnswer& answer : answers) values.push_back(of(answer));
  std::sort(values.begin(), values.end());
  return values;
}

void appendRanks(std::vector<BenchCell>& row, const std::vector<double>& ascending) {
  for (const double share : {0.5, 0.99, 0.999}) row.emplace_back(valueAtRank(ascending, share));
  row.emplace_back(ascending.empty() ? 0.0 : ascending.back());
}

void appendRankColumns(BenchTable& table, const std::string& key, const std::string& title) {
  for (const char* rank : {"p50", "p99", "p99.9", "max"}) {
    std::string suffix = rank;
    suffix.erase(std::remove(suffix.begin(), suffix.end(), '.'), suffix.end());
    table.columns.push_back({key + "_" + suffix + "_us", title + " " + rank, 0});
  }
}

BenchTable streamTable() {
  BenchTable table{"stream",
                   "Pose sent to verdict received, and where the time goes: microseconds",
                   {{"avatars", "avatars", 0},
                    {"rate_hz", "poses/s each", 0},
                    {"poses", "poses", 0},
                    {"lost", "lost", 0},
                    {"gaps", "gaps", 0},
                    {"late_sends", "sent late", 0}},
                   {}};
  appendRankColumns(table, "round_trip", "round trip");
  table.columns.push_back({"query_p50_us", "query p50", 1});
  table.columns.push_back({"query_p99_us", "query p99", 1});
  appendRankColumns(table, "added", "added");
  return table;
}

std::vector<BenchCell> streamRow(const StreamCrowd& crowd, const LoadOutcome& outcome) {
  std::vector<BenchCell> row;
  row.reserve(16);
  row.emplace_back(static_cast<std::int64_t>(crowd.avatars));
  row.emplace_back(crowd.rateHz);
  for (const std::int64_t count :
       {outcome.sent, outcome.unanswered, outcome.gaps, outcome.lateSends}) {
    row.emplace_back(count);
  }
  const auto queries = sorted(outcome.answers, [](const LoadAnswer& a) { return a.queryUs; });
  appendRanks(row, sorted(outcome.answers, [](const LoadAnswer& a) { return a.roundTripUs; }));
  row.emplace_back(valueAtRank(queries, 0.5));
  row.emplace_back(valueAtRank(queries, 0.99));
  appendRanks(row, sorted(outcome.answers, [](const LoadAnswer& a) {
                return std::max(0.0F, a.serviceUs - a.queryUs);
              }));
  return row;
}

struct Sample {
  double seconds;
  std::int64_t residentBytes, openFiles;
};

/// What is in `all` and not in `usual`, both sorted.
std::string beyond(const std::vector<std::string>& usual, const std::vector<std::string>& all) {
  std::vector<std::string> more;
  std::set_difference(all.begin(), all.end(), usual.begin(), usual.end(), std::back_inserter(more));
  return fmt::format("{}", fmt::join(more, ", "));
}

/// Resident memory and descriptors of the service, once a second.
class Watch {
 public:
  explicit Watch(const ServiceProcess& service) : service_(service) {}
  void sample() {
    const auto kinds = service_.openFiles();
    const auto files = static_cast<std::int64_t>(kinds.size());
    if (samples_.empty()) least_ = most_ = kinds;
    if (kinds.size() < least_.size()) least_ = kinds;
    if (kinds.size() > most_.size()) most_ = kinds;
    samples_.push_back({secondsSince(start_), service_.residentBytes(), files});
  }
  /// What was open when most was, beyond what was open when least was.
  [[nodiscard]] std::string passingFiles() const { return beyond(least_, most_); }
  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }

 private:
  using Clock = std::chrono::steady_clock;
  static double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }
  const ServiceProcess& service_;
  Clock::time_point start_ = Clock::now();
  std::vector<Sample> samples_;
  std::vector<std::string> least_, most_;  // each at one moment
};

struct OpenFiles {
  std::int64_t least = 0, most = 0;
};

struct SoakMemory {
  double firstMb = 0.0, middleMb = 0.0, lastMb = 0.0, slopeMbPerHour = 0.0;
  OpenFiles filesFirst, filesLast;  // for each half
};

/// The senders, numbered from 1.
std::vector<LoadSender> sendersOf(const std::vector<StreamCrowd>& crowds) {
  std::vector<LoadSender> senders;
  for (const StreamCrowd& crowd : crowds) {
    for (int i = 0; i < crowd.avatars; ++i) {
      senders.push_back({static_cast<std::int32_t>(senders.size()) + 1, crowd.rateHz});
    }
  }
  return senders;
}

/// The arguments for `foretouch serve` with these senders.
std::vector<std::string> serviceArguments(const BenchFiles& files, std::size_t avatars,
                                          int workers) {
  std::vector<std::string> arguments = {"--scene", files.scenePath, "--workers",
                                        std::to_string(workers)};
  for (std::size_t i = 1; i <= avatars; ++i) {
    arguments.insert(arguments.end(), {"--avatar", std::to_string(i) + "=" + files.avatarPath});
  }
  return arguments;
}

/// The facts that the figures depend on.
std::vector<BenchFact> streamFacts(const BenchInputs& inputs, int workers) {
  return {{"scene", fmt::format("{}, {} triangles", fileName(inputs.files.scenePath),
                                inputs.scene.numTriangles())},
          {"avatar", fmt::format("{}, {} links with {} LSS", fileName(inputs.files.avatarPath),
                                 inputs.avatar.numLinks(), inputs.avatar.numLss())},
          {"clip",
           fmt::format("{}, a pose a frame, forth and back", fileName(inputs.files.motionPath))},
          {"workers", std::to_string(workers)}};
}

/// The clip as its senders send it, one pose per frame.
Result<LoadTrack> loadTrack(const BenchInputs& inputs, const Placement& place) {
  const StepSelection everyFrame{1, static_cast<std::int64_t>(inputs.clip.frames.size()) - 1};
  SenderOptions options;
  options.source = "foretouch-bench";
  const ClipSender sender(
      {inputs.avatar, inputs.clip, inputs.match, place, inputs.isUpright, inputs.files.motionPath},
      everyFrame, options);
  LoadTrack track;
  track.skeleton = sender.skeleton(0);
  track.poses.resize(countOf(sender.numPoses()));
  for (std::int64_t pose = 0; pose < sender.numPoses(); ++pose) {
    FORETOUCH_CHECK(sender.fill(pose, 0, track.poses[slotOf(pose)]));
  }
  return track;
}

}  // namespace

Result<BenchReport> measureStream(const StreamRequest& request) {
  FORETOUCH_TRY(const auto inputs, loadBenchInputs(request.files));
  FORETOUCH_TRY(const auto track, loadTrack(inputs, request.place));
  BenchTable table = streamTable();
  for (const StreamCrowd& crowd : request.crowds) {
    LoadRequest load;
    load.senders = sendersOf({crowd});
    load.durationS = request.durationS;
    FORETOUCH_TRY(auto service, ServiceProcess::start(serviceArguments(
                                    inputs.files, load.senders.size(), request.workers)));
    FORETOUCH_TRY(const auto outcome, runLoad(track, load));
    service.stop();
    table.rows.push_back(streamRow(crowd, outcome));
  }
  BenchReport report =
      startedReport("stream", "The stream: pose sent to verdict received, over multicast");
  report.workload = streamFacts(inputs, request.workers);
  report.tables.push_back(std::move(table));
  report.notes = {
      "Senders and the receiver of verdicts are one process, the service another, in a network "
      "namespace of their own; every rank is over all answers of a row.",
      "Round trip: from before the pose is handed to the system to the verdict's receipt, three "
      "processes' worth of scheduling on this machine's cores. Query: the service's own, from two "
      "poses to all verdicts. Added: from the system's stamp on the pose's datagram to the "
      "answer's "
      "hand-over, less the query.",
      "Lost: poses without an answer, by sequence. Sent late: more than a period after they were "
      "due, which is this machine's doing."};
  return report;
}

double slopeOf(const std::vector<double>& times, const std::vector<double>& values) {
  const auto n = static_cast<double>(times.size());
  if (times.size() < 2) return 0.0;
  double meanT = 0.0, meanV = 0.0, up = 0.0, down = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    meanT += times[i] / n;
    meanV += values[i] / n;
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    up += (times[i] - meanT) * (values[i] - meanV);
    down += (times[i] - meanT) * (times[i] - meanT);
  }
  return down > 0.0 ? up / down : 0.0;
}

namespace {

/// What is known about the samples after warm-up.
SoakMemory memoryOf(const std::vector<Sample>& samples, double warmUpS, double endS) {
  SoakMemory memory;
  std::vector<double> hours, megabytes;
  for (const Sample& sample : samples) {
    if (sample.seconds < warmUpS) continue;
    OpenFiles& files =
        sample.seconds < 0.5 * (warmUpS + endS) ? memory.filesFirst : memory.filesLast;
    files.least = files.most == 0 ? sample.openFiles : std::min(files.least, sample.openFiles);
    files.most = std::max(files.most, sample.openFiles);
    hours.push_back(sample.seconds / kSecondsPerHour);
    megabytes.push_back(static_cast<double>(sample.residentBytes) / kBytesPerMb);
  }
  memory.slopeMbPerHour = slopeOf(hours, megabytes);
  if (megabytes.empty()) return memory;
  memory.firstMb = megabytes.front();
  memory.middleMb = megabytes[megabytes.size() / 2];
  memory.lastMb = megabytes.back();
  return memory;
}

std::int64_t countNamed(const StatusMessage& status, const std::string& name) {
  for (const StatusMessage::Count& count : status.counts) {
    if (count.reason == name) return count.count;
  }
  return 0;
}

/// Adds what came of the moving world. Returns the poses that were sent and are not in it.
std::int64_t addWorldRows(const MovingRequest& moving, const LoadOutcome& outcome,
                          BenchTable& table) {
  const auto row = [&](const char* name, double value) {
    table.rows.push_back({std::string(name), value});
  };
  const std::int64_t poses = outcome.sent + outcome.propMessages * moving.props;
  const std::int64_t lost = poses - countNamed(outcome.status, "world-taken");
  std::vector<double> advances(outcome.world.advanceUs.begin(), outcome.world.advanceUs.end());
  std::sort(advances.begin(), advances.end());
  row("world: poses of avatars and balls", static_cast<double>(poses));
  row("world: of these, not in it", static_cast<double>(lost));
  row("world: silences", static_cast<double>(countNamed(outcome.status, "world-silences")));
  row("world: failures", static_cast<double>(countNamed(outcome.status, "world-failures")));
  row("world: windows", static_cast<double>(outcome.world.advances));
  row("world: messages missed here", static_cast<double>(outcome.world.missed));
  row("world: timelines", static_cast<double>(outcome.world.timelines));
  row("world: events", static_cast<double>(outcome.world.events));
  row("world: events marked", static_cast<double>(outcome.world.marked));
  row("world: receipt to events p50 us", valueAtRank(advances, 0.5));
  row("world: receipt to events p99 us", valueAtRank(advances, 0.99));
  row("world: receipt to events max us", advances.empty() ? 0.0 : advances.back());
  return lost;
}

}  // namespace

Result<SoakOutcome> soakStream(const SoakRequest& request) {
  FORETOUCH_TRY(const auto inputs, loadBenchInputs(request.files));
  FORETOUCH_TRY(const auto track, loadTrack(inputs, request.place));
  LoadRequest load;
  load.senders = sendersOf(request.crowds);
  load.durationS = 60.0 * request.minutes;
  load.garbageShare = request.garbageShare;
  load.moving = request.moving;
  const BenchFolder folder;
  const TroubleRequest trouble{inputs.files, load.url, static_cast<int>(load.senders.size()) + 1,
                               request.diskPath.empty() ? folder.path() : request.diskPath,
                               !request.diskPath.empty()};
  auto arguments = serviceArguments(inputs.files, load.senders.size() + (request.isCalm ? 0 : 1),
                                    request.workers);
  if (request.moving.props > 0) {
    FORETOUCH_TRY(const auto world, writeLoadWorld(folder, inputs.files, load.senders.size(),
                                                   request.moving.isFurnished));
    arguments = {"--world", world, "--workers", std::to_string(request.workers)};
  }
  if (!request.isCalm) {
    const auto more = SoakTrouble::arguments(trouble.logFolder);
    arguments.insert(arguments.end(), more.begin(), more.end());
  }
  auto service = ServiceProcess::start(arguments);
  if (!service.ok()) return service.error();
  std::optional<SoakTrouble> beside;
  if (!request.isCalm) {
    FORETOUCH_TRY(auto started, SoakTrouble::start(trouble));
    beside.emplace(std::move(started));
  }
  Watch watch(service.value());
  const auto ran = runLoad(track, load, [&] {
    watch.sample();
    if (beside) beside->everySecond();
  });
  if (!ran.ok()) return ran.error();
  const LoadOutcome& outcome = ran.value();
  const TroubleCounts befell = beside ? beside->stop() : TroubleCounts{};

  SoakOutcome soak;
  const SoakMemory memory =
      memoryOf(watch.samples(), request.warmUpShare * load.durationS, load.durationS);
  soak.lost = outcome.unanswered;
  soak.slopeMbPerHour = memory.slopeMbPerHour;
  soak.grownMb = memory.lastMb - memory.middleMb;
  // What is opened and closed again may be open at any look; what leaks is open at every later one.
  soak.filesGrown = memory.filesLast.least > memory.filesFirst.least;
  soak.exitCode = service.value().stop();

  const auto trips = sorted(outcome.answers, [](const LoadAnswer& a) { return a.roundTripUs; });
  BenchTable table{
      "soak", "What came of it", {{"quantity", "quantity", 0}, {"value", "value", -1}}, {}};
  const auto row = [&](const char* name, double value) {
    table.rows.push_back({std::string(name), value});
  };
  row("minutes", request.minutes);
  row("poses", static_cast<double>(outcome.sent));
  row("garbage datagrams", static_cast<double>(outcome.garbage));
  row("lost", static_cast<double>(outcome.unanswered));
  row("answered twice", static_cast<double>(outcome.repeated));
  row("gaps", static_cast<double>(outcome.gaps));
  row("send failures", static_cast<double>(outcome.sendFailures));
  row("answers dropped here before they were read", static_cast<double>(outcome.ownDrops));
  row("service: poses dropped by the system", static_cast<double>(outcome.status.kernelDrops));
  row("service: answers not sent", static_cast<double>(outcome.status.publishFailures));
  row("service: refused, garbage among them", static_cast<double>(outcome.status.rejected));
  const std::int64_t overrun = countNamed(outcome.status, toString(Reject::Overrun));
  if (overrun > 0) row("service: overrun", static_cast<double>(overrun));
  row("resident memory, first MB", memory.firstMb);
  row("resident memory, last MB", memory.lastMb);
  row("slope after warm-up, MB/h", soak.slopeMbPerHour);
  row("open files, least in the first half", static_cast<double>(memory.filesFirst.least));
  row("open files, least in the last half", static_cast<double>(memory.filesLast.least));
  row("open files, most in the first half", static_cast<double>(memory.filesFirst.most));
  row("open files, most in the last half", static_cast<double>(memory.filesLast.most));
  row("floods", static_cast<double>(befell.floods));
  row("datagrams of floods", static_cast<double>(befell.floodDatagrams));
  row("senders killed and restarted", static_cast<double>(befell.restarts));
  row("times that the log's disk was full", static_cast<double>(befell.timesFull));
  row("viewers let go", static_cast<double>(befell.viewersLetGo));
  if (request.moving.props > 0) soak.lost += addWorldRows(request.moving, outcome, table);
  row("round trip p50 us", valueAtRank(trips, 0.5));
  row("round trip p99.9 us", valueAtRank(trips, 0.999));
  row("round trip max us", trips.empty() ? 0.0 : trips.back());
  row("service's exit code", soak.exitCode);
  soak.report = startedReport("soak", "The stream, soaked");
  soak.report.workload = streamFacts(inputs, request.workers);
  if (request.moving.props > 0 && !request.moving.isFurnished) {
    soak.report.workload.front() = {"scene", "a hall, 10 triangles"};
  }
  soak.report.tables.push_back(std::move(table));
  const std::string passing = watch.passingFiles();
  if (!passing.empty()) soak.report.notes = {"Open at the moment with most: also " + passing + "."};
  return soak;
}

}  // namespace foretouch::tools
