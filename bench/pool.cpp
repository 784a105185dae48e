#include "bench/pool.h"

#include <chrono>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/query/query.h"
#include "middleware/worker_pool.h"

namespace foretouch::tools {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<StepTask> tasksAt(int instant, int avatars, const Query& query,
                              const std::vector<StepPoses>& steps) {
  const auto count = static_cast<std::int64_t>(steps.size());
  std::vector<StepTask> tasks;
  tasks.reserve(static_cast<std::size_t>(avatars));
  for (std::int64_t which = 0; which < avatars; ++which) {
    const StepPoses& poses = steps[slotOf((instant + count * which / avatars) % count)];
    tasks.push_back({&query, &poses.from, &poses.to});
  }
  return tasks;
}

}  // namespace

Result<CrowdTimes> timeCrowd(const Avatar& avatar, const std::vector<StepPoses>& steps,
                             const Scene& scene, const QueryOptions& options, int avatars,
                             int instants, int threads) {
  FORETOUCH_TRY(const auto query, Query::build(avatar, scene, options));
  FORETOUCH_TRY(auto pool, WorkerPool::start(threads));
  CrowdTimes times;
  std::vector<StepContacts> answers;
  for (int instant = 0; instant < instants; ++instant) {
    const std::vector<StepTask> tasks = tasksAt(instant, avatars, query, steps);
    const Clock::time_point start = Clock::now();
    const auto done = Query::answerAll(tasks, pool, answers);
    const double seconds = secondsSince(start);
    if (!done.ok()) return done.error();
    times.wallS += seconds;
    times.instantUs.push_back(1e6 * seconds);
    times.steps += avatars;
    for (const StepContacts& answer : answers) {
      for (const LinkContact& contact : answer.links) {
        times.contacts += contact.verdict == Verdict::Contact ? 1 : 0;
      }
    }
  }
  return times;
}

}  // namespace foretouch::tools
