#include "tools/batch/batch.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "tools/batch/child.h"
#include "tools/batch/job_name.h"
#include "tools/batch/job_record.h"
#include "tools/batch/scratch_folder.h"
#include "tools/console.h"
#include "tools/progress.h"
#include "tools/settings/file_mark.h"

namespace foretouch::tools {
namespace {

namespace fs = std::filesystem;

/// Errors are lines for people: of a thousand, people read the first ones.
constexpr std::size_t kMostErrorsTold = 20;

/// A replay says what the system says.
bool isOfFullDisk(const std::string& why) {
  return why.find(std::strerror(ENOSPC)) != std::string::npos ||
         why.find(std::strerror(EDQUOT)) != std::string::npos;
}

/// How a job ended, for the tally.
enum class JobEnd { Done, Kept, Repeated, Failed, Stopped };

/// One run over the jobs of a shard. Threads take them in turn.
class BatchRun {
 public:
  BatchRun(const BatchManifest& manifest, const BatchPlan& plan, const std::string& scratch,
           const std::function<bool()>& stop)
      : manifest_(manifest),
        plan_(plan),
        folder_(plan.results, endingOf(manifest.kind)),
        scratch_(scratch),
        stop_(stop),
        marks_(manifest.folder),
        next_(plan.shard.index - 1),
        progress_("batch", static_cast<std::int64_t>(jobsOfShard())) {
    tally_.jobs = jobsOfShard();
  }

  Result<BatchTally> run();

 private:
  [[nodiscard]] std::size_t jobsOfShard() const {
    const std::size_t all = manifest_.jobs.size(), first = plan_.shard.index - 1;
    return all <= first ? 0 : (all - first - 1) / plan_.shard.count + 1;
  }
  std::optional<std::size_t> claim();
  void work();
  JobEnd doJob(std::size_t number);
  JobEnd keep(std::size_t number, JobRecord record, const ChildEnd& end);
  JobEnd failJob(std::size_t number, const std::string& name, const std::string& why);
  [[nodiscard]] ChildPlan childFor(const BatchJob& job, const std::string& name) const;
  /// Plots of feet are small, and what a ranking leads to.
  [[nodiscard]] bool makesPages() const {
    return plan_.makesReports || manifest_.kind == BatchKind::Feet;
  }
  JobEnd put(const JobRecord& record, JobEnd end, const std::vector<const char*>& endings = {});
  void stopWith(const Error& error);
  void tell(std::size_t number, const std::string& why);
  void count(JobEnd end);
  [[nodiscard]] bool isStopping();

  const BatchManifest& manifest_;
  const BatchPlan& plan_;
  const ResultFolder folder_;
  const std::string& scratch_;
  const std::function<bool()>& stop_;
  FileMarks marks_;
  std::mutex mutex_;  // for all below
  std::size_t next_;
  std::set<std::string> begun_;
  std::optional<Error> error_;
  BatchTally tally_;
  std::size_t told_ = 0;
  ProgressBar progress_;
};

bool BatchRun::isStopping() {
  if (stop_()) return true;
  const std::lock_guard<std::mutex> lock(mutex_);
  return error_.has_value();
}

std::optional<std::size_t> BatchRun::claim() {
  if (isStopping()) return std::nullopt;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (next_ >= manifest_.jobs.size()) return std::nullopt;
  return std::exchange(next_, next_ + plan_.shard.count);
}

void BatchRun::stopWith(const Error& error) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!error_) error_ = error;
}

void BatchRun::tell(std::size_t number, const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (++told_ > kMostErrorsTold) return;
  printError(fmt::format("{}:{}: job {}: {}", manifest_.path, manifest_.jobs[number].line,
                         number + 1, why));
}

void BatchRun::count(JobEnd end) {
  const std::lock_guard<std::mutex> lock(mutex_);
  switch (end) {
    case JobEnd::Done: ++tally_.done; break;
    case JobEnd::Kept: ++tally_.kept; break;
    case JobEnd::Repeated: ++tally_.repeated; break;
    case JobEnd::Failed: ++tally_.failed; break;
    case JobEnd::Stopped: return;
  }
  progress_.advanceTo(
      static_cast<std::int64_t>(tally_.done + tally_.kept + tally_.repeated + tally_.failed));
}

ChildPlan BatchRun::childFor(const BatchJob& job, const std::string& name) const {
  const bool isOfFeet = manifest_.kind == BatchKind::Feet;
  ChildPlan child{plan_.program, {commandOf(manifest_.kind)}, manifest_.folder, plan_.jobSeconds};
  const std::vector<std::string> words = job.words();
  child.words.insert(child.words.end(), words.begin(), words.end());
  const std::string results = scratch_ + "/" + name;
  for (const std::string& word : {std::string("--quiet"), std::string("--json"),
                                  "--output=" + results + endingOf(manifest_.kind)}) {
    child.words.push_back(word);
  }
  if (!isOfFeet) child.words.emplace_back("--threads=1");
  if (makesPages()) {
    child.words.push_back((isOfFeet ? "--plot=" : "--report=") + results + ".html");
  }
  return child;
}

