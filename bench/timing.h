// bench/timing.h: the times of steps: from two validated poses to their contacts, including
// building the motion.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/workload.h"
#include "lss/simd.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene.h"
#include "tests/reference/reference_query.h"

namespace foretouch::tools {

/// Percentiles of a set of times or ratios: the value at the rank, never in between.
struct Percentiles {
  double mean = 0.0, p50 = 0.0, p90 = 0.0, p99 = 0.0, max = 0.0;
};
[[nodiscard]] Percentiles percentilesOf(std::vector<double> values);
/// The value that this share of them does not exceed; 0 if there are none.
[[nodiscard]] double valueAtRank(const std::vector<double>& ascending, double share);

/// One kind of query.
struct BenchCase {
  std::string name;
  QueryOptions query;
  ReferenceOptions reference;
  Simd simd = Simd::Scalar;
  bool cold = false;  ///< Also asked once, after other work and with empty caches.
};

struct TimingOptions {
  int repeats = 9;      ///< Repeats of each step, in a row.
  int coldPasses = 3;   ///< Over all steps; a step's least time counts. Also for steps asked once.
  int betweenKb = 512;  ///< Streamed through the caches before each step that is asked once: like
                        ///< other work of a program between two poses.
  int coldMb = 16;      ///< Streamed through the caches before each cold step.
};

struct TimedStep {
  /// Asked once, in the order of the clip, after other work.
  double onceUs = std::numeric_limits<double>::quiet_NaN();
  double warmUs = 0.0;   ///< The least of all repeats.
  double firstUs = 0.0;  ///< The first of them, after other steps.
  double coldUs = std::numeric_limits<double>::quiet_NaN();
  QueryCounters counters;
  int contacts = 0, starts = 0, undecided = 0;  ///< Links.
};

struct CaseTimes {
  std::vector<TimedStep> steps;
  std::vector<double> everyUs;  ///< All repeats of all steps.
};

struct Timing {
  std::vector<CaseTimes> cases;
  std::vector<double> raySetUs;  ///< Per step the least of all repeats.
  double overheadUs = 0.0;       ///< The clock's; subtracted from every time.
};

/// One thread's memory from step to step.
struct StepMemory {
  ChainMotion motion;
  Scratch scratch;
  StepContacts contacts;  ///< The last step's.
};

/// Answers one step. A separate function, so that a profiler can count its cost alone.
void answerStep(const Query& query, const StepPoses& poses, StepMemory& memory);

/// Alternates all cases and the ray set at each step, so that drift of the machine affects all
/// alike; then asks them singly, place by place in the order of the clip (`clipOrder`). One thread.
/// Errors: those of buildReference().
[[nodiscard]] Result<Timing> timeSteps(const Avatar& avatar, const std::vector<StepPoses>& steps,
                                       const std::vector<std::size_t>& clipOrder,
                                       const Scene& scene, const std::vector<BenchCase>& cases,
                                       const TimingOptions& options);

}  // namespace foretouch::tools
