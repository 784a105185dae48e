#include "tools/replay/replay.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "lss/assert.h"
#include "tools/replay/step_solver.h"

namespace foretouch::tools {
namespace {

/// Threads exchange steps in chunks, so that locks do not dominate steps of a few microseconds.
constexpr std::int64_t kMaxChunkSteps = 32;
/// Chunks per thread that may wait: enough to bridge one slow chunk, small in memory.
constexpr std::int64_t kChunksAhead = 4;

struct Chunk {
  std::vector<ReplayedStep> steps;
  std::optional<Error> error;  ///< The error of the step after `steps`.
};

/// Workers fetch the numbers of chunks here and leave their answers; the consumer takes the answers
/// in order. Workers wait once they are a window ahead of it.
class Exchange {
 public:
  Exchange(std::int64_t chunks, std::int64_t window)
      : chunks_(chunks), slots_(static_cast<std::size_t>(window)) {}

  std::optional<std::int64_t> claim() {
    std::unique_lock<std::mutex> lock(mutex_);
    room_.wait(lock, [&] {
      return stopped_ || next_ == chunks_ ||
             next_ < taken_ + static_cast<std::int64_t>(slots_.size());
    });
    if (stopped_ || next_ == chunks_) return std::nullopt;
    return next_++;
  }

  void deliver(std::int64_t chunk, Chunk content) {
    const std::lock_guard<std::mutex> lock(mutex_);
    slot(chunk) = std::move(content);
    arrival_.notify_one();
  }

  Chunk take() {
    std::unique_lock<std::mutex> lock(mutex_);
    arrival_.wait(lock, [&] { return slot(taken_).has_value(); });
    Chunk content = std::move(*slot(taken_));
    slot(taken_++).reset();
    room_.notify_all();
    return content;
  }

  void stop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
    room_.notify_all();
  }

 private:
  std::optional<Chunk>& slot(std::int64_t chunk) {
    return slots_[static_cast<std::size_t>(chunk) % slots_.size()];
  }

  std::mutex mutex_;
  std::condition_variable room_, arrival_;
  std::int64_t chunks_, next_ = 0, taken_ = 0;
  bool stopped_ = false;
  std::vector<std::optional<Chunk>> slots_;
};

/// The threads of one replay; the destructor joins them.
class Workers {
 public:
  explicit Workers(Exchange& exchange) : exchange_(exchange) {}
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers() {
    exchange_.stop();
    for (std::thread& thread : threads_) thread.join();
  }

  /// Fewer threads than requested still give the same answers; none at all is an error.
  Result<Done> start(std::vector<StepSolver>& solvers,
                     const std::function<Chunk(StepSolver&, std::int64_t)>& work) {
    try {
      threads_.reserve(solvers.size());
      for (StepSolver& solver : solvers) {
        threads_.emplace_back([this, work, &solver] {
          while (const auto chunk = exchange_.claim()) {
            exchange_.deliver(*chunk, work(solver, *chunk));
          }
        });
      }
    } catch (const std::exception& e) {
      if (threads_.empty()) {
        return Error::in("--threads", ErrorCode::LimitExceeded,
                         std::string("no thread could be started: ") + e.what());
      }
    }
    return Done{};
  }

 private:
  Exchange& exchange_;
  std::vector<std::thread> threads_;
};

/// Steps from `first` up to `end`. No exception may leave a thread: running out of memory becomes
/// the chunk's error.
Chunk solveChunk(StepSolver& solver, std::int64_t first, std::int64_t end) {
  Chunk chunk;
  try {
    for (std::int64_t step = first; step < end; ++step) {
      auto solved = solver.solve(step);
      if (!solved.ok()) {
        chunk.error = solved.error();
        break;
      }
      chunk.steps.push_back(std::move(solved).value());
    }
  } catch (const std::exception& e) {
    chunk.error =
        Error::of(ErrorCode::LimitExceeded,
                  "step " + std::to_string(first + static_cast<std::int64_t>(chunk.steps.size())) +
                      " could not be answered: " + e.what());
  }
  return chunk;
}

/// Turns an error about what this avatar cannot be asked into one about the option that asks it.
Result<Query> withOptions(Result<Query> built) {
  if (built.ok()) return built;
  Error error = built.error();
  if (error.file == "scope") error.file = "--scope";
  if (error.file == "passSeparating") error.file = "--pass-separating";
  return error;
}

}  // namespace

Result<Done> replay(const ReplayInputs& inputs, int threads, const StepSink& sink) {
  FORETOUCH_ASSERT(threads >= 1);
  FORETOUCH_TRY(const auto query,
                withOptions(Query::build(inputs.avatar, inputs.scene, inputs.query)));
  std::optional<LinkDepths> depths;
  if (inputs.query.self && inputs.query.surface) {
    depths.emplace(inputs.avatar, *inputs.query.surface);
  }
  const StepFormat format(inputs.avatar, inputs.scene, AskedLists::of(inputs.query));
  std::vector<StepSolver> solvers;
  for (int i = 0; i < threads; ++i) {
    solvers.emplace_back(inputs, query, depths ? &*depths : nullptr, format);
  }
  // What the first query allocates must not count in any step's latency. An error here recurs, and
  // is reported, at step 0.
  static_cast<void>(solvers.front().solve(0));

  const std::int64_t steps = inputs.steps.count;
  const std::int64_t size =
      std::clamp<std::int64_t>(steps / (threads * kChunksAhead), 1, kMaxChunkSteps);
  const std::int64_t chunks = (steps + size - 1) / size;
  Exchange exchange(chunks, threads * kChunksAhead);
  Workers workers(exchange);
  const auto started = workers.start(solvers, [&](StepSolver& solver, std::int64_t chunk) {
    return solveChunk(solver, chunk * size, std::min(steps, (chunk + 1) * size));
  });
  if (!started.ok()) return started.error();
  for (std::int64_t chunk = 0; chunk < chunks; ++chunk) {
    const Chunk content = exchange.take();
    for (const ReplayedStep& step : content.steps) {
      if (!sink(step)) return Done{};
    }
    if (content.error) return *content.error;
  }
  return Done{};
}

}  // namespace foretouch::tools
