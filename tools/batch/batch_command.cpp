#include "tools/batch/batch_command.h"

#include <algorithm>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/json_writer.h"
#include "assets/text_file.h"
#include "tools/batch/batch.h"
#include "tools/batch/batch_report.h"
#include "tools/batch/batch_table.h"
#include "tools/batch/job_name.h"
#include "tools/interrupt.h"

namespace foretouch::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kMostJobSeconds = 1e7;

struct AskedBatch {
  std::string manifest, results;
  BatchShard shard;
  int threads = 0;  ///< 0: one per processor.
  std::optional<double> jobSeconds;
  std::string program;  ///< Empty: this one.
  bool ofFeet = false, makesReports = false, lists = false, merges = false, asJson = false;
  std::string table, report;
};

Result<Done> takeShard(const std::string& text, BatchShard& shard) {
  const char* const end = text.data() + text.size();
  BatchShard found;
  const auto index = std::from_chars(text.data(), end, found.index);
  const bool hasSlash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  const auto count = hasSlash ? std::from_chars(index.ptr + 1, end, found.count) : index;
  const bool isLegal = hasSlash && count.ec == std::errc() && count.ptr == end &&
                       found.index >= 1 && found.index <= found.count &&
                       found.count <= kMaxBatchJobs;
  if (!isLegal) {
    return Error::of(ErrorCode::OutOfRange,
                     "expected i/n with i from 1 to n, as 3/16, found " + inQuotes(text));
  }
  shard = found;
  return Done{};
}

void addRunSettings(Settings& settings, AskedBatch& asked) {
  settings.parsed(
      "--shard", "I/N", [&asked](const std::string& text) { return takeShard(text, asked.shard); },
      [&asked] { return fmt::format("{}/{}", asked.shard.index, asked.shard.count); },
      "The I-th of N workers, from 1: every N-th job");
  settings
      .wholeOr("cores", "--threads", "N", asked.threads, kMaxThreads,
               "Jobs at a time, each of one thread")
      .in(kEffortGroup);
  settings
      .number("--job-seconds", "S", asked.jobSeconds, {0.0, kMostJobSeconds, "seconds", "s"},
              "none", "A job that takes longer fails")
      .in(kEffortGroup);
  settings.flag("--feet", asked.ofFeet,
                "Each job is foretouch feet: its stances, its plot, and one ranking of all clips");
  settings.flag("--reports", asked.makesReports, "Also a report of each job, for a browser")
      .in(kOutputGroup);
  settings
      .path("--program", "FILE", asked.program,
            "The program foretouch that does the jobs; this one if not given")
      .files();
  settings.flag("--list", asked.lists, "Do nothing, and print each job and the name of its result");
}

void addMergeSettings(Settings& settings, AskedBatch& asked) {
  settings.flag("--merge", asked.merges,
                "Do no job: make one table and one report of the results that are there");
  settings
      .output("--table", "FILE", asked.table,
              "With --merge: the table, CSV or, by its ending, lines of JSON (jsonl); "
              "DIR/table.csv if not given")
      .needing("--merge");
  settings
      .output("--report", "FILE", asked.report,
              "With --merge: the report, worst clips first; DIR/report.html if not given")
      .needing("--merge");
}

Settings batchSettings(AskedBatch& asked) {
  Settings settings;
  settings.path("manifest", "MANIFEST", asked.manifest, "The jobs (docs/fleets.md)")
      .files("batch")
      .required("a manifest");
  settings
      .outputFolder("-o,--output", asked.results,
                    "The folder of results, shared by all workers; it is made if need be")
      .required();
  addRunSettings(settings, asked);
  addMergeSettings(settings, asked);
  settings.asJson(asked.asJson);
  return settings;
}

/// The path of the folder from where the report will be, as its reader sees it.
std::string folderSeenFrom(const std::string& report, const std::string& results) {
  std::error_code unknown;
  const fs::path from = fs::absolute(report, unknown).parent_path();
  const fs::path seen = fs::path(results).lexically_proximate(from);
  return seen.empty() ? "." : seen.string();
}

Result<Done> writeAll(const std::string& path, const std::string& text) {
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(text);
  return file.commit();
}

std::string tallyLine(std::size_t jobs, std::size_t done, std::size_t kept, std::size_t repeated,
                      std::size_t failed, std::size_t absent) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("jobs", jobs);
  out.field("done", done);
  out.field("kept", kept);
  out.field("repeated", repeated);
  out.field("failed", failed);
  out.field("absent", absent);
  out.endObject();
  return text + "\n";
}

ExitCode merge(const AskedBatch& asked, const BatchManifest& manifest, const BatchPlan& plan) {
  const std::string lead = plan.results + (asked.ofFeet ? "/feet_" : "/");
  const std::string table = asked.table.empty() ? lead + "table.csv" : asked.table;
  const std::string report = asked.report.empty() ? lead + "report.html" : asked.report;
  const BatchTable all =
      gatherBatch(manifest, plan.version, ResultFolder(plan.results, endingOf(manifest.kind)));
  const bool isJson = fs::path(table).extension() == ".jsonl";
  FORETOUCH_CHECK_OR(failed, writeAll(table, isJson ? jsonLinesOf(all) : csvOf(all)));
  const BatchReportPlaces places{fs::path(manifest.path).filename().string(),
                                 folderSeenFrom(report, plan.results)};
  FORETOUCH_CHECK_OR(failed, writeAll(report, batchReport(all, places, manifest.kind)));
  if (asked.table != kStandardOutput && asked.report != kStandardOutput) {
    printOut(asked.asJson
                 ? tallyLine(all.rows.size(), all.done, 0, 0, all.failed, all.absent)
                 : fmt::format("{} jobs: {} done, {} failed, {} not done\ntable:  {}\nreport: {}\n",
                               all.rows.size(), all.done, all.failed, all.absent, table, report));
  }
  return all.done == all.rows.size() ? ExitCode::Done : ExitCode::CheckSaysNo;
}

