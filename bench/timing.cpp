#include "bench/timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "articulated/motion.h"
#include "articulated/try.h"
#include "bench/leaf_timing.h"
#include "bench/ray_set.h"
#include "lss/assert.h"
#include "tools/progress.h"

namespace foretouch::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// Restores the processor's own choice of instructions at the end.
class SimdChoice {
 public:
  SimdChoice() = default;
  SimdChoice(const SimdChoice&) = delete;
  SimdChoice& operator=(const SimdChoice&) = delete;
  ~SimdChoice() { useSimd(std::nullopt); }
  void take(Simd simd) {
    if (simd == current_) return;
    [[maybe_unused]] const bool supported = useSimd(simd);
    FORETOUCH_ASSERT(supported);
    current_ = simd;
  }

 private:
  Simd current_ = Simd::Other;
};

/// Memory to write and read, to push everything else out of the caches.
class CacheFlood {
 public:
  explicit CacheFlood(int kilobytes) : words_(static_cast<std::size_t>(kilobytes) << 7) {}
  void run() {
    std::uint64_t sum = kept_;
    for (std::uint64_t& word : words_) word = ++sum;
    for (const std::uint64_t word : words_) sum += word;
    kept_ = sum;
  }

 private:
  std::vector<std::uint64_t> words_;
  volatile std::uint64_t kept_ = 0;  // else the compiler would remove the loops
};

struct AskedCase {
  Query query;
  Simd simd;
};

/// One pass of one case over one step, timed.
class StepClock {
 public:
  explicit StepClock(const Scene& scene) : scene_(scene), overheadUs_(clockOverheadUs()) {}

  /// Microseconds of a step; fills `answer`.
  double ask(const StepPoses& poses, const AskedCase& way, StepContacts& answer) {
    simd_.take(way.simd);
    const Clock::time_point start = Clock::now();
    answerStep(way.query, poses, memory_);
    const double us = since(start);
    answer = memory_.contacts;
    return us;
  }

  Result<double> castRays(const std::array<RaySegment, kRaysPerSet>& rays) const {
    const Clock::time_point start = Clock::now();
    const auto hits = castRaySet(scene_, rays);
    const double us = since(start);
    if (!hits.ok()) return hits.error();
    return us;
  }

  [[nodiscard]] double overheadUs() const { return overheadUs_; }

 private:
  [[nodiscard]] double since(Clock::time_point start) const {
    const double us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
    return std::max(0.0, us - overheadUs_);
  }

  const Scene& scene_;
  double overheadUs_;
  StepMemory memory_;
  SimdChoice simd_;
};

void record(const StepContacts& answer, TimedStep& step) {
  step.counters = answer.counters;
  for (const LinkContact& contact : answer.links) {
    step.contacts += contact.verdict == Verdict::Contact ? 1 : 0;
    step.starts += contact.verdict == Verdict::StartsInContact ? 1 : 0;
    step.undecided += contact.verdict == Verdict::Undecided ? 1 : 0;
  }
}

void timeWarm(StepClock& clock, const StepPoses& poses, const AskedCase& way, int repeats,
              CaseTimes& times) {
  TimedStep step;
  StepContacts answer;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const double us = clock.ask(poses, way, answer);
    if (repeat == 0) step.firstUs = us;
    step.warmUs = repeat == 0 ? us : std::min(step.warmUs, us);
    times.everyUs.push_back(us);
  }
  record(answer, step);
  times.steps.push_back(step);
}

Result<Done> timeRays(const StepClock& clock, const Avatar& avatar, const StepPoses& poses,
                      int repeats, std::vector<double>& raySetUs) {
  const auto rays = raysAlong(ChainMotion(avatar.skeleton(), poses.from, poses.to));
  double least = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    FORETOUCH_TRY(const auto us, clock.castRays(rays));
    least = std::min(least, us);
  }
  raySetUs.push_back(least);
  return Done{};
}

/// Every step once per pass, in the order given, with other work before each; the least of all
/// passes counts.
void timeSingly(StepClock& clock, const std::vector<StepPoses>& steps,
                const std::vector<std::size_t>& order, const AskedCase& way, int passes,
                CacheFlood flood, double TimedStep::*time, CaseTimes& times) {
  StepContacts answer;
  for (int pass = 0; pass < passes; ++pass) {
    for (const std::size_t i : order) {
      flood.run();
      const double us = clock.ask(steps[i], way, answer);
      double& least = times.steps[i].*time;
      least = pass == 0 ? us : std::min(least, us);
    }
  }
}

}  // namespace

double valueAtRank(const std::vector<double>& ascending, double share) {
  if (ascending.empty()) return 0.0;
  const auto count = static_cast<double>(ascending.size());
  const auto rank = static_cast<std::size_t>(std::ceil(share * count));
  return ascending[std::max<std::size_t>(rank, 1) - 1];
}

Percentiles percentilesOf(std::vector<double> values) {
  Percentiles figures;
  if (values.empty()) return figures;
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  const auto rank = [&](double share) { return valueAtRank(values, share); };
  double sum = 0.0;
  for (const double value : values) sum += value;
  return {sum / count, rank(0.5), rank(0.9), rank(0.99), values.back()};
}

[[gnu::noinline]] void answerStep(const Query& query, const StepPoses& poses, StepMemory& memory) {
  memory.motion.assign(query.avatar().skeleton(), poses.from, poses.to);
  query.answer(memory.motion, memory.scratch, memory.contacts);
}

Result<Timing> timeSteps(const Avatar& avatar, const std::vector<StepPoses>& steps,
                         const std::vector<std::size_t>& clipOrder, const Scene& scene,
                         const std::vector<BenchCase>& cases, const TimingOptions& options) {
  FORETOUCH_ASSERT(!steps.empty() && options.repeats >= 1);
  std::vector<AskedCase> asked;
  for (const BenchCase& way : cases) {
    FORETOUCH_TRY(auto query, buildReference(avatar, scene, way.query, way.reference));
    asked.push_back({std::move(query), way.simd});
  }
  StepClock clock(scene);
  Timing timing;
  timing.cases.resize(cases.size());
  timing.overheadUs = clock.overheadUs();
  // The first set builds the scene's ray structures.
  FORETOUCH_CHECK(clock.castRays(
      raysAlong(ChainMotion(avatar.skeleton(), steps.front().from, steps.front().to))));
  ProgressBar progress("steps", static_cast<std::int64_t>(steps.size()));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (std::size_t c = 0; c < cases.size(); ++c) {
      timeWarm(clock, steps[i], asked[c], options.repeats, timing.cases[c]);
    }
    FORETOUCH_CHECK(timeRays(clock, avatar, steps[i], options.repeats, timing.raySetUs));
    progress.advanceTo(static_cast<std::int64_t>(i) + 1);
  }
  for (std::size_t c = 0; c < cases.size(); ++c) {
    if (!cases[c].cold || options.coldMb == 0) continue;
    timeSingly(clock, steps, clipOrder, asked[c], options.coldPasses, CacheFlood(options.betweenKb),
               &TimedStep::onceUs, timing.cases[c]);
    timeSingly(clock, steps, clipOrder, asked[c], options.coldPasses,
               CacheFlood(1024 * options.coldMb), &TimedStep::coldUs, timing.cases[c]);
  }
  return timing;
}

}  // namespace foretouch::tools
