#include "tools/bench_pool.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <optional>
#include <thread>

#include "tools/bench_timing.h"

namespace foretouch::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// Items are handed out by the chunk, so that threads do not spend their time on the counter.
constexpr std::int64_t kChunk = 8;

struct Crowd {
  const Avatar& avatar;
  const std::vector<StepPoses>& steps;
  const Scene& scene;
  const QueryOptions& query;
  std::int64_t avatars, items;

  [[nodiscard]] const StepPoses& posesOfItem(std::int64_t item) const {
    const auto count = static_cast<std::int64_t>(steps.size());
    const std::int64_t instant = item / avatars, which = item % avatars;
    return steps[static_cast<std::size_t>((instant + count * which / avatars) % count)];
  }
};

struct Share {
  std::int64_t contacts = 0;
  std::vector<double> stepUs;
  std::optional<Error> error;
};

void answerShare(const Crowd& crowd, std::atomic<std::int64_t>& next, Share& share) {
  QueryScratch scratch;
  for (;;) {
    const std::int64_t first = next.fetch_add(kChunk);
    if (first >= crowd.items) return;
    for (std::int64_t item = first; item < std::min(first + kChunk, crowd.items); ++item) {
      const Clock::time_point start = Clock::now();
      const auto contacts =
          answerStep(crowd.avatar, crowd.posesOfItem(item), crowd.scene, crowd.query, scratch);
      share.stepUs.push_back(
          std::chrono::duration<double, std::micro>(Clock::now() - start).count());
      if (!contacts.ok()) {
        share.error = contacts.error();
        return;
      }
      for (const LinkContact& contact : contacts.value().links) {
        share.contacts += contact.verdict == Verdict::Contact ? 1 : 0;
      }
    }
  }
}

/// No exception may leave a thread.
void answerSafely(const Crowd& crowd, std::atomic<std::int64_t>& next, Share& share) {
  Share own;  // apart from the other threads' shares, whose cache lines it must not touch
  try {
    answerShare(crowd, next, own);
    share = std::move(own);
  } catch (const std::exception& e) {
    share.error = Error{ErrorCode::LimitExceeded, "--threads", -1, -1, e.what()};
  }
}

}  // namespace

Result<CrowdTimes> timeCrowd(const Avatar& avatar, const std::vector<StepPoses>& steps,
                             const Scene& scene, const QueryOptions& query, int avatars,
                             int instants, int threads) {
  const Crowd crowd{avatar, steps, scene, query, avatars, std::int64_t{avatars} * instants};
  std::vector<Share> shares(static_cast<std::size_t>(threads));
  std::atomic<std::int64_t> next{0};
  const Clock::time_point start = Clock::now();
  std::vector<std::thread> pool;
  pool.reserve(shares.size());
  std::optional<Error> failure;
  try {
    for (std::size_t i = 1; i < shares.size(); ++i) {
      pool.emplace_back([&crowd, &next, &share = shares[i]] { answerSafely(crowd, next, share); });
    }
  } catch (const std::exception& e) {
    failure = Error{ErrorCode::LimitExceeded, "--threads", -1, -1,
                    std::string("a thread could not be started: ") + e.what()};
  }
  answerSafely(crowd, next, shares[0]);
  for (std::thread& thread : pool) thread.join();
  CrowdTimes times;
  times.wallS = std::chrono::duration<double>(Clock::now() - start).count();
  times.steps = crowd.items;
  for (const Share& share : shares) {
    if (share.error && !failure) failure = share.error;
    times.contacts += share.contacts;
    times.stepUs.insert(times.stepUs.end(), share.stepUs.begin(), share.stepUs.end());
  }
  if (failure) return *failure;
  return times;
}

}  // namespace foretouch::tools