ExitCode list(const BatchManifest& manifest, const BatchPlan& plan) {
  FileMarks marks(manifest.folder);
  std::string text;
  for (std::size_t i = plan.shard.index - 1; i < manifest.jobs.size(); i += plan.shard.count) {
    const BatchJob& job = manifest.jobs[i];
    text += fmt::format("{}\t{}\t", i + 1, jobName(job, plan.version, marks));
    std::string words;
    for (const std::string& word : job.words()) words += (words.empty() ? "" : " ") + word;
    text += words + "\n";
  }
  printOut(text);
  return ExitCode::Done;
}

ExitCode doJobs(const AskedBatch& asked, const BatchManifest& manifest, const BatchPlan& plan) {
  const InterruptGuard guard;  // built first, destroyed last: workers end before the signal
  // Our parent may ignore the ends of its children, which we would inherit: ours count.
  std::signal(SIGCHLD, SIG_DFL);
  FORETOUCH_TRY_OR(failed, const auto tally,
                   runBatch(manifest, plan, [&] { return guard.requested(); }));
  printOut(
      asked.asJson
          ? tallyLine(tally.jobs, tally.done, tally.kept, tally.repeated, tally.failed, tally.left)
          : fmt::format("{} jobs: {} done, {} done before, {} the same as another, {} failed"
                        "{}\nresults: {}\n",
                        tally.jobs, tally.done, tally.kept, tally.repeated, tally.failed,
                        tally.left > 0 ? fmt::format(", {} not begun", tally.left) : "",
                        asked.results));
  return tally.failed == 0 && tally.left == 0 ? ExitCode::Done : ExitCode::CheckSaysNo;
}

Result<BatchPlan> planFor(const AskedBatch& asked) {
  BatchPlan plan;
  std::error_code failure;
  plan.program = asked.program.empty() ? fs::read_symlink("/proc/self/exe", failure).string()
                                       : fs::absolute(asked.program, failure).string();
  FORETOUCH_TRY(plan.version, versionOf(plan.program));
  if (asked.ofFeet) plan.version += " feet";  // the same clip has other results
  plan.results = fs::absolute(asked.results, failure).lexically_normal().string();
  while (plan.results.size() > 1 && plan.results.back() == '/') plan.results.pop_back();
  const int cores = static_cast<int>(
      std::clamp(std::thread::hardware_concurrency(), 1u, static_cast<unsigned>(kMaxThreads)));
  plan.threads = asked.threads == 0 ? cores : asked.threads;
  plan.shard = asked.shard;
  plan.jobSeconds = asked.jobSeconds.value_or(0.0);
  plan.makesReports = asked.makesReports;
  if (asked.lists) return plan;
  fs::create_directories(plan.results, failure);
  if (!fs::is_directory(plan.results, failure)) {
    return Error::in(asked.results, ErrorCode::FileUnwritable,
                     "cannot be made a folder; expected one that this user may write to");
  }
  return plan;
}

ExitCode run(const AskedBatch& asked, const std::function<Command()>& replay,
             const std::function<Command()>& feet) {
  Command command = asked.ofFeet ? feet() : replay();
  FORETOUCH_TRY_OR(failed, const auto manifest,
                   readManifest(asked.manifest, command.settings,
                                asked.ofFeet ? BatchKind::Feet : BatchKind::Replays));
  FORETOUCH_TRY_OR(failed, const auto plan, planFor(asked));
  if (asked.lists) return list(manifest, plan);
  return asked.merges ? merge(asked, manifest, plan) : doJobs(asked, manifest, plan);
}

constexpr char kBatchExamples[] = R"(Examples:
  foretouch batch dances.batch --output results
  foretouch batch dances.batch --output results --shard 3/16 --threads 4
  foretouch batch dances.batch --output results --merge --table dances.csv
  foretouch batch walks.batch --output feet --feet
  foretouch batch walks.batch --output feet --feet --merge

A manifest is a text; each job takes the options of foretouch replay:
  foretouch-batch 1
  all --scene room.obj --avatar dancer.avatar.json --rate 10
  job --motion 'clips/*.bvh'
  job --motion kick.bvh --tolerance 0.001 --tolerance 0.01

Exit codes: 0 all jobs are done, 1 some failed or are not done yet, 2 bad use, a bad manifest, or a
folder that cannot be written. What is done is not done again: run the same once more.)";

}  // namespace

Command batchCommand(std::function<Command()> replay, std::function<Command()> feet) {
  const auto asked = std::make_shared<AskedBatch>();
  Command command{"batch", "Replay many clips, on one machine or on many", kBatchExamples,
                  batchSettings(*asked)};
  command.run = [asked, replay = std::move(replay), feet = std::move(feet)](const Settings&) {
    return run(*asked, replay, feet);
  };
  return command;
}

}  // namespace foretouch::tools