/// Another worker may have done the job meanwhile.
JobEnd BatchRun::put(const JobRecord& record, JobEnd end, const std::vector<const char*>& endings) {
  const auto put = folder_.put(record, scratch_, endings);
  if (put.ok()) return put.value() ? end : JobEnd::Kept;
  stopWith(put.error());
  return JobEnd::Stopped;
}

JobEnd BatchRun::keep(std::size_t number, JobRecord record, const ChildEnd& end) {
  const auto summary = lastingSummary(end.out);
  const std::string results = scratch_ + "/" + record.name + endingOf(manifest_.kind);
  const auto mark = markOfFile(results);
  if (!summary || !mark.ok()) {
    return failJob(number, record.name, "expected results and their summary, found none");
  }
  record.summary = *summary;
  record.mark = mark.value();
  record.isDone = true;
  std::vector<const char*> endings{endingOf(manifest_.kind)};
  if (makesPages()) endings.push_back(".html");
  return put(record, JobEnd::Done, endings);
}

JobEnd BatchRun::failJob(std::size_t number, const std::string& name, const std::string& why) {
  JobRecord record;
  record.name = name;
  record.error = why;
  const JobEnd end = put(record, JobEnd::Failed);
  if (end == JobEnd::Failed) tell(number, why);
  return end;
}

JobEnd BatchRun::doJob(std::size_t number) {
  const BatchJob& job = manifest_.jobs[number];
  JobRecord record;
  record.name = jobName(job, plan_.version, marks_);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!begun_.insert(record.name).second) return JobEnd::Repeated;
  }
  const auto there = folder_.find(record.name);
  if (there && there->isDone) return JobEnd::Kept;
  std::error_code unmade;
  const fs::path place = fs::path(folder_.fileOf(record.name, "")).parent_path();
  fs::create_directory(place, unmade);
  if (unmade) {
    stopWith(Error::in(place.string(), ErrorCode::FileUnwritable, "cannot be made a folder"));
    return JobEnd::Stopped;
  }
  const ChildEnd end = runChild(childFor(job, record.name), [&] { return isStopping(); });
  if (end.isStopped) return JobEnd::Stopped;
  if (jobName(job, plan_.version, marks_) != record.name) {
    tell(number, "its files changed while it ran");  // nothing is kept under the old name
    return JobEnd::Failed;
  }
  if (!end.isDone()) {
    const std::string why = whyFailed(end, plan_.jobSeconds);
    if (!isOfFullDisk(why)) return failJob(number, record.name, why);
    // Every other job would fail by it, too, and a record of that may just fit.
    stopWith(Error::in(plan_.results, ErrorCode::FileUnwritable, why));
    return JobEnd::Stopped;
  }
  return keep(number, std::move(record), end);
}

/// No exception may leave a thread.
void BatchRun::work() {
  try {
    while (const auto number = claim()) count(doJob(*number));
  } catch (const std::exception& e) {
    stopWith(Error::of(ErrorCode::LimitExceeded, std::string("the batch stopped: ") + e.what()));
  }
}

Result<BatchTally> BatchRun::run() {
  std::vector<std::thread> threads;
  const auto count = std::min(static_cast<std::size_t>(plan_.threads), tally_.jobs);
  try {
    for (std::size_t i = 1; i < count; ++i) threads.emplace_back([this] { work(); });
  } catch (const std::exception&) {
    // fewer do the same
  }
  work();
  for (std::thread& thread : threads) thread.join();
  if (told_ > kMostErrorsTold) {
    printError(
        fmt::format("{}: and {} more jobs that failed", manifest_.path, told_ - kMostErrorsTold));
  }
  if (error_) return *error_;
  tally_.left = tally_.jobs - tally_.done - tally_.kept - tally_.repeated - tally_.failed;
  return tally_;
}

}  // namespace

Result<std::string> versionOf(const std::string& program) {
  const ChildEnd end = runChild({program, {"--version"}, "/", 0.0}, [] { return false; });
  const std::string version = end.out.substr(0, end.out.find('\n'));
  if (end.isDone() && !version.empty()) return version;
  const std::string why = end.isDone() ? "says no version" : whyFailed(end, 0.0);
  return Error::in(program, ErrorCode::Mismatch, "expected the program foretouch: " + why);
}

Result<BatchTally> runBatch(const BatchManifest& manifest, const BatchPlan& plan,
                            const std::function<bool()>& stop) {
  FORETOUCH_TRY(const auto scratch, ScratchFolder::create(plan.results));
  return BatchRun(manifest, plan, scratch.path(), stop).run();
}

}  // namespace foretouch::tools
